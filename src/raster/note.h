// What the search of set_pixels finds out about pixels of a tile.
#pragma once

#include <cstddef>
#include <cstdint>

#include "raster/known_pixels.h"
#include "raster/set.h"

namespace ifsm::core {

// What a piece tells of pixels of the tile, in one number: notes are sorted, so that their order is not that of
// vectors. What is met comes first, then row by row.
class Note {
 public:
  struct Pixels {
    std::size_t first_column, end_column, first_row, end_row;
  };

  Note(const Pixels& p, Meets state)
      : bits_(p.end_column | p.end_row << 8 | p.first_column << 16 | p.first_row << 24 |
              (state == Meets::yes ? std::uint64_t{0} : undecided)) {}

  Pixels pixels() const { return {byte(2), byte(0), byte(3), byte(1)}; }
  Meets state() const { return (bits_ & undecided) == 0 ? Meets::yes : Meets::undecided; }
  friend bool operator<(Note a, Note b) { return a.bits_ < b.bits_; }

 private:
  static_assert(KnownPixels::side < 256);
  static constexpr std::uint64_t undecided = std::uint64_t{1} << 32;
  std::size_t byte(int number) const { return bits_ >> 8 * number & 0xFF; }

  std::uint64_t bits_;
};

}  // namespace ifsm::core
