// What is known already of a square of pixels, so that pieces that lie in known pixels need not be looked into.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace ifsm::core {

// One byte a pixel: in its low four bits the side of the largest square of known pixels that begins there, to the right
// and down; in its high ones how many from there down are known; both up to 15, and perhaps too small near pixels that
// were added since all were counted. Pixels beyond the tile are known. Four neighbouring bytes, read at once, tell of
// all boxes up to four pixels wide.
class KnownPixels {
 public:
  static constexpr std::size_t side = 128;          // its bytes stay in a first-level cache
  static constexpr std::size_t stride = side + 64;  // vectors read the pixel to the right of their last
  static constexpr int most = 15, run_unit = 16;

  // Of a square of `width` by `height` states, `stride` from row to row, pixels of that state are known, or all others.
  void begin(const std::uint8_t* states, std::int64_t stride, std::int64_t width, std::int64_t height,
             std::uint8_t state, bool same);

  // Makes it known.
  void add(std::size_t column, std::size_t row);

  bool is_known(std::size_t column, std::size_t row) const { return bytes_[row * stride + column] != 0; }
  // All of columns first … last of those rows?
  bool are_known(std::size_t first_column, std::size_t last_column, std::size_t first_row, std::size_t last_row) const;
  const std::uint8_t* bytes() const { return bytes_.data(); }

 private:
  void renew(std::size_t column, std::size_t row);
  void count();

  using Bytes = std::array<std::uint8_t, (side + 1) * stride>;
  alignas(64) Bytes bytes_, squares_;
  int added_ = 0;  // since all were counted
};

}  // namespace ifsm::core
