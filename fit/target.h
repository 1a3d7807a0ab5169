// What stage *curve* is to come near to: one curve's samples, where on the curve each belongs, how much it counts, and
// what must hold exactly.
#pragma once

#include <string>
#include <vector>

#include "fit/fit.h"
#include "fit/loss.h"
#include "fit/normal.h"

namespace ifsm::core {

// Where samples sit among the parameters 0 … 1.
enum class ParameterRule : std::int32_t { index = 0, chord = 1, centripetal = 2, given = 3 };

// The curve passes through a point at a parameter; or its leg at an end (parameter 0 or 1) lies along a direction.
enum class ConstraintKind : std::int32_t { point = 1, tangent = 2 };

struct Constraint {
  ConstraintKind kind;
  double parameter;
  std::vector<double> value;  // dimension numbers
};

// What a caller says about one curve's samples; all of it may be empty.
struct FitSamples {
  std::vector<double> parameters;
  std::vector<double> weights;      // one a sample: squared residuals count by it
  std::vector<double> covariances;  // dimension × dimension a sample
  std::vector<Constraint> constraints;
  bool fixed_ends = false;  // at the first and the last sample
};

struct Target {
  Index dimension = 0;
  bool closed = false;
  std::vector<double> center;
  double diagonal = 0;
  Lanes samples;                        // from the centre
  std::vector<double> parameters;       // never falling
  std::vector<double> weights;          // empty: 1 each
  Lanes whitening;                      // empty, or dimension rows a sample: W with WᵀW = its covariance's inverse
  std::vector<Constraint> constraints;  // points from the centre, the caller's at its index
  bool fixed_ends = false;

  Index count() const { return samples.rows(); }
  // |W e|² weighted.
  double squared(Index k, const Eigen::Ref<const Eigen::RowVectorXd>& error) const;
};

// Checks and copies; faults are those of "<prefix>weights" and so on, with their index. `model`: the exact model of the
// curve's samples, for the centre and the places by index.
Target make_target(const FitCurve& curve, const FitSamples& given, ParameterRule rule, const Model& model,
                   const std::string& prefix);

}  // namespace ifsm::core
