// What a point of the curve is made of: how much of each handle, or detail, of a level.
#pragma once

#include <map>
#include <vector>

#include "curve/model.h"

namespace ifsm::core {

using Shares = std::map<Index, double>;  // of handles, or of a level's details

// Of the finest polyline at a parameter. The same for every coordinate, whatever is turned.
Shares handle_shares(const Model& model, int level, double parameter);
Shares detail_shares(const Model& model, int level, double parameter);

}  // namespace ifsm::core
