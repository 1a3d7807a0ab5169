// Pieces that are still to be followed, each of their numbers in an array of its own, for vectors.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "raster/piece.h"

namespace ifsm::core {

// Pieces that go through a map together, on every machine; a whole number of vectors.
constexpr std::size_t pieces_per_block = 32;

// Pieces' numbers a … f, and how far off their places may be, each in an array of its own.
constexpr std::size_t piece_numbers = 7;
template <class Real>
struct PieceBlock {
  alignas(64) std::array<std::array<Real, pieces_per_block>, piece_numbers> of;
  std::size_t size;
};

template <class Real>
class PieceStack {
 public:
  std::size_t size() const { return size_; }
  void push(const Piece& p, double rounding) {
    make_room(1);
    const std::array<double, piece_numbers> numbers{p.a, p.b, p.c, p.d, p.e, p.f, rounding};
    for (std::size_t k = 0; k < piece_numbers; ++k) at(k)[0] = static_cast<Real>(numbers[k]);
    grow(1);
  }
  void pop(PieceBlock<Real>& block) {
    make_room(0);  // whole blocks are copied
    block.size = std::min(size_, pieces_per_block);
    size_ -= block.size;
    for (std::size_t k = 0; k < piece_numbers; ++k) std::copy_n(at(k), pieces_per_block, block.of[k].begin());
  }
  // Where the next piece's number is to be written; from one number to the next.
  Real* at(std::size_t number) { return numbers_.data() + number * room_ + size_; }
  std::size_t stride() const { return room_; }
  void grow(std::size_t pieces) { size_ += pieces; }
  // For so many, and for what vectors write beyond.
  void make_room(std::size_t pieces) {
    const std::size_t needed = size_ + pieces + pieces_per_block;
    if (needed <= room_) return;
    const std::size_t room = 2 * needed;
    std::vector<Real> numbers(piece_numbers * room);
    for (std::size_t k = 0; k < piece_numbers; ++k)
      std::copy_n(numbers_.data() + k * room_, size_, numbers.data() + k * room);
    numbers_.swap(numbers);
    room_ = room;
  }

 private:
  std::vector<Real> numbers_;
  std::size_t size_ = 0, room_ = 0;
};

}  // namespace ifsm::core
