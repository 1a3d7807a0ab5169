// Filters by name.
#pragma once

#include <string_view>

#include "curve/filter.h"

namespace ifsm::core {

// control_points and maps 0 choose the name's own. Range errors list the names, or the shapes a name has.
FilterPtr named_filter(std::string_view name, Topology topology, int control_points, int maps);

// Where a fit starts when nothing else is said: "coast" where it is trained for that shape, else "casteljau"; joined.
FilterPtr default_filter(int control_points, int maps);

// The matrices T of de Casteljau's algorithm that cuts a Bézier curve into N equal pieces: n rows.
RowMatrix de_casteljau_maps(const Shape& shape);

}  // namespace ifsm::core
