// How far the handles of a level follow those that are moved.
#pragma once

#include <map>
#include <vector>

#include "deform/edit.h"
#include "deform/pose.h"

namespace ifsm::core {

// The displacements of all handles that follow, the moved ones among them: each of those goes its own way, others by
// the mean of what moves them, weighted by falloff (weights that sum to less than 1 as they are). `places`: the level's
// handles, in order; `closed`: the last is followed by the first.
std::map<Index, Vector> spread_by_falloff(const std::map<Index, Vector>& moved, const Points& places, bool closed,
                                          Falloff falloff, Ruler ruler, double radius);

}  // namespace ifsm::core
