#include "support.h"

namespace ifsm::core::testing {

std::vector<Shape> all_shapes(int most_points, int most_maps) {
  std::vector<Shape> shapes;
  for (const auto topology : {Topology::joined, Topology::square})
    for (int n = topology == Topology::joined ? 2 : 1; n <= most_points; ++n)
      for (int maps = 2; maps <= most_maps; ++maps) shapes.emplace_back(topology, n, maps);
  return shapes;
}

RowMatrix casteljau_maps(const Shape& shape) {
  return shape.control_points() == 1 ? RowMatrix::Ones(1, shape.maps()) : de_casteljau_maps(shape);
}

FilterPtr casteljau(const Shape& shape) {
  return std::make_shared<Filter>(shape, with_complement(shape, casteljau_maps(shape)));
}

FilterPtr random_filter(const Shape& shape, Random& random, double size) {
  RowMatrix t = casteljau_maps(shape);
  const int n = shape.control_points();
  for (Index c = shape.joined() ? 1 : 0; c < t.cols() - (shape.joined() ? 1 : 0); ++c) {
    Eigen::VectorXd move = Eigen::VectorXd::NullaryExpr(n, [&] { return size * normal(random); });
    t.col(c) += move - Eigen::VectorXd::Constant(n, move.mean());
  }
  RowMatrix r = with_complement(shape, t);
  const Index d = shape.details_per_node();
  const Matrix mix = Matrix::Identity(d, d) + 0.2 / std::sqrt(static_cast<double>(d)) *
                                                  Matrix::NullaryExpr(d, d, [&] { return normal(random); });
  r.bottomRows(d) = (mix * r.bottomRows(d)).eval();
  if (shape.joined()) {  // with_complement leaves these zero, and so must rounding
    r.bottomRows(d).col(0).setZero();
    r.bottomRows(d).rightCols(1).setZero();
  }
  return std::make_shared<Filter>(shape, r);
}

Points random_curve(Random& random, Index count, Index dimension, Kind kind) {
  Points points(dimension, count);
  auto m = points.matrix();
  for (Index k = 0; k < count; ++k)
    for (Index axis = 0; axis < dimension; ++axis) {
      const double step = normal(random), t = static_cast<double>(k) / static_cast<double>(count);
      if (kind == Kind::smooth)
        m(k, axis) = std::cos(2 * M_PI * t * static_cast<double>(axis + 1) + static_cast<double>(axis));
      else if (kind == Kind::noise)
        m(k, axis) = step;
      else if (kind == Kind::constant)
        m(k, axis) = 0.1 * static_cast<double>(axis + 1);
      else
        m(k, axis) = (k > 0 ? m(k - 1, axis) : 0.0) + step;
    }
  if (kind == Kind::repeated)
    for (Index k = 1; k < count; ++k)
      if (k % 5 != 0) m.row(k) = m.row(k - 1);
  if (kind == Kind::collinear)
    for (Index axis = 1; axis < dimension; ++axis) m.col(axis) = m.col(0) * (0.3 * static_cast<double>(axis));
  if (kind == Kind::offset) m = (m.array() * 1e-3 + 1e8).matrix().eval();
  if (kind == Kind::tiny) m *= 1e-120;
  if (kind == Kind::huge) m *= 1e120;
  return points;
}

Points points_from(const Matrix& rows) {
  Points points(rows.cols(), rows.rows());
  points.matrix() = rows;
  return points;
}

double distance(const Points& a, const Points& b) {
  EXPECT_EQ(a.count(), b.count());
  EXPECT_EQ(a.dimension(), b.dimension());
  if (a.count() == 0 || a.count() != b.count()) return 0;
  return (a.matrix() - b.matrix()).cwiseAbs().maxCoeff();
}

double largest(const Points& points) { return points.size() == 0 ? 0.0 : points.matrix().cwiseAbs().maxCoeff(); }

double squared(const Points& a, const Points& b) { return (a.matrix() - b.matrix()).squaredNorm(); }

Kept random_choice(const Model& model, Random& random, double share) {
  Kept kept(static_cast<std::size_t>(model.details_total()));
  for (char& flag : kept) flag = std::uniform_real_distribution<double>()(random) < share ? 1 : 0;
  return kept;
}

}  // namespace ifsm::core::testing
