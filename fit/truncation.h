// Stage *filter*'s objective: the squared distance between samples and what their first k levels of details synthesise
// to, as a function of U (paper 002, section 4, step 2). Those levels give the polygons of level k back exactly, so it
// is the polygons that analysis finds there, and synthesis of them without details: of U, only its row space counts.
#pragma once

#include <vector>

#include "base/cancel.h"
#include "fit/objective.h"
#include "fit/parameters.h"

namespace ifsm::core {

struct TruncatedCurve {
  const Points* line;  // the finest line
  int levels;
  int kept;                // levels whose details stay, at most `levels`
  Eigen::VectorXd weight;  // of each value of the finest line
};

class Truncation : public Objective {
 public:
  Truncation(const Shape& shape, std::vector<TruncatedCurve> curves, const Watch& watch);

  double value(const RowMatrix& matrix) override;
  void gather(const RowMatrix& matrix, Normal& normal) override;

 private:
  // Lines of all levels from `kept` on, and the weighted error of what the coarsest of them becomes.
  struct Analysed {
    std::vector<Lanes> lines;  // by level - kept
    Lanes weighted_error;
    double value;
  };

  Analysed analysed(const TruncatedCurve& curve, const RowMatrix& matrix, const RowMatrix& inverse) const;

  Shape shape_;
  std::vector<TruncatedCurve> curves_;
  const Watch& watch_;
  std::vector<FreeEntry> entries_;
};

}  // namespace ifsm::core
