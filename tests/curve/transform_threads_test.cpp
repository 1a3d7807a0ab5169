// Run under the thread sanitizer as well: blocks of a tree share the threads.
#include "base/parallel.h"
#include "curve/transform.h"
#include "support.h"

using namespace ifsm::core;
using namespace ifsm::core::testing;

namespace {

using Values = std::vector<double>;

struct Tree {
  Values polygon;
  std::vector<Values> details;
  Values fine;
};

// There and back on so many threads.
Tree transformed(const Filter& filter, const Values& fine, int levels, int threads) {
  set_default_threads(threads);
  const Shape& shape = filter.shape();
  Tree tree{Values(static_cast<std::size_t>(shape.control_points())), {}, Values(fine.size())};
  for (int l = 0; l < levels; ++l) tree.details.emplace_back(static_cast<std::size_t>(shape.detail_count(l)));
  analyze(filter, fine, tree.polygon, std::vector<Line>(tree.details.begin(), tree.details.end()));
  synthesize(filter, tree.polygon, std::vector<ConstLine>(tree.details.begin(), tree.details.end()), tree.fine);
  set_default_threads(0);
  return tree;
}

TEST(TransformThreads, GiveTheSameBitsWhateverTheirNumber) {
  Random random(7);
  for (const Shape& shape :
       {Shape(Topology::joined, 5, 2), Shape(Topology::joined, 4, 3), Shape(Topology::square, 6, 2, 1)}) {
    const FilterPtr filter = random_filter(shape, random);
    int levels = 1;
    while (shape.line_length(levels) < 100'000) ++levels;  // several blocks
    Values fine(static_cast<std::size_t>(shape.line_length(levels)));
    for (double& value : fine) value = normal(random);
    const Tree one = transformed(*filter, fine, levels, 1);
    for (const int threads : {2, 7, 0}) {
      const Tree many = transformed(*filter, fine, levels, threads);
      EXPECT_EQ(many.polygon, one.polygon) << shape << " threads " << threads;
      EXPECT_EQ(many.details, one.details) << shape << " threads " << threads;
      EXPECT_EQ(many.fine, one.fine) << shape << " threads " << threads;
    }
  }
}

}  // namespace
