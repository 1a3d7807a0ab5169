#include "curve/keep.h"

#include <algorithm>

#include "support.h"

using namespace ifsm::core;
using namespace ifsm::core::testing;

namespace {

std::vector<double> all_significances(const Model& model) {
  std::vector<double> all;
  for (int level = 0; level < model.levels(); ++level) {
    const Eigen::VectorXd values = significance(model, level);
    all.insert(all.end(), values.begin(), values.end());
  }
  return all;
}

Index count(const Kept& kept) { return std::ranges::count(kept, char{1}); }

ModelPtr some_model(Random& random, Topology topology, Kind kind = Kind::walk) {
  return analyze(casteljau(Shape(topology, 4, 2)), random_curve(random, 120, 2, kind), false);
}

constexpr Topology both[] = {Topology::joined, Topology::square};

TEST(Keep, TheFirstLevels) {
  Random random(1);
  for (const auto topology : both) {
    const ModelPtr model = some_model(random, topology);
    for (int levels = 0; levels <= model->levels(); ++levels) {
      const ModelPtr sketch = keep(*model, first_levels(*model, levels));
      for (int l = 0; l < model->levels(); ++l)
        EXPECT_EQ(sketch->details(l), l < levels ? model->details(l) : Points(2, model->details(l).count()));
      EXPECT_EQ(sketch->parts().polygon, model->parts().polygon);
    }
    EXPECT_EQ(refusal([&] { first_levels(*model, model->levels() + 1); }).argument(), "count");
    EXPECT_EQ(refusal([&] { first_levels(*model, -1); }).argument(), "count");
  }
}

TEST(Keep, TheMostSignificantIsTheWholeModelOrNothingAtTheEnds) {
  Random random(2);
  for (const auto topology : both) {
    const ModelPtr model = some_model(random, topology);
    EXPECT_EQ(samples(*keep(*model, most_significant(*model, model->details_total()))), samples(*model));
    EXPECT_EQ(keep(*model, most_significant(*model, 0))->details_kept(), 0);
    EXPECT_EQ(refusal([&] { most_significant(*model, -1); }).argument(), "count");
    EXPECT_EQ(refusal([&] { most_significant(*model, model->details_total() + 1); }).status(), Status::range);
  }
}

TEST(Keep, TheMostSignificantLeavesNoLargerOneOut) {
  Random random(3);
  for (const auto topology : both) {
    const ModelPtr model = some_model(random, topology);
    const std::vector<double> values = all_significances(*model);
    for (Index k = 0; k <= model->details_total(); k += 7) {
      const Kept kept = most_significant(*model, k);
      EXPECT_EQ(count(kept), k);
      double least_kept = INFINITY, most_dropped = -1;
      for (std::size_t i = 0; i < kept.size(); ++i)
        (kept[i] ? least_kept : most_dropped) =
            kept[i] ? std::min(least_kept, values[i]) : std::max(most_dropped, values[i]);
      EXPECT_GE(least_kept, most_dropped) << k;
    }
  }
}

TEST(Keep, GivesTiesToTheFirst) {
  const std::vector<double> values = {1, 3, 2, 3, 2, 2, 3};
  EXPECT_EQ(largest(values, 0), (Kept{0, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(largest(values, 2), (Kept{0, 1, 0, 1, 0, 0, 0}));
  EXPECT_EQ(largest(values, 4), (Kept{0, 1, 1, 1, 0, 0, 1}));
  EXPECT_EQ(largest(values, 5), (Kept{0, 1, 1, 1, 1, 0, 1}));
  EXPECT_EQ(largest(values, 7), (Kept{1, 1, 1, 1, 1, 1, 1}));
  Random random(4);  // all equal: the coarsest, then the first
  const ModelPtr flat = some_model(random, Topology::joined, Kind::constant);
  const Kept kept = most_significant(*flat, 5);
  EXPECT_TRUE(std::is_sorted(kept.rbegin(), kept.rend()));
}

TEST(Keep, AThresholdKeepsWhatIsAboveItAndNotWhatEqualsIt) {
  Random random(5);
  for (const auto topology : both) {
    const ModelPtr model = some_model(random, topology);
    const std::vector<double> values = all_significances(*model);
    std::vector<double> sorted = values;
    std::ranges::sort(sorted);
    const double threshold = sorted[sorted.size() / 2];
    const Kept kept = above(*model, threshold);
    for (std::size_t i = 0; i < kept.size(); ++i) EXPECT_EQ(kept[i] != 0, values[i] > threshold);
    EXPECT_EQ(count(above(*model, INFINITY)), 0);
    EXPECT_EQ(count(above(*model, -1)), model->details_total());
  }
}

TEST(Keep, WorksOnAModelWithoutLevels) {
  Points two(2, 2);
  two.plane(0)[1] = 1;
  const ModelPtr model = analyze(casteljau(Shape(Topology::joined, 2, 2)), two, false);
  ASSERT_EQ(model->levels(), 0);
  EXPECT_EQ(first_levels(*model, 0).size(), 0u);
  EXPECT_EQ(samples(*keep(*model, most_significant(*model, 0))), two);
}

}  // namespace
