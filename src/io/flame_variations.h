// The attributes of a flame's transform that are not its affine maps: flam3's variations, which bend the plane, and
// what bends nothing.
#pragma once

#include <cstddef>
#include <string_view>

namespace ifsm::core {

// flam3's variations by number, "linear" first; empty beyond the last.
std::string_view variation_name(std::size_t number);

bool is_variation(std::string_view attribute);

// Colours, names, motion without an element that moves, and the parameters of variations, which do nothing without
// these. The list is exact: later programs have variations whose names begin as these do (blur_circle).
bool moves_no_point(std::string_view attribute);

}  // namespace ifsm::core
