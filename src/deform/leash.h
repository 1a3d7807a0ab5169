// Values of a level, handles or details, led so that points of the curve come where they are wanted.
#pragma once

#include <Eigen/QR>
#include <functional>
#include <map>
#include <vector>

#include "deform/pose.h"
#include "deform/reach.h"

namespace ifsm::core {

// The linear problem: the least change of the free values that leads the points by given ways.
class Leash {
 public:
  // What each point is made of; held values stay. A singular error when the free ones cannot lead the points apart.
  Leash(const std::vector<Shares>& shares, const std::map<Index, Vector>& held);

  // `ways`: a point a row.
  std::map<Index, Vector> changes(const Eigen::MatrixXd& ways) const;
  std::vector<Index> values() const;

 private:
  std::map<Index, Index> column_;  // of a value
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver_;
};

// Where points come nonlinearly, nodes turning as they are led: ways that leave nothing, by Broyden's method. `left`
// says what given ways leave of the wanted ones. Returns whether it came `close`; the last call of `left` was for the
// end.
bool find_ways(const std::function<Eigen::MatrixXd(const Eigen::MatrixXd& ways)>& left, Index points, Index dimension,
               double close);

}  // namespace ifsm::core
