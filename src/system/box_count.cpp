#include "system/box_count.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "base/error.h"
#include "system/reach.h"

namespace ifsm::core {
namespace {

using Cell = std::array<std::int64_t, 3>;

// The cells of 2^finest a side, a byte each; the plane has one layer.
class Cells {
 public:
  Cells(int dimension, int finest)
      : side_(std::int64_t{1} << finest),
        layers_(dimension == 3 ? side_ : 1),
        met_(static_cast<std::size_t>(side_ * side_ * layers_), 0) {}

  std::int64_t side() const { return side_; }
  std::uint8_t& operator()(const Cell& c) {
    return met_[static_cast<std::size_t>((c[2] * side_ + c[1]) * side_ + c[0])];
  }

  std::int64_t count() const { return std::count(met_.begin(), met_.end(), std::uint8_t{1}); }

  bool all_met(const Cell& low, const Cell& high) {
    for (std::int64_t z = low[2]; z <= high[2]; ++z)
      for (std::int64_t y = low[1]; y <= high[1]; ++y)
        for (std::int64_t x = low[0]; x <= high[0]; ++x)
          if ((*this)({x, y, z}) == 0) return false;
    return true;
  }

  // Cells twice as wide, met where one of theirs is.
  void coarsen() {
    const std::int64_t half = side_ / 2, layers = std::max<std::int64_t>(layers_ / 2, 1);
    Cells wide(*this);
    wide.side_ = half, wide.layers_ = layers;
    wide.met_.assign(static_cast<std::size_t>(half * half * layers), 0);
    for (std::int64_t z = 0; z < layers_; ++z)
      for (std::int64_t y = 0; y < side_; ++y)
        for (std::int64_t x = 0; x < side_; ++x)
          if ((*this)({x, y, z}) != 0) wide({x / 2, y / 2, z / 2}) = 1;
    *this = std::move(wide);
  }

 private:
  std::int64_t side_, layers_;
  std::vector<std::uint8_t> met_;
};

// Follows words to where their pieces lie in one cell, or in met ones, or are small.
class Counter {
 public:
  Counter(const System& system, int finest, const Box& box, double side)
      : dimension_(system.dimension()),
        maps_(system.active_maps()),
        cells_(system.dimension(), finest),
        low_(box.low),
        per_unit_(static_cast<double>(cells_.side()) / side),
        middle_((box.low + box.high) / 2),
        half_((box.high - box.low) / 2),
        point_(system.point()) {}

  Cells run(Watch& watch) {
    std::vector<Affine> open = {Affine::identity(dimension_)};
    for (std::int64_t steps = 0; !open.empty(); ++steps) {
      constexpr std::int64_t steps_per_poll = 1 << 12;
      if (steps % steps_per_poll == 0) watch.poll();
      const Affine piece = open.back();
      open.pop_back();
      if (decided(piece)) continue;
      for (const Affine& map : maps_) open.push_back(piece * map);
    }
    return std::move(cells_);
  }

 private:
  Cell cell_of(const Vector3& x) const {
    Cell cell{};
    for (int axis = 0; axis < dimension_; ++axis) {
      const auto place = static_cast<std::int64_t>(std::floor((x(axis) - low_(axis)) * per_unit_));
      cell[static_cast<std::size_t>(axis)] = std::clamp(place, std::int64_t{0}, cells_.side() - 1);
    }
    return cell;
  }

  bool decided(const Affine& piece) {
    constexpr double small = 1. / 8;  // of a cell
    const Vector3 centre = piece(middle_), half = piece.linear.cwiseAbs() * half_;
    const Cell low = cell_of(centre - half), high = cell_of(centre + half);
    if (low == high || half.maxCoeff() * 2 * per_unit_ < small) {
      cells_(cell_of(piece(point_))) = 1;
      return true;
    }
    // A look at more cells costs more than the pieces that it may save.
    constexpr std::int64_t few = 4;
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (high[axis] - low[axis] >= few) return false;
    return cells_.all_met(low, high);
  }

  int dimension_;
  std::vector<Affine> maps_;
  Cells cells_;
  Vector3 low_;
  double per_unit_;
  Vector3 middle_, half_, point_;
};

struct TightBox {
  Box box;
  double tolerance;
};

// Tight, since grids and shapes often share their sides; less so where that takes too many pieces.
TightBox tight_box(const System& system) {
  const auto within = [&](double share) -> TightBox {
    const double tolerance = std::max(share * system.enclosure().axes.norm(), std::numeric_limits<double>::min());
    return {bounding_box(system, tolerance), tolerance};
  };
  try {
    return within(1e-12);
  } catch (const Error& error) {
    if (error.status() != Status::limit) throw;
    return within(1e-6);
  }
}

}  // namespace

BoxCounts count_boxes(const System& system, int finest, Watch& watch) {
  constexpr int coarsest = 4;  // of the fit
  in_range(finest, coarsest + 2, system.dimension() == 2 ? 13 : 9, "finest");
  const auto [box, tolerance] = tight_box(system);
  const double side = (box.high - box.low).maxCoeff();
  if (!(side > 4 * tolerance))
    throw Error(Status::shape, "system",
                "The attractor is a single point, which has no scales; give maps that move it.");
  Cells cells = Counter(system, finest, box, side).run(watch);
  BoxCounts found{};
  for (int level = finest; level > 0; --level) {
    found.sides.push_back(side / static_cast<double>(cells.side()));
    found.counts.push_back(static_cast<double>(cells.count()));
    cells.coarsen();
  }
  std::reverse(found.sides.begin(), found.sides.end());
  std::reverse(found.counts.begin(), found.counts.end());
  std::vector<double> x, y;
  for (std::size_t k = coarsest - 1; k < found.sides.size(); ++k)
    x.push_back(std::log(found.sides[k])), y.push_back(std::log(found.counts[k]));
  found.line = trend(x, y);
  watch.finish();
  return found;
}

}  // namespace ifsm::core
