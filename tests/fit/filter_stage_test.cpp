#include "fit/filter_stage.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/parallel.h"
#include "curve/keep.h"
#include "curve/resolve.h"
#include "curves.h"
#include "fit/certainty.h"
#include "fit/truncation.h"

namespace ifsm::core {
namespace {

FitResult fitted(const std::vector<FitCurve>& curves, const FilterOptions& options) {
  Watch watch;
  return fit_filter(curves, options, watch);
}

FilterOptions shaped(int control_points, int maps, int kept) {
  FilterOptions options;
  options.control_points = control_points;
  options.maps = maps;
  options.kept_levels = kept;
  return options;
}

struct Case {
  int control_points, maps;
  Index dimension, samples;
  bool closed;
  int kept;
};

const Case cases[] = {{3, 2, 1, 33, false, 0},  {3, 2, 2, 40, false, 2}, {5, 2, 2, 65, true, 1},
                      {4, 3, 3, 50, false, 1},  {3, 4, 4, 90, true, 0},  {2, 2, 2, 30, false, 1},
                      {3, 2, 1, 9000, false, 1}};  // the last in several blocks

// Central differences are good to h² f''' / 6 + eps f / h: with h = 1e-5 about 1e-9 of the objective's size.
TEST(Truncation, HasTheGradientThatCentralDifferencesSee) {
  constexpr double h = 1e-5;
  for (const Case& c : cases) {
    const FilterPtr filter = named_filter("casteljau", Topology::joined, c.control_points, c.maps);
    const Shape& shape = filter->shape();
    const ModelPtr model =
        analyze(filter, c.closed ? loop(c.samples, c.dimension, 7) : walk(c.samples, c.dimension, 7), c.closed);
    const Points finest = line(*model, model->levels());
    const Watch watch;
    Truncation objective(shape, {{&finest, model->levels(), c.kept, sample_weights(*model)}}, watch);
    Eigen::VectorXd parameters = parameters_of(shape, filter->matrix(), Part::details);
    std::mt19937 random(11);
    std::uniform_real_distribution<double> step(-0.05, 0.05);
    for (double& p : parameters) p += step(random);
    const auto matrix = [&](const Eigen::VectorXd& p) {
      return matrix_of(shape, p.data(), Part::details, filter->matrix());
    };
    const Index count = parameters.size();
    Normal normal(static_cast<int>(count));
    objective.gather(matrix(parameters), normal);
    const double value = objective.value(matrix(parameters));
    EXPECT_EQ(normal.product()(count, count), value);
    for (Index p = 0; p < count; ++p) {
      Eigen::VectorXd up = parameters, down = parameters;
      up(p) += h;
      down(p) -= h;
      const double difference = (objective.value(matrix(up)) - objective.value(matrix(down))) / (2 * h);
      EXPECT_NEAR(2 * normal.product()(count, p), difference, 1e-7 * (value + std::abs(difference)))
          << "n = " << c.control_points << ", parameter " << p;
    }
    // JᵀJ, by differences of the sketches themselves.
    const auto sketch = [&](const Eigen::VectorXd& p) {
      const ModelPtr made = analyze(std::make_shared<Filter>(shape, matrix(p)), samples(*model), c.closed);
      const Points now = samples(*keep(*made, first_levels(*made, c.kept)));
      return Eigen::VectorXd(now.matrix().reshaped());
    };
    Eigen::MatrixXd jacobian(c.samples * c.dimension, count);
    for (Index p = 0; p < count; ++p) {
      Eigen::VectorXd up = parameters, down = parameters;
      up(p) += h;
      down(p) -= h;
      jacobian.col(p) = (sketch(up) - sketch(down)) / (2 * h);
    }
    const Eigen::MatrixXd form = normal.product().topLeftCorner(count, count).selfadjointView<Eigen::Lower>();
    EXPECT_LE((form - jacobian.transpose() * jacobian).norm(), 1e-7 * form.norm() + 1e-12 * value);
  }
}

TEST(Truncation, IsTheSquaredErrorOfTheSketchOfTheFirstLevels) {
  for (const Case& c : cases) {
    const FilterPtr filter = named_filter("casteljau", Topology::joined, c.control_points, c.maps);
    const Points points = c.closed ? loop(c.samples, c.dimension, 7) : walk(c.samples, c.dimension, 7);
    const ModelPtr model = analyze(filter, points, c.closed);
    const Points finest = line(*model, model->levels());
    const Watch watch;
    Truncation objective(filter->shape(), {{&finest, model->levels(), c.kept, sample_weights(*model)}}, watch);
    const Points sketch = samples(*keep(*model, first_levels(*model, c.kept)));
    const double wanted = (sketch.matrix() - points.matrix()).squaredNorm();
    EXPECT_NEAR(objective.value(filter->matrix()), wanted, 1e-12 * wanted);
  }
}

TEST(FilterStage, LowersTheErrorOfTheFirstLevelsAndLeavesTAlone) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    const bool closed = seed % 2 == 0;
    const Points points = closed ? loop(300, 2, seed) : walk(300, 2, seed);
    const FitResult result = fitted({{points, closed}}, shaped(5, 2, 2));
    const FilterPtr start = named_filter("casteljau", Topology::joined, 5, 2);
    EXPECT_EQ(result.filter->matrix().topRows(5), start->matrix().topRows(5));
    EXPECT_LT(result.final_cost, result.start_cost);
    const FitBudget& row = result.budgets[0][0];
    EXPECT_LT(row.fitted.rms, row.start.rms);
    EXPECT_EQ(row.details, (1 + 2) * 4);
    EXPECT_NEAR(result.final_cost, row.fitted.rms * row.fitted.rms * 300, 1e-9 * result.final_cost);
    // No choice of U does better than the polygons' own least squares.
    const Points best = samples(*resolve(*result.models[0], first_levels(*result.models[0], 2), Watch{}));
    EXPECT_GE(result.final_cost, (best.matrix() - points.matrix()).squaredNorm() * (1 - 1e-12));
    EXPECT_LT((samples(*result.models[0]).matrix() - points.matrix()).cwiseAbs().maxCoeff(), 1e-12 * diagonal(points));
  }
}

TEST(FilterStage, ChangesNothingWhenAllLevelsAreKept) {
  const Points points = walk(100, 2, 3);
  for (const int kept : {5, 20}) {  // 65 places of 4 levels do not hold 100 samples, 129 of 5 do
    const FitResult result = fitted({{points, false}}, shaped(5, 2, kept));
    EXPECT_EQ(result.filter->matrix(), named_filter("casteljau", Topology::joined, 5, 2)->matrix());
    EXPECT_EQ(result.reason, FitReason::start_best);
    EXPECT_LT(result.budgets[0][0].fitted.rms, 1e-12 * diagonal(points));
  }
}

// U is seen by its row space alone: (rows - 2)(rows - n) entries less (rows - n)² of its basis.
TEST(FilterStage, TellsACovarianceOfTheRankThatUHas) {
  const FitResult result = fitted({{walk(300, 2, 1), false}}, shaped(4, 2, 1));
  const Certainty& certainty = *result.certainty;
  const Eigen::MatrixXd covariance = filter_covariance(certainty);
  EXPECT_EQ(covariance.rows(), 3 * 7);
  EXPECT_LT((covariance - covariance.transpose()).norm(), 1e-12 * covariance.norm());
  EXPECT_EQ(covariance.diagonal().minCoeff(), 0);  // first and last column
  EXPECT_EQ(certainty.freedom, (300 - 7) * 2 - (5 * 3 - 3 * 3));
}

TEST(FilterStage, GivesTheSameBitsAgainAndSharesAFilterBetweenCurves) {
  const std::vector<FitCurve> curves = {{walk(200, 2, 1), false}, {loop(300, 2, 2), true}};
  const FitResult once = fitted(curves, shaped(4, 3, 2));
  EXPECT_LT(once.final_cost, once.start_cost);
  for (const int threads : {1, 2, 7}) {
    set_default_threads(threads);
    EXPECT_EQ(once.filter->matrix(), fitted(curves, shaped(4, 3, 2)).filter->matrix());
  }
  set_default_threads(0);
}

TEST(FilterStage, TakesDegenerateCurvesAndStopsWhenToldTo) {
  Points same(2, 50);
  same.matrix().setConstant(3);
  EXPECT_EQ(fitted({{same, false}}, {}).budgets[0][0].fitted.rms, 0);
  EXPECT_EQ(fitted({{walk(2, 2, 1), false}}, {}).reason, FitReason::start_best);
  EXPECT_NO_THROW(fitted({{walk(40, 1, 1), false}}, shaped(2, 2, 1)));  // no inner points: U is not seen at all
  int calls = 0;
  Watch watch(nullptr, [&](double, const char*) { return ++calls == 2; });
  EXPECT_THROW(fit_filter({{walk(300, 2, 1), false}}, {}, watch), Cancelled);
  FilterOptions wrong;
  wrong.tolerance = 0;
  EXPECT_THROW(fitted({{walk(300, 2, 1), false}}, wrong), Error);
}

}  // namespace
}  // namespace ifsm::core
