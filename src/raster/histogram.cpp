#include "raster/histogram.h"

#include <array>
#include <utility>

namespace ifsm::core {
namespace {

constexpr std::uint32_t full = std::numeric_limits<std::uint32_t>::max();

std::uint32_t sum(std::uint32_t a, std::uint32_t b) { return a > full - b ? full : a + b; }

}  // namespace

Histogram::Histogram(std::int64_t pixels)
    : low_(static_cast<std::size_t>(pixels) + 1), high_(static_cast<std::size_t>(pixels) + 1) {}

void Histogram::count(std::span<const std::int32_t> pixels) {
  const Tally tally = this->tally();
  std::array<std::int32_t, most_at_once> filled;
  std::size_t carries = 0;
  for (const std::int32_t pixel : pixels) {
    filled[carries] = pixel;
    carries += tally.fills(pixel) ? 1 : 0;
  }
  for (std::size_t k = 0; k < carries; ++k) tally.carry(filled[k]);
}

std::uint32_t Histogram::count(std::size_t pixel) const { return sum(high_[pixel], low_[pixel]); }

std::int64_t Histogram::take_outside() {
  const std::uint32_t outside = count(low_.size() - 1);
  low_.back() = 0;
  high_.back() = 0;
  return outside;
}

void Histogram::add(const Histogram& other) {
  for (std::size_t pixel = 0; pixel < high_.size(); ++pixel) high_[pixel] = sum(high_[pixel], other.count(pixel));
}

std::vector<std::uint32_t> Histogram::take() {
  for (std::size_t pixel = 0; pixel < high_.size(); ++pixel) high_[pixel] = count(pixel);
  low_ = {};
  high_.pop_back();
  return std::exchange(high_, {});
}

}  // namespace ifsm::core
