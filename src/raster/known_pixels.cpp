#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/known_pixels.cpp"
#include <hwy/foreach_target.h>  // compiles this file once a target
// The order matters: highway.h after foreach_target.h.
#include <hwy/highway.h>

#include <algorithm>
#include <cstring>

#include "raster/known_pixels.h"

HWY_BEFORE_NAMESPACE();
namespace ifsm::core {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

const hn::CappedTag<std::uint8_t, 64> bytes;
constexpr std::size_t width = hn::MaxLanes(decltype(bytes)());

// 1 where a byte is `state`, else 0, or the other way round.
void mark_tile(std::uint8_t* tile, std::uint8_t state, bool same) {
  constexpr std::size_t side = KnownPixels::side, stride = KnownPixels::stride;
  const auto one = hn::Set(bytes, 1), wanted = hn::Set(bytes, state), others = hn::Set(bytes, same ? 0 : 1);
  for (std::size_t row = 0; row < side; ++row)
    for (std::size_t k = row * stride; k < row * stride + side; k += width) {
      const auto is_state = hn::IfThenElseZero(hn::Eq(hn::LoadU(bytes, tile + k), wanted), one);
      hn::StoreU(hn::Xor(is_state, others), bytes, tile + k);
    }
}

// Of a tile whose bytes are not 0 where a pixel is known, with known ones around it. Squares of side k + 1 are
// where squares of side k begin at a pixel and at the three after it: so sides are counted up all over the tile.
void count_tile(std::uint8_t* tile, std::uint8_t* squares) {
  constexpr std::size_t side = KnownPixels::side, stride = KnownPixels::stride;
  constexpr std::uint8_t most = KnownPixels::most, run_unit = KnownPixels::run_unit;
  const auto one = hn::Set(bytes, 1);
  std::fill_n(squares, (side + 1) * stride, std::uint8_t{1});
  for (std::size_t row = 0; row < side; ++row)
    for (std::size_t k = row * stride; k < row * stride + side; k += width) {
      const auto known = hn::Min(hn::LoadU(bytes, tile + k), one);
      hn::StoreU(known, bytes, tile + k);
      hn::StoreU(known, bytes, squares + k);
    }
  bool any = true;
  for (int size = 2; size <= KnownPixels::most && any; ++size) {
    auto all = hn::Zero(bytes);
    for (std::size_t row = 0; row < side; ++row)
      for (std::size_t k = 0; k < side; k += width) {
        std::uint8_t *const here = squares + row * stride + k, *const below = here + stride;
        const auto larger = hn::And(hn::And(hn::LoadU(bytes, here), hn::LoadU(bytes, here + 1)),
                                    hn::And(hn::LoadU(bytes, below), hn::LoadU(bytes, below + 1)));
        hn::StoreU(larger, bytes, here);
        std::uint8_t* const sides = tile + row * stride + k;
        hn::StoreU(hn::Add(hn::LoadU(bytes, sides), larger), bytes, sides);
        all = hn::Or(all, larger);
      }
    any = !hn::AllTrue(bytes, hn::Eq(all, hn::Zero(bytes)));
  }
  for (std::size_t k = 0; k < side; k += width) {
    auto run = hn::Set(bytes, most);
    for (std::size_t row = side; row-- > 0;) {
      std::uint8_t* const sides = tile + row * stride + k;
      const auto square = hn::LoadU(bytes, sides);
      run = hn::IfThenZeroElse(hn::Eq(square, hn::Zero(bytes)), hn::Min(hn::Add(run, one), hn::Set(bytes, most)));
      auto units = run;
      for (int unit = 1; unit < run_unit; unit *= 2) units = hn::Add(units, units);
      hn::StoreU(hn::Add(square, units), bytes, sides);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace ifsm::core
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ifsm::core {

HWY_EXPORT(mark_tile);
HWY_EXPORT(count_tile);

void KnownPixels::begin(const std::uint8_t* states, std::int64_t stride, std::int64_t width, std::int64_t height,
                        std::uint8_t state, bool same) {
  const auto known = static_cast<std::uint8_t>(same ? state : state + 1);
  bytes_.fill(most * run_unit + most);
  for (std::size_t row = 0; row < side; ++row) {
    std::uint8_t* const to = std::fill_n(bytes_.data() + row * KnownPixels::stride, side, known) - side;
    if (const auto of_states = static_cast<std::int64_t>(row); of_states < height)
      std::copy_n(states + of_states * stride, width, to);
  }
  HWY_DYNAMIC_DISPATCH(mark_tile)(bytes_.data(), state, same);
  count();
}

void KnownPixels::count() { HWY_DYNAMIC_DISPATCH(count_tile)(bytes_.data(), squares_.data()); }

void KnownPixels::renew(std::size_t column, std::size_t row) {
  std::uint8_t& byte = bytes_[row * stride + column];
  if (byte == 0) return;
  const std::uint8_t *const right = &byte + 1, *const below = &byte + stride;
  const auto square_of = [](std::uint8_t b) { return b % run_unit; };
  const int square = std::min({square_of(*right), square_of(*below), square_of(below[1]), most - 1}) + 1;
  const int run = std::min(*below / run_unit, most - 1) + 1;
  byte = static_cast<std::uint8_t>(run * run_unit + square);
}

// Runs and squares that begin at most two above or to the left of it grow at once, others now and then.
void KnownPixels::add(std::size_t column, std::size_t row) {
  bytes_[row * stride + column] = 1;
  constexpr std::size_t near = 3;
  for (std::size_t up = 0; up < near && up <= row; ++up)
    for (std::size_t left = 0; left < near && left <= column; ++left) renew(column - left, row - up);
  constexpr int many = 1 << 10;
  if (++added_ % many == 0) count();
}

bool KnownPixels::are_known(std::size_t first_column, std::size_t last_column, std::size_t first_row,
                            std::size_t last_row) const {
  for (std::size_t row = first_row; row <= last_row; ++row)
    if (std::memchr(&bytes_[row * stride + first_column], 0, last_column - first_column + 1) != nullptr) return false;
  return true;
}

}  // namespace ifsm::core
#endif
