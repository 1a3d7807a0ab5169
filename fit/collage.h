// A start for T from the samples themselves: the maps that best make the polygons of a coarse level's children out of
// their parents (what the collage theorem is for an IFS).
#pragma once

#include <functional>
#include <span>

#include "curve/model.h"

namespace ifsm::core {

// R with T fitted linearly to the polygons of the models' first levels, drawn back to the models' own filter as far as
// `admits` asks for; their filter's R when that is all the way.
RowMatrix collage(std::span<const ModelPtr> models, const std::function<bool(const RowMatrix&)>& admits);

}  // namespace ifsm::core
