// Stage *curve*'s objective: the weighted squared distance between samples and the curve without details, as a function
// of C alone. Control points are solved for (variable projection: the value is linear in them) under the constraints.
#pragma once

#include <optional>
#include <vector>

#include "fit/constraints.h"
#include "fit/curve_walk.h"
#include "fit/objective.h"

namespace ifsm::core {

// One curve's part. Robust losses: samples count by their slopes at some earlier curve, and `offset` makes the sum
// touch the loss there; it lies above the loss elsewhere (fit/loss.h).
struct CurveTerm {
  const Target* target;
  ConstraintSet constraints;
  std::vector<Position> positions;
  Lanes reference;             // control points, n × dimension: where the samples leave them open they stay near these
  std::vector<double> slopes;  // one a sample; empty: 1 each
  double offset = 0;
};

// The best control points under one C, and their part of the objective.
struct ControlFit {
  Lanes control;
  double value;
};

// What is left when a term's control points are solved for: dp = follow dC + spread · noise.
struct Eliminated {
  Eigen::MatrixXd product;  // (J | r)ᵀ(J | r), parameters of C + 1
  Eigen::MatrixXd follow;   // control coordinates × parameters of C
  Eigen::MatrixXd spread;   // control coordinates, squared
  Index rank;               // coordinates that the constraints leave free and the samples determine
  Index open;               // and those that neither does
};

class CurveError : public Objective {
 public:
  CurveError(const Shape& shape, int levels, std::vector<CurveTerm> terms, const Watch& watch);

  // Infinite where constraints contradict each other.
  double value(const RowMatrix& matrix) override;
  // Kaufman's Jacobian: control points follow C as far as they can be solved for.
  void gather(const RowMatrix& matrix, Normal& normal) override;

  const std::vector<CurveTerm>& terms() const { return terms_; }
  // The best control points of every term; none where constraints contradict each other.
  std::optional<std::vector<ControlFit>> solved(const RowMatrix& matrix);
  Eliminated eliminated(const CurveTerm& term, const RowMatrix& matrix, const Lanes& control) const;

  // All rows of a term: (J by control points | J by C | r), a coordinate of a sample each, weighted.
  void rows(const CurveTerm& term, const RowMatrix& matrix, const Lanes& control, RowSink& sink) const;
  // Their product; of plain weights gathered without the zeros between coordinates.
  Eigen::MatrixXd product(const CurveTerm& term, const RowMatrix& matrix, const Lanes& control) const;

 private:
  // Of neighbouring samples, the first of which is number `first`.
  void rows(const CurveTerm& term, std::span<const Position> positions, Index first, const RowMatrix& matrix,
            const Lanes& control, RowSink& sink) const;
  void plain_rows(const CurveTerm& term, std::span<const Position> positions, Index first, const RowMatrix& matrix,
                  const Lanes& control, std::vector<Normal>& normals) const;

  struct Quadratic {
    Eigen::MatrixXd form;
    Eigen::VectorXd gradient;
    double value;
  };

  Quadratic quadratic(const CurveTerm& term, const RowMatrix& matrix, const Lanes& control, bool with_form) const;
  Quadratic plain_quadratic(const CurveTerm& term, const RowMatrix& matrix, const Lanes& control, bool with_form) const;
  Held held(const CurveTerm& term, const RowMatrix& matrix) const;
  std::optional<ControlFit> solved_term(const CurveTerm& term, const RowMatrix& matrix) const;

  Shape shape_;
  int levels_;
  std::vector<CurveTerm> terms_;
  const Watch& watch_;
  RowMatrix last_matrix_;  // the one that was solved for last, and what was found
  std::optional<std::vector<ControlFit>> last_;
};

}  // namespace ifsm::core
