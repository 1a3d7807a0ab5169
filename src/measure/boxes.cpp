#include "measure/boxes.h"

#include <algorithm>

#include "base/cancel.h"

namespace ifsm::core {
namespace {

// The box of `from`, and of `to` as well.
void widen(double* box, const double* low, const double* high, Index dimension) {
  for (Index axis = 0; axis < dimension; ++axis) {
    box[axis] = std::min(box[axis], low[axis]);
    box[dimension + axis] = std::max(box[dimension + axis], high[axis]);
  }
}

}  // namespace

Boxes::Boxes(const Polyline& polyline) : dimension_(polyline.dimension()), segments_(polyline.segments()) {
  const Index leaves = (segments_ + run - 1) / run;
  std::vector<double> boxes;
  boxes.reserve(static_cast<std::size_t>(leaves * 2 * dimension_));
  Polled polled;
  for (Index leaf = 0; leaf < leaves; ++leaf) {
    polled.step();
    const Index first = first_segment(leaf);
    for (int corner = 0; corner < 2; ++corner)
      boxes.insert(boxes.end(), polyline.start(first), polyline.start(first) + dimension_);
    double* box = boxes.data() + boxes.size() - 2 * dimension_;
    for (Index segment = first; segment < end_segment(leaf); ++segment)
      widen(box, polyline.end(segment), polyline.end(segment), dimension_);
  }
  levels_.push_back(std::move(boxes));
  while (nodes(levels() - 1) > 1) {
    const int below = levels() - 1;
    const Index children = nodes(below);
    std::vector<double> above;
    above.reserve(static_cast<std::size_t>((children + 1) / 2 * 2 * dimension_));
    for (Index child = 0; child < children; child += 2) {
      above.insert(above.end(), low(below, child), low(below, child) + 2 * dimension_);
      const Index other = std::min(child + 1, children - 1);
      widen(above.data() + above.size() - 2 * dimension_, low(below, other), high(below, other), dimension_);
    }
    levels_.push_back(std::move(above));
  }
}

}  // namespace ifsm::core
