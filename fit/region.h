// Where a fitted filter may go. R^-1 is bounded by R's condition number, its powers are not: analysis applies R^-1
// level after level, so coarse polygons are looked at themselves.
#pragma once

#include <span>

#include "curve/model.h"

namespace ifsm::core {

// How far a fit may go from its start for the sake of its objective.
struct Limits {
  double condition = 1e2;  // of R, or twice the start's: beyond, details grow and cancel, and rounding passes 1e-12
  double reach = 0.75;     // of coarse polygons from the centre, in the curve's diagonals, or the start's: beyond, they
                           // are poor handles, and far beyond, rounding shows
};

// Of stages that look for no handles: where rounding begins to show.
inline constexpr double farthest_reach = 3;

// A curve whose polygons must stay near it under every filter on the way.
struct Neighbourhood {
  const Points* line;  // the finest line, from the centre: the same under every filter
  int levels;
  double largest;  // coordinate of a polygon, at most

  // `reach` diagonals, or what the start's own polygons reach.
  static Neighbourhood of(const Model& start, const Points& line, double reach);
};

// Are all coarse polygons of all curves in their neighbourhoods? Beyond, they are no handles, and rounding shows.
bool stay_near(const Shape& shape, const RowMatrix& matrix, std::span<const Neighbourhood> curves);

}  // namespace ifsm::core
