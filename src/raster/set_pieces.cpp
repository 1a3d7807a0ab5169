#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/set_pieces.cpp"
#include <hwy/foreach_target.h>  // compiles this file once a target
// The order matters: highway.h after foreach_target.h.
#include <hwy/highway.h>

#include "raster/compress-inl.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "base/error.h"
#include "raster/set_pieces.h"

// What all targets share; this file is read once a target.
#ifndef IFSM_RASTER_SET_PIECES_ONCE
#define IFSM_RASTER_SET_PIECES_ONCE
namespace ifsm::core {

// Pieces that go through a map together, on every machine; a whole number of vectors.
constexpr std::size_t pieces_per_block = 32;

// Pieces' numbers a … f, and the lengths of their words, each in an array of its own.
constexpr std::size_t piece_numbers = 7;
struct PieceBlock {
  alignas(64) std::array<std::array<double, pieces_per_block>, piece_numbers> of;
  std::size_t size;
};

class PieceStack {
 public:
  std::size_t size() const { return size_; }
  void push(const Piece& p) {
    make_room(1);
    const std::array<double, piece_numbers> numbers{p.a, p.b, p.c, p.d, p.e, p.f, 0};
    for (std::size_t k = 0; k < piece_numbers; ++k) at(k)[0] = numbers[k];
    grow(1);
  }
  void pop(PieceBlock& block) {
    block.size = std::min(size_, pieces_per_block);
    size_ -= block.size;
    for (std::size_t k = 0; k < piece_numbers; ++k) std::copy_n(at(k), block.size, block.of[k].begin());
  }
  // Where the next piece's number is to be written.
  double* at(std::size_t number) { return numbers_.data() + number * room_ + size_; }
  void grow(std::size_t pieces) { size_ += pieces; }
  // For so many, and for what vectors write beyond.
  void make_room(std::size_t pieces) {
    const std::size_t needed = size_ + pieces + pieces_per_block;
    if (needed <= room_) return;
    const std::size_t room = 2 * needed;
    std::vector<double> numbers(piece_numbers * room);
    for (std::size_t k = 0; k < piece_numbers; ++k)
      std::copy_n(numbers_.data() + k * room_, size_, numbers.data() + k * room);
    numbers_.swap(numbers);
    room_ = room;
  }

 private:
  std::vector<double> numbers_;
  std::size_t size_ = 0, room_ = 0;
};

// Pixels of the tile that a piece tells about.
struct Told {
  std::int32_t first_column, end_column, first_row, end_row;
  Meets state;
};

}  // namespace ifsm::core
#endif

HWY_BEFORE_NAMESPACE();
namespace ifsm::core {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

const hn::CappedTag<double, 8> reals;
const hn::RebindToUnsigned<decltype(reals)> words;
const hn::Rebind<std::int32_t, decltype(reals)> integers;
using Reals = hn::Vec<decltype(reals)>;
using Integers = hn::Vec<decltype(integers)>;
using Eighths = hn::Vec<decltype(words)>;
constexpr std::size_t width = hn::MaxLanes(decltype(reals)());

HWY_INLINE Reals set(double value) { return hn::Set(reals, value); }
HWY_INLINE Integers set(std::int32_t value) { return hn::Set(integers, value); }

template <class Tag, class Mask>
HWY_INLINE std::uint32_t bits_of(const Tag tag, const Mask mask) {
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(tag, mask, bits);
  return bits[0];
}

struct Pieces {
  Reals a, b, c, d, e, f, length;
};

// From here to there, along one axis.
struct Extent {
  Reals from, to;
};

// Of the direction (a, b), lane by lane: see Eight.
HWY_INLINE Eighths eighth_of(const Reals a, const Reals b) {
  const auto sign = [](const Reals v) { return hn::ShiftRight<63>(hn::BitCast(words, v)); };
  const auto steep = hn::RebindMask(words, hn::Gt(hn::Abs(b), hn::Abs(a)));
  return hn::Or(hn::Or(sign(a), hn::ShiftLeft<1>(sign(b))), hn::IfThenElseZero(steep, hn::Set(words, 4)));
}

// Points by eighth. In two registers where those hold eight numbers, else in memory.
class EightPoints {
 public:
  // Those of the directions themselves, or of the opposite ones.
  EightPoints(const Eight& points, bool opposite) : memory_(points) {
    constexpr std::size_t both_signs = 3;
    for (std::size_t k = 0; k < 8 && opposite; ++k)
      memory_.x[k] = points.x[k ^ both_signs], memory_.y[k] = points.y[k ^ both_signs];
  }

  // The point's product with (a, b).
  HWY_INLINE Reals along(const Eighths eighth, const Reals a, const Reals b) const {
    return hn::Add(hn::Mul(a, at(memory_.x, eighth)), hn::Mul(b, at(memory_.y, eighth)));
  }

 private:
  HWY_INLINE static Reals at(const std::array<double, 8>& numbers, const Eighths eighth) {
    if constexpr (width == 8)
      return hn::TableLookupLanes(hn::Load(reals, numbers.data()), hn::IndicesFromVec(reals, eighth));
    const hn::RebindToSigned<decltype(reals)> indices;
    return hn::GatherIndex(reals, numbers.data(), hn::BitCast(indices, eighth));
  }

  Eight memory_;
};

// Where pieces lie, rounding included, and the eighths of the directions in which they reach far.
struct Place {
  Eighths across, down;
  Extent x, y;
};

class Search {
 public:
  Search(const InPixels& attractor, double tolerance, const Tile& tile, const Watch& watch)
      : attractor_(attractor),
        tolerance_(tolerance),
        smallest_(tolerance),
        tile_(tile),
        watch_(watch),
        corners_(attractor.corners, false),
        opposite_corners_(attractor.corners, true),
        points_(attractor.points, false),
        opposite_points_(attractor.points, true),
        known_(known_where(tile, [](Meets state) { return state == Meets::yes; }).data()) {}

  // What comes near a pixel's edge may have left it undecided before a point inside was seen. Such pixels are looked at
  // again, in pieces that are larger: of those that have a point inside, nearly all are found.
  void run() {
    follow();
    if (!doubts_) return;
    const auto known = known_where(tile_, [](Meets state) { return state != Meets::undecided; });
    known_ = KnownPixels(known.data());
    constexpr double larger = .25;
    smallest_ = std::max(larger, tolerance_);
    again_ = true;
    follow();
  }

 private:
  // Depth first, in blocks.
  void follow() {
    Piece whole = attractor_.whole;
    whole.e -= static_cast<double>(tile_.left), whole.f -= static_cast<double>(tile_.top);
    open_.push(whole);
    while (open_.size() != 0) {
      constexpr std::int64_t between = 1 << 8;
      if (++blocks_ % between == 0) watch_.poll();
      open_.pop(block_);
      check_lengths();
      for (std::size_t k = 0; k < block_.size; k += width) look_up_points(piece(k), block_.size - k);
      take_notes();
      for (const Piece& map : attractor_.maps) {
        open_.make_room(pieces_per_block);
        for (std::size_t k = 0; k < block_.size; k += width) look_at(child(map, piece(k)), block_.size - k);
      }
      take_notes();
    }
  }

  // From the first pixels to those after the last, of the tile's; none where a piece misses it.
  struct Box {
    Integers c0, c1, r0, r1;
  };
  HWY_INLINE static Box box_of(const Place& at) {
    const auto pixel = [](const Reals coordinate) {
      return hn::DemoteTo(integers, hn::Min(hn::Max(coordinate, set(0.0)), set(side)));
    };
    const Reals one = set(1.0);
    return {pixel(at.x.from), pixel(hn::Add(at.x.to, one)), pixel(at.y.from), pixel(hn::Add(at.y.to, one))};
  }

  // And all that lies beyond the window.
  template <class Is>
  static std::vector<std::uint8_t> known_where(const Tile& tile, const Is& is) {
    constexpr std::size_t side = KnownPixels::side;
    std::vector<std::uint8_t> known(side * side, 1);
    for (std::int64_t row = 0; row < tile.height; ++row)
      for (std::int64_t column = 0; column < tile.width; ++column)
        known[static_cast<std::size_t>(row) * side + static_cast<std::size_t>(column)] =
            is(tile.first[row * tile.stride + column]) ? 1 : 0;
    return known;
  }

  void check_lengths() const {
    auto most = hn::Zero(reals);
    for (std::size_t k = 0; k < pieces_per_block; k += width)
      most = hn::Max(most, hn::Load(reals, &block_.of[piece_numbers - 1][k]));
    if (hn::AllTrue(reals, hn::Lt(most, set(double{InPixels::longest_word})))) return;
    throw Error(Status::limit, "tolerance",
                "Pieces of words of " + std::to_string(InPixels::longest_word) +
                    " maps are still larger than the tolerance: the maps shrink too slowly for " +
                    "proofs; give a larger tolerance, up to 1, larger pixels, or count points instead.")
        .with(tolerance_);
  }

  // Of the block, from k on.
  HWY_INLINE Pieces piece(std::size_t k) const {
    const auto numbers = [&](std::size_t number) { return hn::Load(reals, &block_.of[number][k]); };
    return {numbers(0), numbers(1), numbers(2), numbers(3), numbers(4), numbers(5), numbers(6)};
  }
  HWY_INLINE static Pieces child(const Piece& m, const Pieces& p) {
    const auto product = [](const Reals a, double c, const Reals b, double d) {
      return hn::Add(hn::Mul(a, set(c)), hn::Mul(b, set(d)));
    };
    return {product(p.a, m.a, p.b, m.c),
            product(p.a, m.b, p.b, m.d),
            product(p.c, m.a, p.d, m.c),
            product(p.c, m.b, p.d, m.d),
            hn::Add(product(p.a, m.e, p.b, m.f), p.e),
            hn::Add(product(p.c, m.e, p.d, m.f), p.f),
            hn::Add(p.length, set(1.0))};
  }
  HWY_INLINE Place place(const Pieces& p) const {
    const Eighths across = eighth_of(p.a, p.b), down = eighth_of(p.c, p.d);
    return {across, down, extent(p.e, opposite_corners_.along(across, p.a, p.b), corners_.along(across, p.a, p.b)),
            extent(p.f, opposite_corners_.along(down, p.c, p.d), corners_.along(down, p.c, p.d))};
  }
  HWY_INLINE Extent extent(const Reals middle, const Reals from, const Reals to) const {
    const Reals rounding = set(attractor_.rounding);
    return {hn::Sub(hn::Add(middle, from), rounding), hn::Add(hn::Add(middle, to), rounding)};
  }

  // Each one of `count` is done with, for it misses the tile or tells nothing more, or is left open. Which it is nobody
  // can foresee: there is but one branch, hardly ever taken.
  HWY_INLINE void look_at(const Pieces& p, std::size_t count) {
    const Place at = place(p);
    const Box box = box_of(at);
    const Integers columns = hn::Sub(box.c1, box.c0), rows = hn::Sub(box.r1, box.r0);
    const auto touch = hn::Gt(hn::Min(columns, rows), set(0));
    std::uint32_t open = bits_of(integers, hn::And(touch, hold_unknown(box, columns, rows))) & first(count);
    const std::uint32_t small = open & bits_of(reals, hn::Le(size(at), set(smallest_)));
    const std::uint32_t one = open & bits_of(integers, hn::Eq(hn::Max(columns, rows), set(1)));
    if ((small | one) != 0) open = settle(p, at, box, open, small, one);
    leave_open(p, open);
  }
  HWY_INLINE static std::uint32_t first(std::size_t count) { return count < width ? (1U << count) - 1 : all_lanes; }

  // Those that lie in one pixel, or are small. Returns what is still open.
  HWY_NOINLINE std::uint32_t settle(const Pieces& p, const Place& at, const Box& box, std::uint32_t open,
                                    std::uint32_t small, std::uint32_t one) {
    const std::uint32_t met = one & bits_of(reals, within(at.x, at.y));
    tell(met, box, Meets::yes);
    small &= ~met;
    look_up_points(p, at, small);
    if (!again_) tell(small, box, Meets::undecided);
    return open & ~(met | small);
  }
  HWY_INLINE static Reals size(const Place& at) {
    return hn::Max(hn::Sub(at.x.to, at.x.from), hn::Sub(at.y.to, at.y.from));
  }

  // Points of the pieces, which may lie in pixels that are not known to be met.
  HWY_INLINE void look_up_points(const Pieces& p, std::size_t count) {
    const Place at = place(p);
    constexpr double few = 4;  // pixels: points of larger pieces tell little
    look_up_points(p, at, bits_of(reals, hn::And(hn::FirstN(reals, count), hn::Lt(size(at), set(few)))));
  }
  HWY_INLINE void look_up_points(const Pieces& p, const Place& at, std::uint32_t which) {
    if (which == 0) return;
    look_up(points_, at.across, p, which);
    look_up(opposite_points_, at.across, p, which);
    look_up(points_, at.down, p, which);
    look_up(opposite_points_, at.down, p, which);
  }

  HWY_INLINE static hn::Mask<decltype(reals)> within(const Extent& x, const Extent& y) {
    return hn::And(hn::And(hn::Ge(x.from, set(0.0)), hn::Lt(x.to, set(side))),
                   hn::And(hn::Ge(y.from, set(0.0)), hn::Lt(y.to, set(side))));
  }

  HWY_INLINE void look_up(const EightPoints& points, const Eighths eighth, const Pieces& p, std::uint32_t which) {
    const Reals along_x = points.along(eighth, p.a, p.b), along_y = points.along(eighth, p.c, p.d);
    const Place at{eighth, eighth, extent(p.e, along_x, along_x), extent(p.f, along_y, along_y)};
    const Box box = box_of(at);
    const auto certain = hn::Eq(hn::Max(hn::Sub(box.c1, box.c0), hn::Sub(box.r1, box.r0)), set(1));
    const auto unknown = hn::Eq(hn::And(read(box), set(0xFF)), set(0));
    which &= bits_of(reals, within(at.x, at.y)) & bits_of(integers, hn::And(certain, unknown));
    if (which != 0) tell(which, box, Meets::yes);
  }

  // What is known from the first pixel on, and from the three to its right.
  HWY_INLINE Integers read(const Box& box) const {
    const Integers at = hn::Add(hn::Mul(box.r0, set(std::int32_t{KnownPixels::stride})), box.c0);
    return hn::GatherOffset(integers, reinterpret_cast<const std::int32_t*>(known_.bytes()), at);
  }
  // Is one of the pixels not known? Where there are none, anything.
  HWY_INLINE hn::Mask<decltype(integers)> hold_unknown(const Box& box, const Integers columns,
                                                       const Integers rows) const {
    const hn::RebindToUnsigned<decltype(integers)> counts;
    const Integers read = this->read(box);
    const auto larger = hn::Gt(hn::Max(columns, rows), hn::And(read, set(KnownPixels::most)));  // than what is known
    // Four columns' runs at once: where one is shorter than the box, of at most 128 rows, the bit above it is lost.
    static_assert(KnownPixels::side <= 0x80);
    const auto above = hn::Set(counts, 0x80808080);
    const auto runs = hn::And(hn::ShiftRight<4>(hn::BitCast(counts, read)), hn::Set(counts, 0x0F0F0F0F));
    const auto needed = hn::BitCast(counts, hn::Mul(rows, set(0x01010101)));
    const auto missing = hn::AndNot(hn::Sub(hn::Or(runs, above), needed), above);
    // Bytes beside a box of three columns or fewer; of more, all four count, and nothing is shifted by a whole word.
    const auto beside =
        hn::Shl(hn::Set(counts, 0xFFFFFFFF), hn::BitCast(counts, hn::ShiftLeft<3>(hn::Min(columns, set(3)))));
    const auto of_box =
        hn::IfThenElse(hn::RebindMask(counts, hn::Gt(columns, set(3))), missing, hn::AndNot(beside, missing));
    const auto longer = hn::RebindMask(integers, hn::Ne(of_box, hn::Zero(counts)));
    return hn::And(larger, hn::Or(longer, hn::Gt(columns, set(4))));
  }

  HWY_INLINE void leave_open(const Pieces& p, std::uint32_t which) {
    const Compress<decltype(reals)> compress(which);
    const auto put = [&](std::size_t number, const Reals v) { compress(v, open_.at(number)); };
    put(0, p.a), put(1, p.b), put(2, p.c), put(3, p.d), put(4, p.e), put(5, p.f), put(6, p.length);
    open_.grow(static_cast<std::size_t>(std::popcount(which)));
  }

  HWY_NOINLINE void tell(std::uint32_t which, const Box& box, Meets state) {
    HWY_ALIGN std::int32_t c0[width], c1[width], r0[width], r1[width];
    hn::Store(box.c0, integers, c0), hn::Store(box.c1, integers, c1);
    hn::Store(box.r0, integers, r0), hn::Store(box.r1, integers, r1);
    for (; which != 0; which &= which - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(which));
      told_.push_back({c0[lane], c1[lane], r0[lane], r1[lane], state});
    }
  }
  // In an order that is not that of vectors, what is met first.
  void take_notes() {
    const auto rank = [](const Told& t) {
      return std::make_tuple(t.state == Meets::yes ? 0 : 1, t.first_row, t.first_column, t.end_row, t.end_column);
    };
    if (told_.size() > 1)
      std::sort(told_.begin(), told_.end(), [&](const Told& a, const Told& b) { return rank(a) < rank(b); });
    for (const Told& told : told_) take_note(told);
    told_.clear();
  }
  void take_note(const Told& told) {
    for (std::int32_t row = told.first_row; row < told.end_row; ++row)
      for (std::int32_t column = told.first_column; column < told.end_column; ++column) {
        const auto c = static_cast<std::size_t>(column), r = static_cast<std::size_t>(row);
        if (known_.is_known(c, r)) continue;
        tile_.first[row * tile_.stride + column] = told.state;
        doubts_ = doubts_ || told.state == Meets::undecided;
        known_.add(c, r);
      }
  }

  static constexpr double side = KnownPixels::side;
  static constexpr std::uint32_t all_lanes = (1U << width) - 1;
  const InPixels& attractor_;
  double tolerance_, smallest_;  // pieces of that size are not looked into
  bool doubts_ = false, again_ = false;
  Tile tile_;
  const Watch& watch_;
  EightPoints corners_, opposite_corners_, points_, opposite_points_;
  KnownPixels known_;
  PieceStack open_;
  PieceBlock block_{};
  std::vector<Told> told_;
  std::int64_t blocks_ = 0;
};

void search(const InPixels& attractor, double tolerance, const Tile& tile, const Watch& watch) {
  Search(attractor, tolerance, tile, watch).run();
}

}  // namespace HWY_NAMESPACE
}  // namespace ifsm::core
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ifsm::core {

HWY_EXPORT(search);

void search_tile(const InPixels& attractor, double tolerance, const Tile& tile, const Watch& watch) {
  HWY_DYNAMIC_DISPATCH(search)(attractor, tolerance, tile, watch);
}

}  // namespace ifsm::core
#endif
