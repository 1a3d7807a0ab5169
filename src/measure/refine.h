// Super-resolution: a curve goes on below its samples, with random details like those that it has.
#pragma once

#include <cstdint>

#include "measure/texture.h"

namespace ifsm::core {

struct Refinement {
  int levels = 1;  // more than the model has
  std::uint64_t seed = 0;
  int learned = 4;       // scales that the texture is learnt from
  double roughness = 1;  // what new displacements are multiplied with; 0: the polyline as it is
};

// A joined model of more levels, under the same filter: the exact one of a finer polyline, all of whose places are its
// samples. Old samples stay where they are (within what analyze() promises) and keep their parameters; so do places
// between them, unless they were filled in as the inner ones of a gap of `maps` steps: those are displaced as at the
// scale above.
//
// Level by level each segment's inner places are displaced by a normal vector with the texture's second moments, in the
// frame of that segment as it has become. Its mean square over the level is what the trend says, shared out in
// proportion to the segments' lengths, up to their root mean square: a longer one is long because the curve is straight
// there; in one dimension all are alike. Vectors that would bring a segment's places out of their order along it are
// drawn again (not in one dimension, where that is no fault), which takes some of the mean square away: on coasts a
// fifth. The curve may cross itself. The same bits on any number of threads.
ModelPtr refine(const Model& model, const Refinement& asked);

}  // namespace ifsm::core
