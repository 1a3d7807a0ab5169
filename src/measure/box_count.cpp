#include "measure/box_count.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "base/cancel.h"

namespace ifsm::core {
namespace {

using Key = std::uint64_t;

// Boxes as they are visited; a box that follows itself is one visit.
class Visits {
 public:
  explicit Visits(Index most) { keys_.reserve(static_cast<std::size_t>(most)); }
  void add(const std::array<Index, 3>& box) {
    constexpr int bits = 21;
    const Key key =
        static_cast<Key>(box[0]) | static_cast<Key>(box[1]) << bits | static_cast<Key>(box[2]) << (2 * bits);
    if (keys_.empty() || keys_.back() != key) keys_.push_back(key);
  }
  Index different() {
    std::ranges::sort(keys_);
    return std::unique(keys_.begin(), keys_.end()) - keys_.begin();
  }

 private:
  std::vector<Key> keys_;
};

// Walks from box to box along a segment. The coordinate of an axis reaches a face k · side at the time |k · side - x| /
// |step|. Going up, the box above owns the face and is entered at that time; going down, the box below is entered right
// after it. Faces reached at the same time are passed together, those going up first.
class Walk {
 public:
  Walk(const Index* from, const Index* to, Index dimension, Index side) : dimension_(dimension), side_(side) {
    for (Index axis = 0; axis < dimension; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      box_[a] = from[axis] / side;
      last_[a] = to[axis] / side;
      length_[a] = std::abs(to[axis] - from[axis]);
      up_[a] = to[axis] > from[axis];
      to_face_[a] = up_[a] ? (box_[a] + 1) * side - from[axis] : from[axis] - box_[a] * side;
    }
  }

  void visit(Visits& visits) {
    visits.add(box_);
    while (const auto next = next_axis()) {
      const Index time = to_face_[*next], of = length_[*next];
      for (const bool up : {true, false}) {
        bool moved = false;
        for (std::size_t axis = 0; axis < static_cast<std::size_t>(dimension_); ++axis) {
          if (box_[axis] == last_[axis] || up_[axis] != up || to_face_[axis] * of != time * length_[axis]) continue;
          box_[axis] += up ? 1 : -1;
          to_face_[axis] += side_;
          moved = true;
        }
        if (moved) visits.add(box_);
      }
    }
  }

 private:
  // The axis whose next face comes first; none when the last box is reached.
  const std::size_t* next_axis() {
    bool found = false;
    for (std::size_t axis = 0; axis < static_cast<std::size_t>(dimension_); ++axis) {
      if (box_[axis] == last_[axis]) continue;
      // Both below 2^31: the products are exact.
      if (!found || to_face_[axis] * length_[next_] < to_face_[next_] * length_[axis]) next_ = axis;
      found = true;
    }
    return found ? &next_ : nullptr;
  }

  Index dimension_, side_;
  std::array<Index, 3> box_{}, last_{}, length_{}, to_face_{};
  std::array<bool, 3> up_{};
  std::size_t next_ = 0;
};

}  // namespace

Lattice::Lattice(const Polyline& polyline)
    : dimension_(polyline.dimension()),
      count_(polyline.count()),
      segments_(polyline.segments()),
      values_(static_cast<std::size_t>(polyline.dimension() * polyline.count())) {
  const Eigen::Map<const Eigen::MatrixXd> points(polyline.start(0), dimension_, count_);
  const Eigen::VectorXd low = points.rowwise().minCoeff();
  const double longest = (points.rowwise().maxCoeff() - low).maxCoeff();
  const double steps_a_unit = static_cast<double>(steps) / longest;
  for (Index k = 0; k < count_; ++k)
    for (Index axis = 0; axis < dimension_; ++axis)
      values_[static_cast<std::size_t>(k * dimension_ + axis)] =
          std::min(static_cast<Index>(std::round((points(axis, k) - low(axis)) * steps_a_unit)), steps);
  step_ = longest / static_cast<double>(steps);
}

Index Lattice::side_of(double scale) const {
  return std::clamp(static_cast<Index>(std::round(scale / step_)), smallest_side, 2 * steps);
}

Index Lattice::visits_at_most(Index side) const {
  Index faces = 0;
  for (Index segment = 0; segment < segments_; ++segment) {
    const Index next = segment + 1 < count_ ? segment + 1 : 0;
    for (Index axis = 0; axis < dimension_; ++axis)
      faces += std::abs(values_[static_cast<std::size_t>(next * dimension_ + axis)] / side -
                        values_[static_cast<std::size_t>(segment * dimension_ + axis)] / side);
  }
  return faces + segments_ + 1;
}

Index Lattice::count(Index side) const {
  Visits visits(visits_at_most(side));
  Polled polled;
  for (Index segment = 0; segment < segments_; ++segment) {
    polled.step();
    const Index next = segment + 1 < count_ ? segment + 1 : 0;
    Walk(values_.data() + segment * dimension_, values_.data() + next * dimension_, dimension_, side).visit(visits);
  }
  return visits.different();
}

}  // namespace ifsm::core
