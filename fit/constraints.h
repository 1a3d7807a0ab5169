// What must hold exactly, as linear equations of the control points, and how they turn when C moves.
#pragma once

#include "base/cancel.h"
#include "fit/target.h"

namespace ifsm::core {

// Control points as one vector, point by point: coordinate a of point i at i · dimension + a.
Eigen::VectorXd stacked(const Lanes& control);
Lanes unstacked(const Eigen::VectorXd& stacked, Index dimension);

// Under one C: Q p = q with orthonormal rows Q, and an orthonormal basis of what stays free.
class Held {
 public:
  // Equations that follow from those before are left out when they agree. `conflict`: the first that does not, counted
  // among the equations, or -1.
  Held(const Eigen::MatrixXd& equations, const Eigen::VectorXd& values, double scale);

  bool empty() const { return rows_.rows() == 0; }
  Index conflict() const { return conflict_; }
  Index rank() const { return rows_.rows(); }
  const Eigen::MatrixXd& free() const { return free_; }

  // The nearest control points for which all equations hold.
  Eigen::VectorXd nearest(const Eigen::VectorXd& control) const;
  // How the control points must move when the equations' left sides change by `moved` (an equation a row).
  Eigen::MatrixXd follow(const Eigen::MatrixXd& moved) const;

 private:
  Eigen::MatrixXd rows_;
  Eigen::VectorXd values_;
  Eigen::MatrixXd mixing_;  // rows_ = mixing_ · equations
  Eigen::MatrixXd free_;
  Index conflict_ = -1;
};

// The equations of one target: its ring, its fixed ends, the caller's constraints.
struct Equations {
  Eigen::MatrixXd left;
  Eigen::VectorXd right;
  std::vector<Index> constraint;  // of each equation: the caller's, or -1 ring, -2 ends
};

class ConstraintSet {
 public:
  ConstraintSet(const Target& target, const Shape& shape, int levels);

  bool empty() const { return demands_.empty(); }
  Equations equations(const RowMatrix& matrix, const Watch& watch) const;
  // d(left · control) by every parameter of C, an equation a row.
  Eigen::MatrixXd tangents(const RowMatrix& matrix, const Lanes& control, const Watch& watch) const;

 private:
  // direction · (x(to) - x(from)) = value; `from` may be none.
  struct Demand {
    Eigen::RowVectorXd direction;
    double to;
    double from;  // a parameter, or none
    double value;
    Index constraint;
  };
  static constexpr double none = -1;

  void demand_point(double parameter, const Eigen::RowVectorXd& point, Index constraint);
  void demand_tangent(double parameter, const Eigen::RowVectorXd& direction, Index constraint);
  std::vector<double> sorted_parameters() const;

  Shape shape_;
  int levels_;
  Index dimension_;
  std::vector<Demand> demands_;
};

// Refuses what cannot hold under the start's C, naming the caller's constraint.
void require_consistent(const Target& target, const ConstraintSet& constraints, const RowMatrix& matrix,
                        const std::string& prefix, const Watch& watch);

}  // namespace ifsm::core
