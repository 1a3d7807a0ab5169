// How many vectors, control points and details together, a sketch of a curve may hold.
#pragma once

#include <vector>

#include "curve/filter.h"
#include "fit/curve.h"

namespace ifsm::core {

// Vectors that a curve's model holds, control points and details; the fewest of several.
Index vectors_of(const FitCurve& curve, const Shape& shape);
Index fewest_vectors(const std::vector<FitCurve>& curves, const Shape& shape);

// Budgets that hold the control points, and not more than the smallest of the curves.
void require_budgets(const std::vector<Index>& budgets, const Shape& shape, const std::vector<FitCurve>& curves);
void require_least_budgets(const std::vector<Index>& budgets, const Shape& shape);

}  // namespace ifsm::core
