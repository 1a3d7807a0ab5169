// Counts by pixel that stay in the cache: one byte a pixel, which carries into 32 bits when it is full. Counting is
// what bounds the chaos game; a million pixels are then 1 MB instead of 4, for a quarter of memory more.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace ifsm::core {

// What the innermost loop sees of a histogram.
struct Tally {
  std::uint8_t* low;
  std::uint32_t* high;

  void count(std::int64_t pixel) const {
    if (fills(pixel)) carry(pixel);
  }

  // In two steps, so that those of many pixels, whose 32 bits are far away, go together: counts, and tells whether the
  // byte is full; then it is to be carried.
  bool fills(std::int64_t pixel) const { return ++low[pixel] == 0; }
  void carry(std::int64_t pixel) const {
    constexpr std::uint32_t full = std::numeric_limits<std::uint32_t>::max(), byte = 256;
    high[pixel] = high[pixel] > full - byte ? full : high[pixel] + byte;
  }
};

class Histogram {
 public:
  // Pixels, and one place more for what lies outside.
  explicit Histogram(std::int64_t pixels);

  Tally tally() { return {low_.data(), high_.data()}; }

  // Numbers of pixels; few enough that those of full bytes fit the stack.
  static constexpr std::size_t most_at_once = 1 << 12;
  void count(std::span<const std::int32_t> pixels);

  // How often something was counted outside since it was last asked; fewer than 2^32 times.
  std::int64_t take_outside();

  // Adds a histogram of as many pixels. Sums saturate.
  void add(const Histogram& other);

  // The counts, which saturate at 2^32 - 1; the histogram is left empty.
  std::vector<std::uint32_t> take();

 private:
  std::uint32_t count(std::size_t pixel) const;

  std::vector<std::uint8_t> low_;
  std::vector<std::uint32_t> high_;
};

}  // namespace ifsm::core
