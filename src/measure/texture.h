// What the displacements of a curve's places have in common, scale by scale: learnt, so that more of the same can be
// made.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "curve/model.h"

namespace ifsm::core {

// A segment between neighbouring places of one scale holds maps - 1 places of the next finer one; how far they lie from
// where the straight segment has them is its displacement. (These are the details of the filter of n = 2, which, unlike
// others, leaves the places where they are.) Its second moments are told along the segment and across it, a frame that
// any turn of the curve carries along, in any dimension: mirror images are alike, and all directions across.
struct Texture {
  Eigen::MatrixXd along, across;  // (maps - 1) square; trace(along) + (d - 1) trace(across) = 1, or all zero
  double decay;                   // of the mean squared displacement of a segment, from one scale to the next finer one
  double next;                    // that, expected between the finest places, in the samples' units squared
};

// Points as points(model, levels) gives them for a joined model. `known`: which of them are samples; a segment of the
// finest scale with another place in it was filled in, and teaches nothing. From the last `scales` scales, all alike in
// weight; within a scale by sums, so that long segments, whose displacements are large, weigh more. The mean squares
// follow a straight line in logarithms; where fewer than three are not zero, they fall as a random walk's.
Texture learn(const Points& places, const std::vector<char>& known, int maps, int levels, int scales);

// The direction of a segment's frame: its own; the first axis where it has none, and in one dimension.
using Direction = Eigen::Matrix<double, 1, Eigen::Dynamic, Eigen::RowMajor, 1, 4>;
Direction direction_of(const Direction& way);

}  // namespace ifsm::core
