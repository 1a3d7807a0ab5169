// How sure a fit is of what it found: covariances from the rows of the final problem, control points eliminated.
#pragma once

#include <span>
#include <vector>

#include "base/cancel.h"
#include "fit/normal.h"
#include "fit/parameters.h"

namespace ifsm::core {

// dp = follow dR + noise of covariance `spread`; dR (the free entries of a part) has covariance `filter`. All in units
// of the samples, the noise's own size included.
struct CurveCertainty {
  Lanes control;
  Eigen::MatrixXd follow;  // control coordinates × free entries
  Eigen::MatrixXd spread;
  bool determined = true;  // the samples determine all control points, C being given
};

struct Certainty {
  Shape shape;
  int levels = 0;
  RowMatrix matrix;
  Part part = Part::maps;
  bool moved = false;      // the part was fitted; else `filter` is zero
  Eigen::MatrixXd filter;  // free entries, squared
  std::vector<CurveCertainty> curves;
  bool noise_known = false;  // told by covariances
  double noise = 0;          // standard deviation of a residual of weight 1
  Index freedom = 0;         // residuals beyond what was fitted
};

// The covariance of a curve's control points, coordinate a of point i at i · dimension + a.
Eigen::MatrixXd control_covariance(const Certainty& certainty, std::size_t curve);
// Of the entries of the part, row by row: C is n × rows, U is (rows - n) × rows.
Eigen::MatrixXd filter_covariance(const Certainty& certainty);
Index covariance_size(const Certainty& certainty);
// Of the curve without details at parameters, dimension rows each.
Lanes curve_covariance(const Certainty& certainty, std::size_t curve, std::span<const double> parameters,
                       const Watch& watch);

}  // namespace ifsm::core
