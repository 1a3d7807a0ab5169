#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/set_pieces.cpp"
#include <hwy/foreach_target.h>  // compiles this file once a target
// The order matters: highway.h after foreach_target.h.
#include <hwy/highway.h>

#include "raster/compress-inl.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/error.h"
#include "raster/note.h"
#include "raster/piece_stack.h"
#include "raster/precision.h"
#include "raster/set_pieces.h"

HWY_BEFORE_NAMESPACE();
namespace ifsm::core {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

template <class Tag, class Mask>
HWY_INLINE std::uint32_t bits_of(const Tag tag, const Mask mask) {
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(tag, mask, bits);
  return bits[0] | static_cast<std::uint32_t>(bits[1]) << 8;
}

// Vectors of 64 bytes, or as long as there are; pieces in doubles or in floats.
template <class Real>
class Search {
  static constexpr hn::CappedTag<Real, 64 / sizeof(Real)> reals{};
  static constexpr hn::RebindToUnsigned<decltype(reals)> words{};
  static constexpr hn::Rebind<std::int32_t, decltype(reals)> integers{};
  using Tag = std::remove_const_t<decltype(reals)>;
  using Reals = hn::Vec<Tag>;
  using Words = hn::Vec<std::remove_const_t<decltype(words)>>;
  using Integers = hn::Vec<std::remove_const_t<decltype(integers)>>;
  using Masks = hn::Mask<Tag>;
  using IntegerMasks = hn::Mask<std::remove_const_t<decltype(integers)>>;
  static constexpr std::size_t width = hn::MaxLanes(Tag());
  static constexpr std::uint32_t all_lanes = (1U << width) - 1;

 public:
  Search(const InPixels& attractor, double tolerance, const Precision& precision, const Tile& tile, const Watch& watch)
      : attractor_(attractor),
        precision_(precision),
        tolerance_(tolerance),
        smallest_(tolerance),
        tile_(tile),
        watch_(watch),
        corners_(attractor.corners, false),
        opposite_corners_(attractor.corners, true),
        points_(attractor.points, false),
        opposite_points_(attractor.points, true),
        of_a_map_(static_cast<Real>(precision.of_a_map)) {
    const auto real = [](double number) { return static_cast<Real>(number); };
    for (const Piece& m : attractor.maps)
      maps_.push_back({real(m.a), real(m.b), real(m.c), real(m.d), real(m.e), real(m.f)});
  }

  // What comes near a pixel's edge may have left it undecided before a point inside was seen. Such pixels are looked at
  // again, in pieces that are larger, and in more than one: of those that have a point inside, nearly all are found.
  // False: rounding stood in the way; what is in the tile is true.
  bool run() {
    begin(Meets::yes, true);
    if (!descend()) return false;
    if (!doubts_) return true;
    begin(Meets::undecided, false);
    constexpr double larger = .25;
    smallest_ = std::max(larger, tolerance_);
    looks_ = many_looks;
    return descend();
  }

 private:
  static Reals set(double value) { return hn::Set(reals, static_cast<Real>(value)); }
  static Integers set(std::int32_t value) { return hn::Set(integers, value); }

  struct Map {
    Real a, b, c, d, e, f;
  };
  struct Pieces {
    Reals a, b, c, d, e, f, rounding;
  };

  // From here to there, along one axis.
  struct Extent {
    Reals from, to;
  };

  // Of the direction (a, b), lane by lane: see Eight.
  HWY_INLINE static Words eighth_of(const Reals a, const Reals b) {
    constexpr int sign_bit = 8 * sizeof(Real) - 1;
    const auto sign = [](const Reals v) { return hn::ShiftRight<sign_bit>(hn::BitCast(words, v)); };
    const auto steep = hn::RebindMask(words, hn::Gt(hn::Abs(b), hn::Abs(a)));
    return hn::Or(hn::Or(sign(a), hn::ShiftLeft<1>(sign(b))), hn::IfThenElseZero(steep, hn::Set(words, 4)));
  }

  // Points by eighth. In registers where those hold eight numbers, else in memory.
  class EightPoints {
   public:
    // Those of the directions themselves, or of the opposite ones.
    EightPoints(const Eight& points, bool opposite) {
      const std::size_t signs = opposite ? 3 : 0;
      for (std::size_t k = 0; k < x_.size(); ++k) {
        x_[k] = static_cast<Real>(points.x[k % 8 ^ signs]);
        y_[k] = static_cast<Real>(points.y[k % 8 ^ signs]);
      }
    }

    // The point's product with (a, b).
    HWY_INLINE Reals along(const Words eighth, const Reals a, const Reals b) const {
      return hn::Add(hn::Mul(a, at(x_, eighth)), hn::Mul(b, at(y_, eighth)));
    }

   private:
    using Numbers = std::array<Real, 64 / sizeof(Real)>;
    HWY_INLINE static Reals at(const Numbers& numbers, const Words eighth) {
      if constexpr (width >= 8)
        return hn::TableLookupLanes(hn::Load(reals, numbers.data()), hn::IndicesFromVec(reals, eighth));
      const hn::RebindToSigned<Tag> indices;
      return hn::GatherIndex(reals, numbers.data(), hn::BitCast(indices, eighth));
    }

    alignas(64) Numbers x_, y_;
  };

  // Where pieces lie, rounding included, and the eighths of the directions in which they reach far.
  struct Place {
    Words across, down;
    Extent x, y;
  };

  // Pixels of that state are known, or all others.
  void begin(Meets state, bool same) {
    looked_at_.fill(0);
    known_.begin(reinterpret_cast<const std::uint8_t*>(tile_.first), tile_.stride, tile_.width, tile_.height,
                 static_cast<std::uint8_t>(state), same);
  }

  // One by one, in doubles, while pieces are large.
  struct Large {
    Piece piece;
    int length;  // of its word
  };
  bool descend() {
    Piece whole = attractor_.whole;
    whole.e -= static_cast<double>(tile_.left), whole.f -= static_cast<double>(tile_.top);
    std::vector<Large> large{{whole, 0}};
    while (!large.empty()) {
      const auto [p, length] = large.back();
      large.pop_back();
      const double rounding = precision_.at_first + length * precision_.of_a_large_map;
      const double across = attractor_.across(p) + rounding, down = attractor_.down(p) + rounding;
      if (p.e + across < 0 || p.e - across >= side || p.f + down < 0 || p.f - down >= side) continue;
      const auto pixel = [](double place) { return static_cast<std::size_t>(std::clamp(place, 0.0, side - 1)); };
      if (known_.are_known(pixel(p.e - across), pixel(p.e + across), pixel(p.f - down), pixel(p.f + down))) continue;
      if (std::max(across, down) <= large_piece) {
        open_.push(p, rounding);
        if (open_.size() >= pieces_per_block && !follow()) return false;
        continue;
      }
      reckon(maps_.size());
      if (length == InPixels::longest_word) return false;
      for (const Piece& map : attractor_.maps) large.push_back({p * map, length + 1});
    }
    return follow();
  }

  // Depth first, in blocks.
  bool follow() {
    while (open_.size() != 0) {
      open_.pop(block_);
      reckon(block_.size * maps_.size());
      if (!block_is_exact()) return false;
      for (std::size_t k = 0; k < block_.size; k += width) look_up_points(piece(k), block_.size - k);
      take_notes();
      for (const Map& map : maps_) {
        open_.make_room(pieces_per_block);
        for (std::size_t k = 0; k < block_.size; k += width) look_at(child(map, piece(k)), block_.size - k);
      }
      take_notes();
    }
    return true;
  }

  // From the first pixels to those after the last, of the tile's; none where a piece misses it.
  struct Box {
    Integers c0, c1, r0, r1;
  };
  HWY_INLINE static Integers whole_part(const Reals v) {
    if constexpr (sizeof(Real) == sizeof(double)) {
      return hn::DemoteTo(integers, v);
    } else {
      // From its digits: those of 256 + v count in 2^-15.
      const Integers digits = hn::BitCast(integers, hn::Add(v, set(256.0)));
      return hn::Sub(hn::ShiftRight<15>(digits), set(0x43800000 >> 15));
    }
  }
  HWY_INLINE static Box box_of(const Place& at) {
    const auto pixel = [](const Reals coordinate) {
      return whole_part(hn::Min(hn::Max(coordinate, set(0.0)), set(side)));
    };
    const Reals one = set(1.0);
    return {pixel(at.x.from), pixel(hn::Add(at.x.to, one)), pixel(at.y.from), pixel(hn::Add(at.y.to, one))};
  }

  // Before so many pieces are followed.
  void reckon(std::size_t pieces) {
    constexpr std::size_t between = 1 << 15, most = std::size_t{1} << 32;
    const std::size_t before = std::exchange(followed_, followed_ + pieces);
    if (before / between != followed_ / between) watch_.poll();
    if (followed_ > most)
      throw Error(Status::limit, "tolerance",
                  "The tolerance " + text_of(tolerance_) +
                      " takes more pieces of the attractor than are looked at, for they lie over one another in this "
                      "window; give a larger one, up to 1, larger pixels, or count points instead.")
          .with(tolerance_);
  }

  // Are all of the block where they are said to be, and of a size that the numbers can follow?
  bool block_is_exact() const {
    const Reals half_x = set(attractor_.half[0]), half_y = set(attractor_.half[1]);
    auto off = hn::Zero(reals), reach = hn::Zero(reals);
    for (std::size_t k = 0; k < block_.size; k += width) {
      const Pieces p = piece(k);
      const auto half = [&](const Reals a, const Reals b) {
        return hn::Add(hn::Mul(hn::Abs(a), half_x), hn::Mul(hn::Abs(b), half_y));
      };
      const auto counts = hn::FirstN(reals, block_.size - k);
      off = hn::Max(off, hn::IfThenElseZero(counts, p.rounding));
      reach = hn::Max(reach, hn::IfThenElseZero(counts, hn::Max(half(p.a, p.b), half(p.c, p.d))));
    }
    return hn::AllTrue(reals, hn::And(hn::Le(off, set(precision_.at_most)), hn::Le(reach, set(precision_.farthest))));
  }

  // Of the block, from k on.
  HWY_INLINE Pieces piece(std::size_t k) const {
    const auto numbers = [&](std::size_t number) { return hn::Load(reals, &block_.of[number][k]); };
    return {numbers(0), numbers(1), numbers(2), numbers(3), numbers(4), numbers(5), numbers(6)};
  }
  HWY_INLINE Pieces child(const Map& m, const Pieces& p) const {
    const auto product = [](const Reals a, Real c, const Reals b, Real d) {
      return hn::Add(hn::Mul(a, hn::Set(reals, c)), hn::Mul(b, hn::Set(reals, d)));
    };
    return {product(p.a, m.a, p.b, m.c),
            product(p.a, m.b, p.b, m.d),
            product(p.c, m.a, p.d, m.c),
            product(p.c, m.b, p.d, m.d),
            hn::Add(product(p.a, m.e, p.b, m.f), p.e),
            hn::Add(product(p.c, m.e, p.d, m.f), p.f),
            hn::Add(p.rounding, hn::Set(reals, of_a_map_))};
  }
  HWY_INLINE Place place(const Pieces& p) const {
    const Words across = eighth_of(p.a, p.b), down = eighth_of(p.c, p.d);
    const auto x_from = opposite_corners_.along(across, p.a, p.b), x_to = corners_.along(across, p.a, p.b);
    const auto y_from = opposite_corners_.along(down, p.c, p.d), y_to = corners_.along(down, p.c, p.d);
    return {across, down, extent(p.e, x_from, x_to, p.rounding), extent(p.f, y_from, y_to, p.rounding)};
  }
  HWY_INLINE static Extent extent(const Reals middle, const Reals from, const Reals to, const Reals rounding) {
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
    look_up_both(at.across, p, small);
    look_up_both(at.down, p, small);
    tell(small, box, Meets::undecided);
    return open & ~(met | small);
  }
  HWY_INLINE static Reals size(const Place& at) {
    return hn::Max(hn::Sub(at.x.to, at.x.from), hn::Sub(at.y.to, at.y.from));
  }

  // Points of the pieces, which may lie in pixels that are not known to be met. Two of each: of more, the time they
  // take is more than what they save.
  HWY_INLINE void look_up_points(const Pieces& p, std::size_t count) {
    const Place at = place(p);
    constexpr double few = 4;  // pixels: points of larger pieces tell little
    look_up_both(at.across, p, bits_of(reals, hn::And(hn::FirstN(reals, count), hn::Lt(size(at), set(few)))));
  }
  HWY_INLINE void look_up_both(const Words eighth, const Pieces& p, std::uint32_t which) {
    if (which == 0) return;
    look_up(points_, eighth, p, which);
    look_up(opposite_points_, eighth, p, which);
  }

  HWY_INLINE static Masks within(const Extent& x, const Extent& y) {
    return hn::And(hn::And(hn::Ge(x.from, set(0.0)), hn::Lt(x.to, set(side))),
                   hn::And(hn::Ge(y.from, set(0.0)), hn::Lt(y.to, set(side))));
  }

  HWY_INLINE void look_up(const EightPoints& points, const Words eighth, const Pieces& p, std::uint32_t which) {
    const Reals along_x = points.along(eighth, p.a, p.b), along_y = points.along(eighth, p.c, p.d);
    const Place at{eighth, eighth, extent(p.e, along_x, along_x, p.rounding),
                   extent(p.f, along_y, along_y, p.rounding)};
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
  HWY_INLINE IntegerMasks hold_unknown(const Box& box, const Integers columns, const Integers rows) const {
    const hn::RebindToUnsigned<std::remove_const_t<decltype(integers)>> counts;
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
    const Compress<Tag> compress(which);
    Real* const to = open_.at(0);
    const std::size_t stride = open_.stride();
    const auto put = [&](std::size_t number, const Reals v) { compress(v, to + number * stride); };
    put(0, p.a), put(1, p.b), put(2, p.c), put(3, p.d), put(4, p.e), put(5, p.f), put(6, p.rounding);
    open_.grow(static_cast<std::size_t>(std::popcount(which)));
  }

  HWY_NOINLINE void tell(std::uint32_t which, const Box& box, Meets state) {
    HWY_ALIGN std::int32_t c0[width], c1[width], r0[width], r1[width];
    hn::Store(box.c0, integers, c0), hn::Store(box.c1, integers, c1);
    hn::Store(box.r0, integers, r0), hn::Store(box.r1, integers, r1);
    const auto size = [](std::int32_t number) { return static_cast<std::size_t>(number); };
    for (; which != 0; which &= which - 1) {
      const auto k = static_cast<std::size_t>(std::countr_zero(which));
      notes_.emplace_back(Note::Pixels{size(c0[k]), size(c1[k]), size(r0[k]), size(r1[k])}, state);
    }
  }
  void take_notes() {
    std::sort(notes_.begin(), notes_.end());
    for (const Note& note : notes_) take(note);
    notes_.clear();
  }
  void take(const Note& note) {
    const auto [first_column, end_column, first_row, end_row] = note.pixels();
    const Meets state = note.state();
    for (std::size_t row = first_row; row < end_row; ++row)
      for (std::size_t column = first_column; column < end_column; ++column) {
        if (known_.is_known(column, row)) continue;
        if (state == Meets::undecided && ++looked_at_[row * KnownPixels::side + column] < looks_) continue;
        tile_.first[static_cast<std::int64_t>(row) * tile_.stride + static_cast<std::int64_t>(column)] = state;
        doubts_ = doubts_ || state == Meets::undecided;
        known_.add(column, row);
      }
  }

  static constexpr double side = KnownPixels::side;
  const InPixels& attractor_;
  const Precision& precision_;
  double tolerance_, smallest_;  // pieces of that size are not looked into
  bool doubts_ = false;
  // So often is a pixel that stays undecided looked at: pieces that are alike may be more than can be followed.
  static constexpr std::uint16_t many_looks = 4096;
  std::uint16_t looks_ = 1;
  std::array<std::uint16_t, KnownPixels::side * KnownPixels::side> looked_at_{};
  Tile tile_;
  const Watch& watch_;
  EightPoints corners_, opposite_corners_, points_, opposite_points_;
  std::vector<Map> maps_;
  Real of_a_map_;
  KnownPixels known_;
  PieceStack<Real> open_;
  PieceBlock<Real> block_{};
  std::vector<Note> notes_;
  std::size_t followed_ = 0;  // pieces
};

void search(const InPixels& attractor, double tolerance, const Tile& tile, const Watch& watch) {
  const Precision fast = floats(attractor, tolerance), exact = doubles(attractor);
  if (floats_suffice(fast, attractor, tolerance) && Search<float>(attractor, tolerance, fast, tile, watch).run())
    return;
  if (Search<double>(attractor, tolerance, exact, tile, watch).run()) return;
  throw Error(Status::limit, "tolerance",
              "Pieces of words of " + std::to_string(InPixels::longest_word) +
                  " maps are still larger than the tolerance: the maps shrink too slowly for " +
                  "proofs; give a larger tolerance, up to 1, larger pixels, or count points instead.")
      .with(tolerance);
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
