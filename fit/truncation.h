// Stage *filter*'s objective: the squared distance between samples and what their first k levels of details synthesise
// to, as a function of U (paper 002, section 4, step 2). Those levels give the polygons of level k back exactly, so it
// is the polygons that analysis finds there, and synthesis of them without details: of U, only its row space counts.
#pragma once

#include <vector>

#include "base/cancel.h"
#include "fit/blocks.h"
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
  struct Felt;
  struct Seen;

  Seen seen(const RowMatrix& matrix) const;
  // The value; adds (J | r)ᵀ(J | r) but for rᵀr to `product`, when there is one.
  double gather(const TruncatedCurve& curve, const Seen& seen, Eigen::MatrixXd* product) const;
  std::vector<Lanes> analysed(const TruncatedCurve& curve, const Seen& seen, const Blocks& blocks) const;
  std::vector<Lanes> subtree_lines(const TruncatedCurve& curve, const Seen& seen, int cut, Index node) const;
  double gather_subtree(const TruncatedCurve& curve, const Seen& seen, int cut, Index node,
                        const Eigen::Ref<const Lanes>& polygon, Felt* felt) const;

  Shape shape_;
  std::vector<TruncatedCurve> curves_;
  const Watch& watch_;
  std::vector<FreeEntry> entries_;
};

}  // namespace ifsm::core
