#include "curve/tree_solver.h"

#include <algorithm>

#include "support.h"

using namespace ifsm::core;
using namespace ifsm::core::testing;

namespace {

// Rows: places of the finest line; columns: control points (closed: without the last), then all details.
Matrix dense(const Filter& filter, int levels, bool closed) {
  const Shape& shape = filter.shape();
  const Index n = shape.control_points(), free = closed ? n - 1 : n;
  const Index d = shape.first_node(levels) * shape.details_per_node();
  Matrix a(shape.line_length(levels), free + d);
  for (Index c = 0; c < a.cols(); ++c) {
    ModelParts parts;
    parts.filter = std::make_shared<Filter>(filter);
    parts.polygon = Points(1, n);
    if (c < free) parts.polygon.plane(0)[static_cast<std::size_t>(c)] = 1;
    if (closed && c == 0) parts.polygon.plane(0).back() = 1;
    Index first = free;
    for (int l = 0; l < levels; ++l) {
      auto details = std::make_shared<Points>(1, shape.detail_count(l));
      if (c >= first && c < first + details->count()) details->plane(0)[static_cast<std::size_t>(c - first)] = 1;
      first += details->count();
      parts.details.push_back(std::move(details));
    }
    a.col(c) = line(parts, levels).matrix();
  }
  return a;
}

struct Problem {
  Problem(Random& random, int n, int maps, int levels, bool closed, double share_of_samples, double share_kept)
      : shape(Topology::joined, n, maps),
        filter(random_filter(shape, random, 0.05)),
        levels(levels),
        closed(closed),
        weight(Eigen::VectorXd::Zero(shape.line_length(levels))),
        data(2, shape.line_length(levels)),
        all(dense(*filter, levels, closed)) {
    for (Index i = 0; i < data.count(); ++i)
      for (Index lane = 0; lane < 2; ++lane) data.matrix()(i, lane) = normal(random);
    const auto chance = [&] { return std::uniform_real_distribution<double>(0, 1)(random); };
    for (double& w : weight) w = chance() < share_of_samples ? 0.2 + chance() : 0.0;
    if (closed) weight(weight.size() - 1) = 0;
    kept.resize(static_cast<std::size_t>(shape.first_node(levels) * shape.details_per_node()));
    for (char& flag : kept) flag = chance() < share_kept ? 1 : 0;
  }

  Matrix weighted_columns(const Kept& chosen) const {
    const Index free = closed ? shape.control_points() - 1 : shape.control_points();
    Matrix a(all.rows(), free + std::ranges::count(chosen, char{1}));
    a.leftCols(free) = all.leftCols(free);
    Index next = free;
    for (std::size_t i = 0; i < chosen.size(); ++i)
      if (chosen[i]) a.col(next++) = all.col(free + static_cast<Index>(i));
    return weight.cwiseSqrt().asDiagonal() * a;
  }

  // Do the samples tell every value that is free?
  bool determined() const {
    const Matrix a = weighted_columns(kept);
    return a.cols() <= a.rows() && rank(a) == a.cols();
  }

  double dense_error(const Kept& chosen) const {
    const Matrix weighted = weighted_columns(chosen), wanted = weight.cwiseSqrt().asDiagonal() * Matrix(data.matrix());
    return (weighted * least_squares(weighted, wanted) - wanted).squaredNorm();
  }

  std::string name() const {
    std::ostringstream out;
    out << shape << " levels=" << levels << (closed ? " closed" : " open") << " kept "
        << std::ranges::count(kept, char{1}) << " of " << kept.size() << " samples " << (weight.array() > 0).count()
        << " condition " << filter->condition();
    return out.str();
  }

  Shape shape;
  FilterPtr filter;
  int levels;
  bool closed;
  Eigen::VectorXd weight;
  Points data;
  Matrix all;
  Kept kept;
};

std::vector<Problem> problems(Random& random, double share_of_samples) {
  std::vector<Problem> all;
  for (const bool closed : {false, true})
    for (const auto& [n, maps, levels] :
         {std::tuple{2, 2, 0}, {4, 2, 0}, {2, 2, 4}, {2, 5, 2}, {3, 2, 4}, {5, 2, 3}, {4, 3, 2}, {7, 4, 1}})
      for (const double share_kept : {0.0, 0.15, 0.5, 1.0})
        all.emplace_back(random, n, maps, levels, closed, share_of_samples, share_kept);
  return all;
}

TEST(TreeSolver, FindsTheLeastSquaredError) {
  Random random(1);
  for (const double share : {1.0, 0.6, 0.2})
    for (const Problem& p : problems(random, share)) {
      TreeSolver solver(p.shape, p.levels, p.closed, p.weight);
      solver.factor(p.filter->matrix(), p.kept, {});
      const Solution s = solver.solve(p.data, {});
      const double least = p.dense_error(p.kept), whole = p.data.matrix().squaredNorm();
      EXPECT_NEAR(solver.squared_error(p.data, s, {}), least, 1e-10 * least + 1e-20 * whole) << p.name();
      // The curve is the synthesis of what is told.
      const Points curve = solver.curve(s, {});
      Matrix details = Matrix::Zero(static_cast<Index>(p.kept.size()), 2);
      for (Index i = 0, value = 0; i < details.rows(); ++i)
        if (p.kept[static_cast<std::size_t>(i)]) details.row(i) = s.values.row(value++);
      Eigen::VectorXd values(p.all.cols());
      const Index free = p.closed ? p.shape.control_points() - 1 : p.shape.control_points();
      for (Index lane = 0; lane < 2; ++lane) {
        values << s.control.col(lane).head(free), details.col(lane);
        EXPECT_LE((p.all * values - curve.matrix().col(lane)).norm(), 1e-12 * (1 + values.norm())) << p.name();
      }
      if (p.closed) {
        EXPECT_EQ(s.control.row(0), s.control.bottomRows(1)) << p.name();
      }
      // Values that no sample tells stay small: they are not what rounding says of them.
      EXPECT_LE(s.values.norm() + s.control.norm(), 1e6) << p.name();
    }
}

TEST(TreeSolver, MayBeFactoredAndSolvedAgain) {
  Random random(2);
  const Problem p(random, 4, 2, 3, false, 1.0, 0.3), q(random, 4, 2, 3, false, 1.0, 0.6);
  TreeSolver solver(p.shape, p.levels, p.closed, p.weight), fresh(p.shape, p.levels, p.closed, p.weight);
  solver.factor(q.filter->matrix(), q.kept, {});
  solver.solve(q.data, {});
  solver.factor(p.filter->matrix(), p.kept, {});
  fresh.factor(p.filter->matrix(), p.kept, {});
  const Solution a = solver.solve(p.data, {}), b = fresh.solve(p.data, {});
  EXPECT_EQ(a.control, b.control);
  EXPECT_EQ(a.values, b.values);
  EXPECT_EQ(solver.curve(a, {}), fresh.curve(b, {}));
  EXPECT_EQ(solver.scores(p.data, a, {}), fresh.scores(p.data, b, {}));
}

TEST(TreeSolver, ScoresWhatDroppingOrAddingADetailWouldDo) {
  Random random(3);
  int checked = 0;
  for (const double share : {1.0, 0.8})
    for (const Problem& p : problems(random, share)) {
      TreeSolver solver(p.shape, p.levels, p.closed, p.weight);
      solver.factor(p.filter->matrix(), p.kept, {});
      const Solution s = solver.solve(p.data, {});
      const double now = p.dense_error(p.kept), whole = p.data.matrix().squaredNorm();
      const std::vector<double> scores = solver.scores(p.data, s, {});
      ASSERT_EQ(scores.size(), p.kept.size());
      for (std::size_t i = 0; i < scores.size(); i += 1 + scores.size() / 12) {
        Kept other = p.kept;
        other[i] = other[i] ? 0 : 1;
        if (p.kept[i] && !p.determined()) continue;
        ++checked;
        const double change = std::abs(p.dense_error(other) - now);
        EXPECT_NEAR(scores[i], change, 1e-7 * (change + 1e-3 * whole))
            << p.name() << " detail " << i << (p.kept[i] ? " kept" : " dropped");
      }
    }
  EXPECT_GT(checked, 300);
}

}  // namespace
