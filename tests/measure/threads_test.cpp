#include "base/parallel.h"
#include "measure/curvature.h"
#include "measure/refine.h"
#include "support.h"

using namespace ifsm::core;
using namespace ifsm::core::testing;

namespace {

TEST(NearestPoint, HasTheSameBitsOnAnyNumberOfThreads) {
  Random random(4);
  const Points curve = random_curve(random, 5000, 2, Kind::walk);
  const Points queries = queries_about(curve, random, 2000);
  const Polyline polyline(curve, false);
  set_default_threads(1);
  const Nearest alone = nearest(polyline, queries);
  for (const int threads : {2, 7, 0}) {
    set_default_threads(threads);
    expect_same(nearest(polyline, queries), alone);
  }
  set_default_threads(0);
}

TEST(Refinement, HasTheSameBitsOnAnyNumberOfThreads) {
  Random random(5);
  const ModelPtr model =
      analyze(casteljau(Shape(Topology::joined, 5, 2)), random_curve(random, 3000, 2, Kind::walk), true);
  Refinement refinement;
  refinement.levels = 2;
  set_default_threads(1);
  const Points alone = samples(*refine(*model, refinement));
  for (const int threads : {2, 7, 0}) {
    set_default_threads(threads);
    EXPECT_EQ(samples(*refine(*model, refinement)), alone) << threads;
  }
  set_default_threads(0);
}

TEST(Curvature, HasTheSameBitsOnAnyNumberOfThreadsAndTellsTheFirstFault) {
  Random random(6);
  const Points curve = random_curve(random, 2000, 2, Kind::walk);
  const Polyline polyline(curve, false), back(points_of({{0, 0}, {1, 0}, {0, 0}}), false);
  std::vector<double> parameters;
  for (int k = 0; k <= 500; ++k) parameters.push_back(k / 500.0);
  set_default_threads(1);
  const std::vector<double> alone = curvature(polyline, parameters, 20);
  for (const int threads : {2, 7, 0}) {
    set_default_threads(threads);
    EXPECT_EQ(curvature(polyline, parameters, 20), alone);
    const std::vector<double> middle(200, 0.5);
    EXPECT_EQ(refusal([&] { curvature(back, middle, 1); }).index(), 0);
  }
  set_default_threads(0);
}

}  // namespace
