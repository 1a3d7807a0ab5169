// The curve at parameters, and addresses of parameters.
#pragma once

#include <span>
#include <vector>

#include "curve/model.h"

namespace ifsm::core {

enum class Curve : std::int32_t { polyline = 0, limit = 1 };

// Finite; open curves': 0 … 1. Errors name "parameters" and the first that is wrong.
void require_parameters(const Model& model, std::span<const double> parameters);

// Points of the curve. Open: parameters 0 … 1, a range error names the first outside. Closed: any, modulo 1.
Points evaluate(const Model& model, Curve curve, std::span<const double> parameters);

// The control polygon of one node, from the centre, without synthesising the rest; the bits of line().
Points polygon_of(const Model& model, int level, Index node);

// The first symbols of a parameter's address; the parameters [first, last] that an address covers.
std::vector<std::int32_t> address(const Model& model, double parameter, int length);
struct Interval {
  double first, last;
};
Interval interval(const Model& model, std::span<const std::int32_t> symbols);

}  // namespace ifsm::core
