#include "fit/curve_walk.h"

#include <gtest/gtest.h>

#include "curve/evaluate.h"
#include "curves.h"
#include "fit/refine.h"

namespace ifsm::core {
namespace {

struct Case {
  int control_points, maps, levels;
};
const Case cases[] = {{2, 2, 4}, {3, 4, 3}, {5, 2, 5}, {4, 3, 0}, {7, 5, 2}};

TEST(CurveWalk, GivesTheCurveThatModelsOfItEvaluate) {
  for (const Case& c : cases) {
    const FilterPtr filter = named_filter("casteljau", Topology::joined, c.control_points, c.maps);
    const Points polygon = walk(c.control_points, 2, 3);
    const ModelPtr model = from_polygon(filter, polygon, false, c.levels);
    std::vector<double> parameters = {0, 1e-9, 0.1, 0.1, 0.25, 0.5, 0.6180339887, 0.999999, 1};  // one twice
    const Points wanted = evaluate(*model, Curve::polyline, parameters);
    const Watch watch;
    Index next = 0;
    CurveWalk(filter->shape(), c.levels, filter->matrix(), watch)
        .basis(positions_of(filter->shape(), c.levels, parameters), [&](Index k, const double* basis) {
          EXPECT_EQ(k, next++);
          const Eigen::RowVectorXd at =
              Eigen::Map<const Eigen::RowVectorXd>(basis, c.control_points) * polygon.matrix();
          // Sums of n products at each level.
          EXPECT_LT((at - wanted.matrix().row(k)).norm(), 1e-14 * 10) << "n = " << c.control_points << ", " << k;
        });
    EXPECT_EQ(next, static_cast<Index>(parameters.size()));
  }
}

TEST(CurveWalk, MovesWithCAsDifferencesSay) {
  constexpr double h = 1e-6;
  for (const Case& c : cases) {
    const FilterPtr filter = named_filter("casteljau", Topology::joined, c.control_points, c.maps);
    const Shape& shape = filter->shape();
    const Lanes control = walk(c.control_points, 3, 3).matrix();
    const std::vector<double> parameters = {0, 0.07, 0.3, 0.5, 0.81, 1};
    const auto positions = positions_of(shape, c.levels, parameters);
    const Watch watch;
    const Eigen::VectorXd start = parameters_of(shape, filter->matrix(), Part::maps);
    const Index count = start.size();
    std::vector<Lanes> tangents;
    CurveWalk(shape, c.levels, filter->matrix(), watch)
        .tangents(positions, control, [&](Index, const double*, const double* tangent) {
          tangents.emplace_back(Eigen::Map<const Lanes>(tangent, 3, count));
        });
    for (Index p = 0; p < count; ++p) {
      std::vector<Eigen::RowVector3d> moved(parameters.size(), Eigen::RowVector3d::Zero());
      for (const double sign : {1.0, -1.0}) {
        Eigen::VectorXd there = start;
        there(p) += sign * h;
        CurveWalk(shape, c.levels, matrix_of(shape, there.data(), Part::maps, filter->matrix()), watch)
            .basis(positions, [&](Index k, const double* basis) {
              moved[static_cast<std::size_t>(k)] +=
                  sign / (2 * h) * (Eigen::Map<const Eigen::RowVectorXd>(basis, c.control_points) * control);
            });
      }
      for (std::size_t k = 0; k < moved.size(); ++k)  // eps / h, and h² of the third derivative
        EXPECT_LT((tangents[k].col(p).transpose() - moved[k]).norm(), 1e-8) << "n = " << c.control_points;
    }
  }
}

TEST(Refined, IsTheLineOfAModelWithoutDetails) {
  const FilterPtr filter = named_filter("casteljau", Topology::joined, 4, 3);
  const Points polygon = walk(4, 2, 5);
  const ModelPtr model = from_polygon(filter, polygon, false, 4);
  const Lanes fine = refined(filter->shape(), filter->matrix(), polygon.matrix(), 0, 4);
  EXPECT_LT((from_center(line(*model, 4), model->parts().center).matrix() - fine).norm(), 1e-12);
  const Lanes middle = refined(filter->shape(), filter->matrix(), polygon.matrix(), 0, 2);
  EXPECT_EQ(refined(filter->shape(), filter->matrix(), middle, 2, 4), fine);
}

}  // namespace
}  // namespace ifsm::core
