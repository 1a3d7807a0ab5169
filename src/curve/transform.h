// Synthesis and analysis of one coordinate (paper 002, eqs. (6) and (7)).
#pragma once

#include <span>

#include "curve/filter.h"

namespace ifsm::core {

using Line = std::span<double>;  // all polygons of a level, one coordinate
using ConstLine = std::span<const double>;

// (P_θ0 | … | P_θ,N-1) = (P_θ | δP_θ) R for every node θ: a level's line and its details make the next level's line.
// Lengths are Shape's line_length(level), detail_count(level), line_length(level + 1); nothing may overlap.
void synthesize_level(const Filter& filter, ConstLine coarse, ConstLine details, Line fine);

// (P_θ | δP_θ) = (P_θ0 | … | P_θ,N-1) R^-1: the inverse.
void analyze_level(const Filter& filter, ConstLine fine, Line coarse, Line details);

// All levels at once, coarsest details first, with the bits of one level after the other. A subtree whose finest line
// fits into the cache is finished before the next one is begun, and subtrees share the threads.
void synthesize(const Filter& filter, ConstLine polygon, std::span<const ConstLine> details, Line fine);
// The largest coordinates; not finite when one of them is not.
struct Extent {
  double polygons, details;
};
// The inverse. Returns the extent of all polygons but the finest, and of all details.
Extent analyze(const Filter& filter, ConstLine fine, Line polygon, std::span<const Line> details);

// The polygons alone, by any R^-1: for judging filters before they are made.
void coarsen_level(const Shape& shape, const RowMatrix& inverse, ConstLine fine, Line coarse);

// The same by the formula as it stands: what the fast ones are tested against.
namespace plain {
void synthesize_level(const Filter& filter, ConstLine coarse, ConstLine details, Line fine);
void analyze_level(const Filter& filter, ConstLine fine, Line coarse, Line details);
}  // namespace plain

}  // namespace ifsm::core
