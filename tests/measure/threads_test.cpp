#include "base/parallel.h"
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

}  // namespace
