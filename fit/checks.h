// What every fit of the filter refuses.
#pragma once

#include <vector>

#include "curve/filter.h"
#include "fit/curve.h"

namespace ifsm::core {

// At least one curve, all of one dimension.
void require_curves(const std::vector<FitCurve>& curves);

// Joined, and with few enough free entries.
void require_start(const FilterPtr& start);

// Vectors that a curve's model holds, control points and details; the fewest of several.
Index vectors_of(const FitCurve& curve, const Shape& shape);
Index fewest_vectors(const std::vector<FitCurve>& curves, const Shape& shape);

// Budgets that hold the control points, and not more than the smallest of the curves.
void require_budgets(const std::vector<Index>& budgets, const Shape& shape, const std::vector<FitCurve>& curves);
void require_least_budgets(const std::vector<Index>& budgets, const Shape& shape);

}  // namespace ifsm::core
