#include "curve/filter.h"

#include <Eigen/LU>
#include <limits>

#include "linalg/spectrum.h"
#include "support.h"

using namespace ifsm::core;
using namespace ifsm::core::testing;

namespace {

RowMatrix maps_of(const Shape& shape, Random& random) {
  return random_filter(shape, random)->matrix().topRows(shape.control_points());
}

TEST(Complement, OfASquareFilterIsOrthogonalToTAndOneNumberTimesAnIsometry) {
  Random random(1);
  for (const Shape& shape : all_shapes()) {
    if (shape.joined()) continue;
    for (const bool perturbed : {false, true}) {
      const RowMatrix t = perturbed ? maps_of(shape, random) : casteljau_maps(shape);
      const RowMatrix r = with_complement(shape, t);
      const Index n = shape.control_points(), d = shape.details_per_node();
      ASSERT_EQ(RowMatrix(r.topRows(n)), t) << shape;
      const Matrix u = r.bottomRows(d);
      const Eigen::VectorXd values = svd(t).values;
      const double s2 = (u * u.transpose())(0, 0);
      // Householder's reflections of `rows` columns, twice.
      const double k = 32 * shape.rows() * epsilon;
      EXPECT_LE((u * u.transpose() - s2 * Matrix::Identity(d, d)).norm(), k * s2) << shape;
      EXPECT_LE((u * t.transpose()).norm(), k * std::sqrt(s2) * t.norm()) << shape;
      EXPECT_LE(std::sqrt(s2), values(0) * (1 + k)) << shape;
      EXPECT_GE(std::sqrt(s2), values(n - 1) * (1 - k)) << shape;
    }
  }
}

TEST(Complement, OfASquareFilterAddsNothingToTheConditionOfT) {
  Random random(2);
  for (const Shape& shape : all_shapes()) {
    if (shape.joined()) continue;
    for (const bool perturbed : {false, true}) {
      const RowMatrix t = perturbed ? maps_of(shape, random) : casteljau_maps(shape);
      const double of_t = condition_number(t), of_r = condition_number(with_complement(shape, t));
      // The least singular value is known to eps times the largest.
      EXPECT_NEAR(of_r / of_t, 1.0, 64 * shape.rows() * epsilon * of_t) << shape << " " << of_t;
    }
  }
}

TEST(Complement, OfAJoinedFilterIsOrthogonalOnInteriorRowsAndColumns) {
  Random random(3);
  for (const Shape& shape : all_shapes()) {
    if (!shape.joined()) continue;
    for (const bool perturbed : {false, true}) {
      const RowMatrix c = perturbed ? maps_of(shape, random) : casteljau_maps(shape);
      const RowMatrix r = with_complement(shape, c);
      const Index n = shape.control_points(), d = shape.details_per_node(), rows = shape.rows();
      ASSERT_EQ(RowMatrix(r.topRows(n)), c);
      const Matrix u = r.bottomRows(d);
      EXPECT_EQ(u.col(0).norm() + u.col(rows - 1).norm(), 0.0) << shape;
      const double s2 = (u * u.transpose())(0, 0), k = 32 * static_cast<double>(rows) * epsilon;
      EXPECT_GT(s2, 0.0);
      EXPECT_LE((u * u.transpose() - s2 * Matrix::Identity(d, d)).norm(), k * s2) << shape;
      if (n == 2) continue;  // no interior rows: nothing to be orthogonal to
      const Matrix interior = c.block(1, 1, n - 2, rows - 2);
      EXPECT_LE((u.middleCols(1, rows - 2) * interior.transpose()).norm(), k * std::sqrt(s2) * interior.norm())
          << shape;
    }
  }
}

// Analysis by least squares: of all polygons (joined: with these ends), P is nearest to the children.
TEST(Complement, MakesAnalysisLeastSquares) {
  Random random(4);
  for (const Shape& shape : all_shapes(9, 4)) {
    const RowMatrix t = maps_of(shape, random);
    const RowMatrix r = with_complement(shape, t);
    const RowMatrix inverse = inverse_of(shape, r);
    const Index n = shape.control_points(), rows = shape.rows();
    const Eigen::RowVectorXd children = Eigen::RowVectorXd::NullaryExpr(rows, [&] { return normal(random); });
    Eigen::RowVectorXd nearest = Eigen::RowVectorXd::Zero(n);
    if (shape.joined()) {
      nearest(0) = children(0);
      nearest(n - 1) = children(rows - 1);
      if (n > 2) {
        const Eigen::RowVectorXd left = children - nearest(0) * t.row(0) - nearest(n - 1) * t.row(n - 1);
        const Matrix interior = t.block(1, 1, n - 2, rows - 2).transpose();
        nearest.segment(1, n - 2) = least_squares(interior, left.segment(1, rows - 2).transpose()).transpose();
      }
    } else {
      nearest = least_squares(t.transpose(), children.transpose()).transpose();
    }
    const double scale = nearest.norm() + children.norm();
    EXPECT_LE((children * inverse.leftCols(n) - nearest).norm(), 64 * epsilon * condition_number(r) * scale) << shape;
  }
}

TEST(Complement, OfHaarIsOneAndMinusOne) {
  const FilterPtr haar = named_filter("haar", Topology::square, 0, 0);
  EXPECT_EQ(haar->matrix()(0, 0), 1.0);
  EXPECT_EQ(haar->matrix()(0, 1), 1.0);
  EXPECT_NEAR(haar->matrix()(1, 0), 1.0, 4 * epsilon);  // √2 · 1/√2
  EXPECT_NEAR(haar->matrix()(1, 1), -1.0, 4 * epsilon);
}

TEST(Complement, RefusesMapsWhoseRowsDependOnEachOther) {
  const Shape shape(Topology::square, 3, 2);
  RowMatrix t = casteljau_maps(shape);
  t.row(1) = t.row(0);
  t.row(2) = (Eigen::RowVectorXd::Ones(6) - t.row(0) - t.row(1)).eval();  // columns of sum 1
  const Error error = refusal([&] { std::make_shared<Filter>(shape, with_complement(shape, t)); });
  EXPECT_EQ(error.status(), Status::singular);
  EXPECT_EQ(error.argument(), "matrix");
}

TEST(Filter, InverseIsTheInverseWithExactJoints) {
  Random random(5);
  for (const Shape& shape : all_shapes()) {
    const FilterPtr filter = shape.control_points() > 1 ? random_filter(shape, random, 0.02) : casteljau(shape);
    const Index rows = shape.rows();
    const double k = 8 * static_cast<double>(rows) * epsilon * filter->condition();
    EXPECT_LE((filter->inverse() * filter->matrix() - RowMatrix::Identity(rows, rows)).cwiseAbs().maxCoeff(), k)
        << shape;
    EXPECT_NEAR(filter->condition() / condition_number(filter->matrix()), 1.0, k) << shape;
    if (!shape.joined()) continue;
    EXPECT_EQ(filter->inverse().col(0), Eigen::VectorXd::Unit(rows, 0)) << shape;
    EXPECT_EQ(filter->inverse().col(shape.control_points() - 1), Eigen::VectorXd::Unit(rows, rows - 1)) << shape;
  }
}

TEST(Filter, InverseIsRightToTheLastDigitsWhateverTheCondition) {
  using Long = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
  for (const Shape& shape : all_shapes(16, 4)) {
    const FilterPtr filter = casteljau(shape);
    const RowMatrix wanted = Long(filter->matrix().cast<long double>()).partialPivLu().inverse().cast<double>();
    // Entries are of very different size; rounding is that of the largest. 4: a step of Newton's, and this one's own.
    EXPECT_LE((filter->inverse() - wanted).cwiseAbs().maxCoeff(), 4 * epsilon * wanted.cwiseAbs().maxCoeff()) << shape;
  }
}

TEST(Filter, GivesItsMapsAndDetailMapsByTheirColumns) {
  const FilterPtr koch = named_filter("koch", Topology::joined, 0, 0);
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(koch->map(i), koch->matrix().block(0, 2 * i, 3, 3));
    EXPECT_EQ(koch->detail_map(i), koch->matrix().block(3, 2 * i, 6, 3));
  }
  for (int i = 0; i + 1 < 4; ++i) {
    EXPECT_EQ(koch->map(i).rightCols(1), koch->map(i + 1).leftCols(1));
    EXPECT_EQ(koch->detail_map(i).rightCols(1), koch->detail_map(i + 1).leftCols(1));
  }
}

class RefusedFilter : public ::testing::Test {
 protected:
  Error refused(const Shape& shape, const RowMatrix& r) {
    return refusal([&] { Filter(shape, r); });
  }
  const Shape joined{Topology::joined, 4, 2}, square{Topology::square, 4, 2};
  const RowMatrix joined_r = casteljau(joined)->matrix(), square_r = casteljau(square)->matrix();
};

TEST_F(RefusedFilter, OfTheWrongSizeSaysHowManyEntriesItNeeds) {
  const Error error = refused(joined, RowMatrix::Identity(6, 6));
  EXPECT_EQ(error.status(), Status::shape);
  EXPECT_EQ(error.argument(), "matrix");
  EXPECT_EQ(error.required(), 49);
}

TEST_F(RefusedFilter, WithAnEntryThatIsNotFiniteNamesItsIndex) {
  for (const double bad : {std::numeric_limits<double>::infinity(), std::nan("")})
    for (const Index at : {Index{0}, Index{17}, joined_r.size() - 1}) {
      RowMatrix r = joined_r;
      r.data()[at] = bad;
      const Error error = refused(joined, r);
      EXPECT_EQ(error.status(), Status::not_finite);
      EXPECT_EQ(error.argument(), "matrix");
      EXPECT_EQ(error.index(), at);
    }
}

TEST_F(RefusedFilter, WithAColumnThatDoesNotSumToOneNamesTheColumnAndTheSum) {
  for (const auto& [shape, matrix] : {std::pair{joined, joined_r}, {square, square_r}})
    for (const double by : {1e-13, -0.5}) {
      RowMatrix r = matrix;
      r(2, 3) += by;
      const Error error = refused(shape, r);
      EXPECT_EQ(error.status(), Status::singular);
      EXPECT_EQ(error.argument(), "matrix");
      EXPECT_EQ(error.index(), 3);
      EXPECT_NEAR(error.value(), 1 + by, 1e-15);
    }
  RowMatrix nearly = square_r;
  nearly(2, 3) *= 1 + epsilon;  // a last bit is rounding, not a fault
  EXPECT_NO_THROW(Filter(square, nearly));
}

TEST_F(RefusedFilter, WithAJointThatIsNotSharedNamesTheEntry) {
  RowMatrix moved = joined_r;
  moved(0, 0) = 0.75;
  moved(1, 0) = 0.25;
  Error error = refused(joined, moved);
  EXPECT_EQ(error.status(), Status::singular);
  EXPECT_EQ(error.argument(), "matrix");
  EXPECT_EQ(error.index(), 0);
  EXPECT_EQ(error.value(), 0.75);
  for (const Index column : {Index{0}, joined_r.cols() - 1}) {
    RowMatrix detailed = joined_r;
    detailed(5, column) = 1e-300;
    error = refused(joined, detailed);
    EXPECT_EQ(error.status(), Status::singular);
    EXPECT_EQ(error.index(), 5 * joined_r.cols() + column);
    EXPECT_EQ(error.value(), 1e-300);
  }
}

TEST_F(RefusedFilter, ThatCannotBeInvertedTellsItsCondition) {
  for (const double left : {0.0, 1e-16}) {
    RowMatrix r = square_r;
    r.row(7) = r.row(6) + left * r.row(5);
    const Error error = refused(square, r);
    EXPECT_EQ(error.status(), Status::singular);
    EXPECT_EQ(error.argument(), "matrix");
    EXPECT_GT(error.value(), 1e13);
  }
  RowMatrix bad = square_r;  // ill-conditioned is not singular
  bad.row(7) = bad.row(6) + 1e-9 * bad.row(7);
  EXPECT_NO_THROW(Filter(square, bad));
}

TEST_F(RefusedFilter, WithSharedColumnsAtJointsIsSingularWhenSquare) {  // math.md: rank 5 of 6
  const Shape shape(Topology::square, 3, 2);
  RowMatrix r(6, 6);
  r.topRows(3) = casteljau_maps(shape);
  const RowMatrix j = casteljau(Shape(Topology::joined, 3, 2))->matrix();
  r.bottomRows(3).setRandom();
  r.bottomRows(3).col(3) = r.bottomRows(3).col(2);
  EXPECT_EQ(refused(shape, r).status(), Status::singular);
}

// A square filter of n = 2 whose maps multiply differences by `factors`.
Contractivity contractivity_with(double first, double second) {
  const Shape shape(Topology::square, 2, 2);
  RowMatrix t(2, 4);
  for (int i = 0; i < 2; ++i) {
    const double factor = i == 0 ? first : second;
    t.block(0, 2 * i, 2, 2) << (1 + factor) / 2, (1 - factor) / 2, (1 - factor) / 2, (1 + factor) / 2;
  }
  return contractivity_of(shape, t);
}

TEST(Contractivity, HasItsThreeAnswers) {
  EXPECT_EQ(contractivity_with(0.5, 0.9), Contractivity::proven);
  EXPECT_EQ(contractivity_with(0.5, 1.1), Contractivity::refuted);
  EXPECT_NE(contractivity_with(0.5, -1.0), Contractivity::proven);  // on the border: rounding may leave it undecided
  EXPECT_EQ(contractivity_with(0.5, 1 - 1e-11), Contractivity::undecided);
}

TEST(Contractivity, IsRefutedByALongerWordThoughEachMapContracts) {
  // On vectors of sum zero: A = [[0, 2], [0, 0]], B = A^T; each nilpotent, AB has spectral radius 4.
  const Shape shape(Topology::square, 3, 2);
  Matrix basis(3, 2);
  basis << 1 / std::sqrt(2.0), 1 / std::sqrt(6.0), -1 / std::sqrt(2.0), 1 / std::sqrt(6.0), 0, -2 / std::sqrt(6.0);
  Matrix a = Matrix::Zero(2, 2);
  a(0, 1) = 2;
  const Matrix mean = Matrix::Constant(3, 3, 1.0 / 3);
  RowMatrix t(3, 6);
  t << mean + basis * a * basis.transpose(), mean + basis * a.transpose() * basis.transpose();
  EXPECT_EQ(contractivity_of(shape, t), Contractivity::refuted);
  // The same with 0.9: norms are below one in no step but the product's.
  a(0, 1) = 0.9;
  t << mean + basis * a * basis.transpose(), mean + basis * a.transpose() * basis.transpose();
  EXPECT_EQ(contractivity_of(shape, t), Contractivity::proven);
}

TEST(Contractivity, IsProvenThoughSomeMapHasALargeNorm) {
  // A = [[.5, 50], [0, .5]] on vectors of sum zero, alone: norm 50, spectral radius .5.
  const Shape shape(Topology::square, 3, 2);
  Matrix basis(3, 2);
  basis << 1 / std::sqrt(2.0), 1 / std::sqrt(6.0), -1 / std::sqrt(2.0), 1 / std::sqrt(6.0), 0, -2 / std::sqrt(6.0);
  Matrix a(2, 2), b = Matrix::Identity(2, 2) * 0.25;
  a << 0.5, 50, 0, 0.5;
  const Matrix mean = Matrix::Constant(3, 3, 1.0 / 3);
  RowMatrix t(3, 6);
  t << mean + basis * a * basis.transpose(), mean + basis * b * basis.transpose();
  EXPECT_EQ(contractivity_of(shape, t), Contractivity::proven);
}

TEST(Contractivity, OfDeCasteljauIsProvenForEveryShape) {
  for (const Shape& shape : all_shapes())
    EXPECT_EQ(contractivity_of(shape, casteljau_maps(shape)), Contractivity::proven) << shape;
}

TEST(Contractivity, OfTheNamedFiltersIsProven) {
  for (const char* name : {"haar", "bspline", "four-point", "koch", "takagi"})
    EXPECT_EQ(named_filter(name, Topology::square, 0, 0)->contractivity(), Contractivity::proven) << name;
}

}  // namespace
