// Run under the thread sanitizer as well: nodes of a level, places of a line and subtrees share the threads.
#include "base/parallel.h"
#include "curve/tree_solver.h"
#include "support.h"

using namespace ifsm::core;
using namespace ifsm::core::testing;

namespace {

struct Solved {
  Solution solution;
  double squared_error;
  std::vector<double> scores;
};

Solved solved(const Model& model, const Kept& kept, int threads) {
  const Threads most(threads);
  TreeSolver solver(model.shape(), model.levels(), model.closed(), sample_weights(model));
  const Points data = line(model, model.levels());
  solver.factor(model.filter().matrix(), kept, {});
  Solved solved{solver.solve(data, {}), 0, {}};
  solved.squared_error = solver.squared_error(data, solved.solution, {});
  solved.scores = solver.scores(data, solved.solution, {});
  return solved;
}

TEST(TreeSolverThreads, GiveTheSameBitsWhateverTheirNumber) {
  Random random(8);
  for (const Shape& shape : {Shape(Topology::joined, 5, 2), Shape(Topology::joined, 4, 3)}) {
    Points points(2, 40'000);
    for (Index k = 1; k < points.count(); ++k)
      for (Index axis = 0; axis < 2; ++axis) points.matrix()(k, axis) = points.matrix()(k - 1, axis) + normal(random);
    const ModelPtr model = analyze(random_filter(shape, random, 0.05), points, false);
    const Kept kept = most_significant(*model, 100);
    const Solved one = solved(*model, kept, 1);
    for (const int threads : {2, 7}) {
      const Solved many = solved(*model, kept, threads);
      EXPECT_EQ(many.solution.control, one.solution.control) << shape << " threads " << threads;
      EXPECT_EQ(many.solution.values, one.solution.values) << shape << " threads " << threads;
      EXPECT_EQ(many.squared_error, one.squared_error) << shape << " threads " << threads;
      EXPECT_EQ(many.scores, one.scores) << shape << " threads " << threads;
    }
  }
}

}  // namespace
