#include "fit/approach.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/parallel.h"
#include "curve/resolve.h"
#include "curves.h"
#include "fit/pulls.h"

using namespace ifsm::core;

namespace {

constexpr Distance distances_of_places[] = {Distance::largest, Distance::hausdorff};

FilterPtr casteljau(int control_points) { return named_filter("casteljau", Topology::joined, control_points, 2); }

// Samples of t -> (x(t)) or (x(t), y(t)) for t in -1 … 1.
template <class... Coordinates>
Points sampled(Index count, Coordinates... coordinates) {
  Points points(sizeof...(Coordinates), count);
  for (Index k = 0; k < count; ++k) {
    const double t = -1 + 2 * static_cast<double>(k) / static_cast<double>(count - 1);
    Index axis = 0;
    ((points.matrix()(k, axis++) = coordinates(t)), ...);
  }
  return points;
}

Kept none(const Model& model) { return first_levels(model, 0); }

TEST(Pulls, AreAsFarAsTheCurvesAre) {
  for (const bool closed : {false, true}) {
    const ModelPtr model = analyze(casteljau(4), closed ? loop(100, 2, 1) : walk(100, 2, 1), closed);
    const ModelPtr sketch = keep(*model, most_significant(*model, 20));
    for (const Distance by : distances_of_places) {
      const Pulls pulls = PullingCurve(*model, by, Watch()).pulls(line(*sketch, sketch->levels()));
      // The same distances from the centre as in the samples' coordinates, but for rounding of those; edges do not
      // pull.
      const double apart = distance(*sketch, *model, by), rounding = 1e-13 * model->parts().diagonal;
      EXPECT_LE(pulls.largest, apart + rounding);
      if (by == Distance::largest) {
        EXPECT_NEAR(pulls.largest, apart, rounding);
      }
      EXPECT_EQ(pulls.largest, pulls.distance.maxCoeff());
    }
  }
}

TEST(Pulls, OfACurveToItselfAreNone) {
  const ModelPtr model = analyze(casteljau(4), walk(65, 2, 2), false);
  for (const Distance by : distances_of_places) {
    const Watch watch;
    const PullingCurve curve(*model, by, watch);
    const Pulls pulls = curve.pulls(curve.data());
    const double rounding = 1e-14 * model->parts().diagonal;  // of the middles of edges
    EXPECT_LE(pulls.largest, rounding);
    EXPECT_LE((pulls.target.matrix() - curve.data().matrix()).cwiseAbs().maxCoeff(), rounding);
  }
}

TEST(Approach, FindsChebyshevsApproximationOfACube) {
  // Of all parabolas none is nearer to t³ on -1 … 1 than 1/4 (Chebyshev); that of the least squares is 2/5 away.
  const ModelPtr model = analyze(casteljau(3), sampled(1025, [](double t) { return t * t * t; }), false);
  const ModelPtr squares = resolve(*model, none(*model), Watch());
  const ModelPtr nearest = approach(*model, none(*model), Distance::largest, Watch());
  EXPECT_NEAR(distance(*squares, *model, Distance::largest), 0.4, 2.0 / 1024 * 0.6);  // ends weigh double
  // The 256-norm stops at most 1025^(1/256) = 1.027 above. Between samples the cube may miss its extrema by (1/1024)².
  EXPECT_LE(distance(*nearest, *model, Distance::largest), 0.25 * 1.027);
  EXPECT_GE(distance(*nearest, *model, Distance::largest), 0.25 - 1e-5);
}

TEST(Approach, MayMovePointsAlongTheCurve) {
  // A straight piece that is sampled ever more densely: a straight piece tells it, whatever its speed.
  const ModelPtr model = analyze(casteljau(2),
                                 sampled(
                                     257, [](double t) { return (t + 1) * (t + 1); }, [](double) { return 0.0; }),
                                 false);
  const ModelPtr squares = resolve(*model, none(*model), Watch());
  const ModelPtr nearest = approach(*model, none(*model), Distance::hausdorff, Watch());
  EXPECT_GT(distance(*squares, *model, Distance::hausdorff), 0.3);
  EXPECT_LT(distance(*nearest, *model, Distance::hausdorff), 0.03);
}

TEST(Approach, IsNeverFartherThanTheLeastSquares) {
  for (const bool closed : {false, true})
    for (const Index dimension : {1, 2, 3})
      for (const Index details : {0, 7, 30}) {
        const ModelPtr model =
            analyze(default_filter(5, 2), closed ? loop(200, dimension, 3) : walk(200, dimension, 3), closed);
        const Kept kept = most_significant(*model, details);
        for (const Distance by : distances_of_places) {
          const double values = distance(*resolve(*model, kept, Watch()), *model, by);
          const double choice = distance(*resolve_choice(*model, kept, Watch()), *model, by);
          const ModelPtr of_values = approach(*model, kept, by, Watch());
          const ModelPtr of_choice = approach_choice(*model, kept, by, Watch());
          EXPECT_LE(distance(*of_values, *model, by), values * (1 + 1e-9));
          EXPECT_LE(distance(*of_choice, *model, by), choice * (1 + 1e-9));
          EXPECT_LE(of_values->details_kept(), details);
          EXPECT_LE(of_choice->details_kept(), details);
        }
      }
}

TEST(Approach, BringsRoughCurvesNearer) {
  for (const unsigned seed : {4U, 5U, 6U}) {
    const ModelPtr model = analyze(default_filter(5, 2), walk(513, 2, seed), false);
    const Kept kept = most_significant(*model, 40);
    for (const Distance by : distances_of_places) {
      const double squares = distance(*resolve_choice(*model, kept, Watch()), *model, by);
      const double nearest = distance(*approach_choice(*model, kept, by, Watch()), *model, by);
      // A walk's samples stand for themselves; along the curve there is more room.
      EXPECT_LT(nearest, squares / (by == Distance::hausdorff ? 1.5 : 1.15)) << "seed " << seed;
    }
  }
}

TEST(Approach, GivesTheSameBitsOnOneThreadAndOnTwo) {
  const ModelPtr model = analyze(default_filter(5, 2), walk(513, 2, 7), false);
  const auto on = [&](int threads) {
    const Threads most(threads);
    return samples(*approach_choice(*model, most_significant(*model, 40), Distance::hausdorff, Watch()));
  };
  EXPECT_EQ(on(1), on(2));
}

}  // namespace
