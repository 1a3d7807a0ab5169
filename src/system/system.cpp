#include "system/system.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include "base/error.h"

namespace ifsm::core {
namespace {

std::vector<Affine> checked(int dimension, std::vector<Affine> maps) {
  in_range(dimension, 2, 3, "dimension");
  in_range(static_cast<std::int64_t>(maps.size()), 1, System::most_maps, "maps");
  for (std::size_t i = 0; i < maps.size(); ++i) {
    if (maps[i].linear.allFinite() && maps[i].shift.allFinite()) continue;
    throw Error(Status::not_finite, "maps",
                "Map " + std::to_string(i) + " has a coefficient that is not finite: replace or remove it.")
        .at(static_cast<std::int64_t>(i));
  }
  return maps;
}

// Not negative, with a sum above zero; divided by it.
std::vector<double> normalised(std::vector<double> weights) {
  const double largest = *std::max_element(weights.begin(), weights.end());
  for (double& weight : weights) weight /= largest;  // so that no sum overflows
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  for (double& weight : weights) weight /= sum;
  return weights;
}

std::vector<double> by_size(int dimension, const std::vector<Affine>& maps) {
  // Barnsley's customary .01 for the fern's stem is what this share comes to.
  constexpr double least_share = 1. / 25;
  std::vector<double> sizes;
  for (const Affine& map : maps) sizes.push_back(std::min(std::abs(determinant(map, dimension)), 0x1p1000));
  const double mean = std::accumulate(sizes.begin(), sizes.end(), 0.0) / static_cast<double>(sizes.size());
  if (!(mean > 0)) return std::vector<double>(maps.size(), 1 / static_cast<double>(maps.size()));
  for (double& size : sizes) size = std::max(size, least_share * mean);
  return normalised(std::move(sizes));
}

std::vector<double> checked_weights(std::vector<double> probabilities, std::size_t maps) {
  constexpr const char* name = "probabilities";
  if (probabilities.empty()) return probabilities;
  if (probabilities.size() != maps)
    throw Error(Status::shape, name,
                std::to_string(maps) + " maps have " + std::to_string(probabilities.size()) +
                    " probabilities; give one a map, or none.")
        .needs(static_cast<std::int64_t>(maps));
  require_finite(probabilities.data(), static_cast<std::int64_t>(probabilities.size()), name);
  for (std::size_t i = 0; i < maps; ++i)
    if (probabilities[i] < 0)
      throw Error(Status::range, name,
                  "probabilities[" + std::to_string(i) + "] is " + text_of(probabilities[i]) +
                      "; give 0 for a map that is not taken, else a positive number.")
          .at(static_cast<std::int64_t>(i))
          .with(probabilities[i]);
  if (std::none_of(probabilities.begin(), probabilities.end(), [](double p) { return p > 0; }))
    throw Error(Status::range, name, "All probabilities are 0, so no map is ever taken; make one positive.")
        .at(0)
        .with(0);
  return probabilities;
}

std::vector<int> positive(const std::vector<double>& probabilities) {
  std::vector<int> active;
  for (std::size_t i = 0; i < probabilities.size(); ++i)
    if (probabilities[i] > 0) active.push_back(static_cast<int>(i));
  return active;
}

Contraction contraction_of(int dimension, const std::vector<Affine>& maps, const std::vector<int>& active) {
  std::vector<Affine> taken;
  for (const int i : active) taken.push_back(maps[static_cast<std::size_t>(i)]);
  Contraction result = contraction_of(dimension, taken);
  for (int& letter : result.word) letter = active[static_cast<std::size_t>(letter)];
  if (result.answer == Contractivity::proven &&
      !(result.enclosure.axes.allFinite() && result.enclosure.centre.allFinite()))
    throw Error(Status::range, "maps",
                "The attractor reaches beyond what a double can hold; scale the translations down.");
  return result;
}

std::string text_of(const Word& word) {
  std::string text;
  for (const int letter : word) text += (text.empty() ? "" : " ") + std::to_string(letter);
  return text;
}

}  // namespace

System::System(int dimension, std::vector<Affine> maps, std::vector<double> weights)
    : dimension_(dimension),
      maps_(checked(dimension, std::move(maps))),
      weights_(checked_weights(std::move(weights), maps_.size())),
      probabilities_(weights_.empty() ? by_size(dimension, maps_) : normalised(weights_)),
      active_(positive(probabilities_)),
      contraction_(contraction_of(dimension, maps_, active_)) {}

std::vector<Affine> System::active_maps() const {
  std::vector<Affine> taken;
  for (const int i : active_) taken.push_back(maps_[static_cast<std::size_t>(i)]);
  return taken;
}

const Ellipsoid& System::enclosure() const {
  if (contraction_.answer == Contractivity::refuted)
    throw Error(Status::range, "system",
                "The system has no attractor: the word " + text_of(contraction_.word) +
                    " of its maps has the spectral radius " + core::text_of(contraction_.radius) +
                    ", which must be below 1; make these maps smaller.")
        .at(contraction_.word[0])
        .with(contraction_.radius);
  if (contraction_.answer == Contractivity::undecided)
    throw Error(Status::numerical, "system",
                "Whether the system has an attractor could not be decided with words of up to " +
                    std::to_string(contraction_.length) + " maps; make its maps a little smaller.")
        .with(contraction_.length);
  return contraction_.enclosure;
}

}  // namespace ifsm::core
