#include "curve/named.h"

#include <complex>

#include "linalg/spectrum.h"
#include "support.h"

using namespace ifsm::core;
using namespace ifsm::core::testing;

namespace {

// Limits of a filter's own curve, evaluated from a polygon at some levels.
Points limits(const FilterPtr& filter, const Points& polygon, int levels, const std::vector<double>& parameters) {
  return evaluate(*from_polygon(filter, polygon, false, levels), Curve::limit, parameters);
}

std::vector<double> dyadic(int depth) {
  std::vector<double> t;
  for (int k = 0; k <= 1 << depth; ++k) t.push_back(std::ldexp(k, -depth));
  return t;
}

RowMatrix side_by_side(const Filter& filter) {
  const int n = filter.shape().control_points();
  RowMatrix t(n, n * filter.shape().maps());
  for (int i = 0; i < filter.shape().maps(); ++i) t.middleCols(i * n, n) = filter.map(i);
  return t;
}

constexpr Topology both[] = {Topology::joined, Topology::square};

TEST(DeCasteljau, IsTheQuadraticBezierOfTheMathPage) {
  RowMatrix wanted(3, 6);
  wanted << 4, 2, 1, 1, 0, 0,  //
      0, 2, 2, 2, 2, 0,        //
      0, 0, 1, 1, 2, 4;
  for (const auto topology : both) EXPECT_EQ(4 * side_by_side(*named_filter("casteljau", topology, 3, 2)), wanted);
}

TEST(DeCasteljau, IsTheCubicBezierOfTheMathPage) {
  RowMatrix wanted(4, 8);
  wanted << 8, 4, 2, 1, 1, 0, 0, 0,  //
      0, 4, 4, 3, 3, 2, 0, 0,        //
      0, 0, 2, 3, 3, 4, 4, 0,        //
      0, 0, 0, 1, 1, 2, 4, 8;
  for (const auto topology : both) EXPECT_EQ(8 * side_by_side(*named_filter("casteljau", topology, 4, 2)), wanted);
}

TEST(DeCasteljau, HasItsOwnShapeWhenNoneIsAsked) {
  const FilterPtr filter = named_filter("casteljau", Topology::joined, 0, 0);
  EXPECT_EQ(filter->shape(), Shape(Topology::joined, 5, 2));
}

TEST(Koch, IsTheMatrixOfTheMathPage) {
  RowMatrix wanted(3, 12);
  wanted << 6, 4, 4, 4, 2, 0, 0, 0, 2, 2, 0, 0,  //
      0, 2, 0, 0, 4, 6, 6, 4, 0, 0, 2, 0,        //
      0, 0, 2, 2, 0, 0, 0, 2, 4, 4, 4, 6;
  for (const auto topology : both)
    EXPECT_LE((6 * side_by_side(*named_filter("koch", topology, 0, 0)) - wanted).cwiseAbs().maxCoeff(), 6 * epsilon);
}

TEST(Takagi, IsTheMatrixOfTheMathPage) {
  RowMatrix wanted(3, 6);
  wanted << 4, 1, 0, 0, -1, 0,  //
      0, 4, 4, 4, 4, 0,         //
      0, -1, 0, 0, 1, 4;
  for (const auto topology : both) EXPECT_EQ(4 * side_by_side(*named_filter("takagi", topology, 0, 0)), wanted);
}

TEST(NamedFilters, HaveColumnsOfSumOne) {
  for (const char* name : {"haar", "bspline", "four-point", "koch", "takagi"}) {
    const FilterPtr filter = named_filter(name, Topology::square, 0, 0);
    const RowMatrix t = side_by_side(*filter);
    for (Index c = 0; c < t.cols(); ++c) EXPECT_NEAR(t.col(c).sum(), 1.0, 4 * epsilon) << name << " column " << c;
  }
}

TEST(NamedFilters, RefuseWhatTheyDoNotHave) {
  Error error = refusal([] { named_filter("daubechies", Topology::square, 0, 0); });
  EXPECT_EQ(error.status(), Status::range);
  EXPECT_EQ(error.argument(), "name");
  for (const char* name : {"casteljau", "haar", "bspline", "four-point", "koch", "takagi"})
    EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << name;
  error = refusal([] { named_filter("koch", Topology::square, 4, 0); });
  EXPECT_EQ(error.argument(), "control_points");
  error = refusal([] { named_filter("koch", Topology::square, 3, 2); });
  EXPECT_EQ(error.argument(), "maps");
  for (const char* name : {"haar", "bspline", "four-point"}) {
    error = refusal([&] { named_filter(name, Topology::joined, 0, 0); });
    EXPECT_EQ(error.status(), Status::range);
    EXPECT_EQ(error.argument(), "topology");
  }
  EXPECT_EQ(refusal([] { named_filter("casteljau", Topology::joined, 17, 2); }).argument(), "control_points");
  EXPECT_EQ(refusal([] { named_filter("casteljau", Topology::joined, 4, 9); }).argument(), "maps");
}

double takagi(double t) {
  double sum = 0, power = 1;
  for (int k = 0; k < 60; ++k, power *= 2) {
    const double x = t * power - std::floor(t * power);
    sum += std::min(x, 1 - x) / power;
  }
  return sum;
}

TEST(Takagi, HasTheValuesOfTakagisFunction) {
  const Points triangle = points_from((Matrix(3, 2) << 0, 0, 0.5, 0.5, 1, 0).finished());
  for (const auto topology : both)
    for (const int levels : {0, 1, 6}) {
      const FilterPtr filter = named_filter("takagi", topology, 0, 0);
      const Points third = limits(filter, triangle, levels, {1.0 / 3});
      EXPECT_NEAR(third.matrix()(0, 0), 1.0 / 3, 1e-14) << levels;
      // Takagi's modulus of continuity is h log(1/h): the double next to 1/3 may be 53 · eps away.
      EXPECT_NEAR(third.matrix()(0, 1), 2.0 / 3, 1e-14) << levels;
      const std::vector<double> t = dyadic(8);
      const Points points = limits(filter, triangle, levels, t);
      for (std::size_t k = 0; k < t.size(); ++k) {
        EXPECT_NEAR(points.matrix()(static_cast<Index>(k), 0), t[k], 1e-14) << levels;
        EXPECT_NEAR(points.matrix()(static_cast<Index>(k), 1), takagi(t[k]), 1e-14) << levels << " at " << t[k];
      }
    }
}

// Koch's curve at k / 4^depth, by its own construction.
Eigen::RowVector2d koch(int depth, int k) {
  const std::complex<double> turn = std::polar(1.0, M_PI / 3);
  const std::complex<double> shift[] = {0, 1.0 / 3, 1.0 / 3 + turn / 3.0, 2.0 / 3};
  const std::complex<double> factor[] = {1.0 / 3, turn / 3.0, std::conj(turn) / 3.0, 1.0 / 3};
  if (k == 1 << (2 * depth)) return {1, 0};
  std::complex<double> z = 0;
  for (int d = 0; d < depth; ++d, k /= 4) z = shift[k % 4] + factor[k % 4] * z;
  return {z.real(), z.imag()};
}

const Points koch_triangle = points_from((Matrix(3, 2) << 0, 0, 0.5, std::sqrt(3.0) / 6, 1, 0).finished());

TEST(Koch, HasTheCornersOfKochsCurve) {
  for (const auto topology : both)
    for (const int levels : {0, 1, 3}) {
      std::vector<double> t;
      for (int k = 0; k <= 256; ++k) t.push_back(k / 256.0);
      const Points points = limits(named_filter("koch", topology, 0, 0), koch_triangle, levels, t);
      for (int k = 0; k <= 256; ++k)
        EXPECT_LE((points.matrix().row(k) - koch(4, k)).norm(), 1e-14) << levels << " at " << k;
    }
}

TEST(Koch, HasNoDetailsInItsOwnFilter) {
  for (const int depth : {1, 2, 4}) {
    Points corners(2, (1 << (2 * depth)) + 1);
    for (int k = 0; k < corners.count(); ++k) corners.matrix().row(k) = koch(depth, k);
    // Leaf triangles: corner, apex, corner. The apex of a node is that of the model triangle.
    for (const auto topology : both) {
      const FilterPtr filter = named_filter("koch", topology, 0, 0);
      const Points own = points(*from_polygon(filter, koch_triangle, false, depth), depth);
      for (int k = 0; k < corners.count(); ++k)
        EXPECT_LE((own.matrix().row(2 * k) - corners.matrix().row(k)).norm(), 1e-14);
      const ModelPtr model = analyze(filter, own, false);
      ASSERT_EQ(model->levels(), depth);
      for (int level = 0; level < depth; ++level)
        EXPECT_LE(largest(model->details(level)), 64 * epsilon * filter->condition()) << level;
      EXPECT_LE(distance(control_points(*model), koch_triangle), 64 * epsilon * filter->condition());
    }
  }
}

Eigen::RowVectorXd bezier(const Matrix& control, double t) {
  Matrix p = control;
  for (Index step = p.rows() - 1; step > 0; --step)
    for (Index i = 0; i < step; ++i) p.row(i) = ((1 - t) * p.row(i) + t * p.row(i + 1)).eval();
  return p.row(0);
}

Matrix random_polygon(Random& random, Index n) {
  return Matrix::NullaryExpr(n, 2, [&] { return std::uniform_real_distribution<double>(-1, 1)(random); });
}

TEST(DeCasteljau, HasTheBezierCurveAsItsLimit) {
  Random random(1);
  const std::vector<double> t = dyadic(7);
  for (const auto topology : both)
    for (int n = 2; n <= 16; ++n)
      for (const int levels : {0, 3}) {
        const Matrix control = random_polygon(random, n);
        const Points points = limits(named_filter("casteljau", topology, n, 2), points_from(control), levels, t);
        for (std::size_t k = 0; k < t.size(); ++k)
          EXPECT_LE((points.matrix().row(static_cast<Index>(k)) - bezier(control, t[k])).norm(), 1e-14)
              << n << " at " << t[k];
      }
}

TEST(DeCasteljau, HasTheBezierCurveAsItsLimitForEveryNumberOfMaps) {
  Random random(2);
  for (const auto topology : both)
    for (int maps = 2; maps <= 8; ++maps)
      for (const int levels : {0, 1, 4}) {
        const Matrix control = random_polygon(random, 4);
        std::vector<double> t;
        for (int k = 0; k <= 100; ++k) t.push_back(k / 100.0);
        const Points points = limits(named_filter("casteljau", topology, 4, maps), points_from(control), levels, t);
        for (std::size_t k = 0; k < t.size(); ++k)
          EXPECT_LE((points.matrix().row(static_cast<Index>(k)) - bezier(control, t[k])).norm(), 1e-14)
              << maps << " maps, levels " << levels << " at " << t[k];
      }
}

// Uniform cubic B-spline segment of four control points.
Eigen::RowVectorXd bspline(const Matrix& p, double t) {
  const double s = 1 - t;
  return (s * s * s * p.row(0) + (3 * t * t * t - 6 * t * t + 4) * p.row(1) +
          (3 * s * s * s - 6 * s * s + 4) * p.row(2) + t * t * t * p.row(3)) /
         6;
}

TEST(BSpline, HasTheUniformCubicSplineAsItsLimit) {
  Random random(3);
  const std::vector<double> t = dyadic(8);
  for (const int levels : {0, 1, 5}) {
    const Matrix control = random_polygon(random, 4);
    const Points points = limits(named_filter("bspline", Topology::square, 0, 0), points_from(control), levels, t);
    for (std::size_t k = 0; k < t.size(); ++k)
      EXPECT_LE((points.matrix().row(static_cast<Index>(k)) - bspline(control, t[k])).norm(), 1e-14)
          << levels << " " << t[k];
  }
}

// Dyn, Levin and Gregory's scheme, interpolating: six points make the limit between the third and the fourth.
TEST(FourPoint, InterpolatesAsItsSchemeDoes) {
  Random random(4);
  const Matrix control = random_polygon(random, 6);
  Matrix p = control;
  constexpr int depth = 6;
  for (int step = 0; step < depth; ++step) {
    Matrix finer(2 * p.rows() - 5, 2);  // new points where four neighbours exist, and old ones between them
    Index row = 0;
    for (Index i = 1; i + 2 < p.rows(); ++i) {
      if (i > 1) finer.row(row++) = p.row(i);
      finer.row(row++) = (9 * (p.row(i) + p.row(i + 1)) - p.row(i - 1) - p.row(i + 2)) / 16;
    }
    // Keep the old points at both ends as well.
    Matrix all(row + 2, 2);
    all << p.row(1), finer.topRows(row), p.row(p.rows() - 2);
    p = all;
  }
  // p lies on the limit between control points; find those in [2, 3].
  const std::vector<double> t = dyadic(depth);
  const Points points = limits(named_filter("four-point", Topology::square, 0, 0), points_from(control), 0, t);
  EXPECT_LE((points.matrix().row(0) - control.row(2)).norm(), 1e-14);
  EXPECT_LE((points.matrix().bottomRows(1) - control.row(3)).norm(), 1e-14);
  Index start = 0;
  (p.rowwise() - control.row(2)).rowwise().norm().minCoeff(&start);
  for (Index k = 0; k <= 1 << depth; ++k) EXPECT_LE((points.matrix().row(k) - p.row(start + k)).norm(), 1e-14) << k;
}

TEST(FourPoint, KeepsCubics) {
  Matrix control(6, 2);
  for (int i = 0; i < 6; ++i) control.row(i) << i - 2.0, std::pow((i - 2.0) / 3, 3);
  const std::vector<double> t = dyadic(8);
  for (const int levels : {0, 3}) {
    const Points points = limits(named_filter("four-point", Topology::square, 0, 0), points_from(control), levels, t);
    for (std::size_t k = 0; k < t.size(); ++k) {
      EXPECT_NEAR(points.matrix()(static_cast<Index>(k), 0), t[k], 1e-14);
      EXPECT_NEAR(points.matrix()(static_cast<Index>(k), 1), std::pow(t[k] / 3, 3), 1e-14);
    }
  }
}

TEST(DeCasteljau, GivesBackTheControlPointsOfABezierFromItsLeafPolygons) {
  Random random(5);
  for (const auto topology : both)
    for (int n = 2; n <= 12; ++n)
      for (const int maps : {2, 3, 5})
        for (const int levels : {1, 3}) {
          const FilterPtr filter = named_filter("casteljau", topology, n, maps);
          const Points control = points_from(random_polygon(random, n));
          const ModelPtr bezier_model = from_polygon(filter, control, false, levels);
          const ModelPtr model = analyze(filter, points(*bezier_model, levels), false);
          ASSERT_EQ(model->levels(), levels);
          // Each level's analysis multiplies rounding by up to the norm of R^-1.
          const double grown = std::pow(norm(filter->inverse()), levels);
          EXPECT_LE(distance(control_points(*model), control), 16 * n * epsilon * std::max(1.0, grown))
              << filter->shape() << " levels " << levels;
        }
}

TEST(Coast, IsContractiveWellConditionedAndExactInTheSumsOfItsColumns) {
  const FilterPtr coast = named_filter("coast", Topology::joined, 0, 0);
  EXPECT_EQ(coast->shape(), Shape(Topology::joined, 5, 2));
  EXPECT_EQ(coast->contractivity(), Contractivity::proven);
  EXPECT_LT(coast->condition(), 30);
  const RowMatrix& r = coast->matrix();
  // Multiples of 2^-20 below 2: sums are exact.
  EXPECT_EQ(r.topRows(5).colwise().sum(), Eigen::RowVectorXd::Ones(9));
  EXPECT_EQ(r, (r * 0x1p20).array().round().matrix() * 0x1p-20);
  EXPECT_EQ(default_filter(0, 0)->matrix(), r);
}

TEST(Coast, RefusesShapesThatItIsNotTrainedFor) {
  EXPECT_EQ(refusal([] { named_filter("coast", Topology::joined, 4, 0); }).argument(), "control_points");
  EXPECT_EQ(refusal([] { named_filter("coast", Topology::square, 0, 0); }).argument(), "topology");
  EXPECT_EQ(default_filter(4, 2)->matrix(), named_filter("casteljau", Topology::joined, 4, 2)->matrix());
}

}  // namespace
