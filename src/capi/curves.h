// Curves and points as C hands them over.
#pragma once

#include <ifsm.h>

#include <string>

#include "linalg/points.h"

namespace ifsm::core {

// Checks an ifsm_curve and copies its points. Faults of curve k of several are told as those of "curves[k].points".
Points samples_of(const ifsm_curve& curve, const std::string& prefix = "");
// The same for a control polygon, which may be a single point.
Points polygon_of(const ifsm_curve& curve);
bool is_closed(const ifsm_curve& curve, const std::string& prefix = "");

// `needed` points of a given dimension, told by a pointer and a count of doubles.
Points points_of(const double* values, std::int64_t count, std::int64_t needed, std::int64_t dimension,
                 const char* argument);

// For deliver(): interleaved.
inline void copy_out(const Points& points, std::int64_t, double* to) { points.interleave(to); }

}  // namespace ifsm::core
