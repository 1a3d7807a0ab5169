#include "raster/choice.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace ifsm::core {

Choice::Choice(const std::vector<double>& probabilities)
    : bits_(std::max(1, static_cast<int>(std::bit_width(probabilities.size() - 1)))),
      share_(std::size_t{1} << bits_, std::numeric_limits<std::int32_t>::max()),
      other_(share_.size()) {
  // Each slot is worth 1. What a map has beyond its own slot fills slots that are not full.
  const auto slots = static_cast<double>(share_.size());
  std::vector<double> left(share_.size(), 0.0);
  std::vector<std::size_t> rich, poor;
  for (std::size_t i = 0; i < share_.size(); ++i) {
    other_[i] = static_cast<std::int32_t>(i);
    if (i < probabilities.size()) left[i] = probabilities[i] * slots;
    (left[i] >= 1 ? rich : poor).push_back(i);
  }
  while (!rich.empty() && !poor.empty()) {
    const std::size_t from = rich.back(), to = poor.back();
    poor.pop_back();
    share_[to] = static_cast<std::int32_t>(std::floor(left[to] * 0x1p31));
    other_[to] = static_cast<std::int32_t>(from);
    left[from] -= 1 - left[to];
    if (left[from] >= 1) continue;
    rich.pop_back();
    poor.push_back(from);
  }
  // Rounding may leave slots that are nearly full, or of no map: theirs is the likeliest one.
  std::size_t likeliest = 0;
  for (std::size_t i = 0; i < probabilities.size(); ++i)
    if (probabilities[i] > probabilities[likeliest]) likeliest = i;
  for (const std::size_t i : poor)
    if (i >= probabilities.size() || probabilities[i] == 0) {
      share_[i] = 0;
      other_[i] = static_cast<std::int32_t>(likeliest);
    }
}

}  // namespace ifsm::core
