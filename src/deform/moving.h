// Edits that move what the curve hangs on: handles moved and pinned.
#pragma once

#include <vector>

#include "deform/edit.h"
#include "deform/state.h"

namespace ifsm::core {

// The state after an edit. Errors name the argument: "level", "handles", "vectors", "radius".
Edited after(const State& now, const Move& edit);
Edited after(const State& now, const Pin& edit);

// What of an edit a share of it is: of a move to places, that part of the way. A pin holds from the first.
Move part(const State& now, Move edit, double share);
Pin part(const State& now, Pin edit, double share);

// What other edits move with.

// Moves a handle by a vector as it is seen, told in a frame.
void displace(State& next, int level, Index handle, const Vector& by, Reach reach, const SmallMatrix& frame);
// F^-1 v, or a numerical error where the curve has been drawn together so far that F has none.
Vector untold(const SmallMatrix& frame, const Vector& seen, int level);
// The nodes of a level that hold some of its handles.
Touched nodes_of(const Model& model, int level, const std::vector<Index>& handles);
// `count` finite vectors of the model's dimension, or an error that names the argument.
void require_vectors(const Model& model, const Points& vectors, Index count, const char* argument);

}  // namespace ifsm::core
