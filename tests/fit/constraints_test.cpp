#include "fit/constraints.h"

#include <gtest/gtest.h>

#include "curves.h"

namespace ifsm::core {
namespace {

TEST(Held, FindsTheNearestControlPointsForWhichAllEquationsHold) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1, 1);
  const Eigen::MatrixXd equations = Eigen::MatrixXd::NullaryExpr(4, 10, [&] { return any(random); });
  const Eigen::VectorXd values = Eigen::VectorXd::NullaryExpr(4, [&] { return any(random); });
  const Held held(equations, values, 1);
  ASSERT_EQ(held.conflict(), -1);
  ASSERT_EQ(held.rank(), 4);
  const Eigen::VectorXd from = Eigen::VectorXd::NullaryExpr(10, [&] { return any(random); });
  const Eigen::VectorXd found = held.nearest(from);
  EXPECT_LT((equations * found - values).norm(), 1e-14);
  EXPECT_LT((held.free().transpose() * (found - from)).norm(), 1e-14);  // it moved across what is free
  EXPECT_LT((equations * held.free()).norm(), 1e-14);
  // When left sides change, what follows undoes it.
  const Eigen::MatrixXd moved = Eigen::MatrixXd::NullaryExpr(4, 3, [&] { return any(random); });
  EXPECT_LT((equations * held.follow(moved) + moved).norm(), 1e-13);
}

TEST(Held, LeavesOutWhatFollowsAndNamesWhatContradicts) {
  Eigen::MatrixXd equations(3, 4);
  equations << 1, 0, 0, 0, 0, 1, 0, 0, 1, 1, 0, 0;
  const Held agreeing(equations, Eigen::Vector3d(1, 2, 3), 1);
  EXPECT_EQ(agreeing.rank(), 2);
  EXPECT_EQ(agreeing.conflict(), -1);
  const Held contradicting(equations, Eigen::Vector3d(1, 2, 3.1), 1);
  EXPECT_EQ(contradicting.conflict(), 2);
}

TEST(Held, HoldsNothingWhenNothingIsAsked) {
  const Held held(Eigen::MatrixXd(0, 6), Eigen::VectorXd(0), 1);
  EXPECT_TRUE(held.empty());
  EXPECT_EQ(held.free().cols(), 6);
  EXPECT_EQ(held.nearest(Eigen::VectorXd::Constant(6, 2)), Eigen::VectorXd::Constant(6, 2));
}

TEST(Constraints, AreEquationsThatTheCurveMeetsWhenControlPointsDo) {
  const FilterPtr filter = named_filter("casteljau", Topology::joined, 5, 2);
  const FitCurve curve{loop(60, 2, 4), true};
  const ModelPtr model = analyze(filter, curve.samples, true);
  FitSamples told;
  told.fixed_ends = true;
  told.constraints = {{ConstraintKind::point, 0.3, {1, 2}}, {ConstraintKind::tangent, 1, {0, 3}}};
  const Target target = make_target(curve, told, ParameterRule::index, *model, "");
  const ConstraintSet set(target, filter->shape(), model->levels());
  const Equations equations = set.equations(filter->matrix(), Watch{});
  EXPECT_EQ(equations.constraint, (std::vector<Index>{-1, -1, -2, -2, 0, 0, 1}));  // ring, end, point, direction
  const Held held(equations.left, equations.right, target.diagonal);
  EXPECT_EQ(held.conflict(), -1);
  EXPECT_EQ(held.rank(), 7);
  EXPECT_NO_THROW(require_consistent(target, set, filter->matrix(), "", Watch{}));
}

}  // namespace
}  // namespace ifsm::core
