#include "fit/within.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "../curve/support.h"
#include "curve/scale.h"
#include "curves.h"

using namespace ifsm::core;
using ifsm::core::testing::refusal;

namespace {

constexpr Distance all_distances[] = {Distance::rms, Distance::largest, Distance::hausdorff};

ModelPtr model_of(const Points& samples, bool closed = false) { return analyze(default_filter(5, 2), samples, closed); }

ModelPtr within(const Model& model, double bound, Resolve how, Distance distance) {
  Watch watch;
  return keep_within(model, bound, how, distance, watch);
}

TEST(KeepWithin, KeepsItsBoundByEveryDistanceAndWayOfSolving) {
  for (const bool closed : {false, true}) {
    const ModelPtr model = model_of(closed ? loop(257, 2, 1) : walk(257, 2, 1), closed);
    for (const Distance by : all_distances) {
      const Index none = within(*model, 1.5, Resolve::none, by)->details_kept();
      for (const Resolve how : {Resolve::none, Resolve::values, Resolve::choice}) {
        const ModelPtr sketch = within(*model, 1.5, how, by);
        EXPECT_LE(distance(*sketch, *model, by), 1.5);
        EXPECT_GT(sketch->details_kept(), 0);
        EXPECT_LE(sketch->details_kept(), none) << "solving needs no more details";
      }
    }
  }
}

// What is kept as it was found is not nearest: a bound so loose that no details are needed is no reason to be far off.
TEST(KeepWithin, SolvesWhatItFoundByCheaperWays) {
  const ModelPtr model = model_of(walk(257, 2, 7));
  for (const Distance by : all_distances)
    for (const Resolve how : {Resolve::values, Resolve::choice}) {
      const ModelPtr sketch = within(*model, model->parts().diagonal, how, by);
      ASSERT_EQ(sketch->details_kept(), 0);
      EXPECT_EQ(distance(*sketch, *model, by),
                std::min(distance(*resolved(*model, most_significant(*model, 0), how, by, Watch()), *model, by),
                         distance(*keep(*model, most_significant(*model, 0)), *model, by)));
    }
}

TEST(KeepWithin, NeedsTheLastOfItsDetails) {
  const ModelPtr model = model_of(walk(129, 2, 2));
  for (const Distance by : all_distances)
    for (const Resolve how : {Resolve::none, Resolve::values}) {
      const Index kept = within(*model, 1, how, by)->details_kept();
      const ModelPtr fewer = resolved(*model, most_significant(*model, kept - 1), how, by, Watch());
      EXPECT_GT(distance(*fewer, *model, by), 1);
    }
}

TEST(KeepWithin, ByAChoiceForHausdorffTakesFewerDetailsThanByOneForTheSquares) {
  const ModelPtr model = model_of(walk(513, 2, 3));
  for (const double bound : {1.5, 3.0}) {
    const ModelPtr chosen = within(*model, bound, Resolve::choice, Distance::hausdorff);
    // The most that squares allow: as many details, their choice and values for the mean square.
    const ModelPtr squares =
        resolved(*model, most_significant(*model, chosen->details_kept()), Resolve::choice, Distance::rms, Watch());
    EXPECT_LE(distance(*chosen, *model, Distance::hausdorff), bound);
    EXPECT_GT(distance(*squares, *model, Distance::hausdorff), 1.1 * bound);
  }
}

TEST(KeepWithin, KeepsNothingOfWhatIsNotNeededAndAllOfWhatIs) {
  const ModelPtr model = model_of(walk(65, 2, 4));
  const double least = 1e-12 * model->parts().diagonal;
  for (const Distance by : all_distances)
    for (const Resolve how : {Resolve::none, Resolve::values, Resolve::choice}) {
      EXPECT_EQ(within(*model, 100 * model->parts().diagonal, how, by)->details_kept(), 0);
      EXPECT_LE(distance(*within(*model, least, how, by), *model, by), least);
    }
  const FilterPtr koch = named_filter("koch", Topology::joined, 0, 0);
  const ModelPtr exact = analyze(koch, koch_samples(4), false);
  EXPECT_EQ(within(*exact, 1e-9, Resolve::none, Distance::hausdorff)->details_kept(), 0);
}

TEST(KeepWithin, TakesSquareModels) {
  const FilterPtr square = named_filter("casteljau", Topology::square, 4, 2);
  const ModelPtr model = analyze(square, walk(129, 2, 5), false);
  for (const Distance by : all_distances)
    for (const Resolve how : {Resolve::none, Resolve::values, Resolve::choice})
      EXPECT_LE(distance(*within(*model, 2, how, by), *model, by), 2);
}

TEST(KeepWithin, IsTheSameForCurvesOfAnySize) {
  const Points samples = walk(129, 2, 6);
  const ModelPtr model = model_of(samples);
  for (const Distance by : all_distances) {
    const ModelPtr sketch = within(*model, 2, Resolve::choice, by);
    for (const int exponent : {-700, 600}) {
      const ModelPtr there = model_of(scaled(samples, exponent));
      const ModelPtr far = within(*there, std::scalbn(2.0, exponent), Resolve::choice, by);
      EXPECT_EQ(scaled(ifsm::core::samples(*far), -exponent), ifsm::core::samples(*sketch));
    }
  }
}

TEST(KeepWithin, RefusesBoundsBelowWhatModelsPromise) {
  const ModelPtr model = model_of(walk(65, 2, 7));
  for (const double bound : {-1.0, 0.0, 1e-13 * model->parts().diagonal}) {
    const Error error = refusal([&] { within(*model, bound, Resolve::none, Distance::rms); });
    EXPECT_EQ(error.status(), Status::range);
    EXPECT_EQ(error.argument(), "threshold");
    EXPECT_EQ(error.value(), bound);
  }
  EXPECT_EQ(refusal([&] { within(*model, NAN, Resolve::none, Distance::rms); }).status(), Status::not_finite);
}

TEST(KeepWithin, TellsProgressThatNeverGoesBackAndStopsWhenAsked) {
  const ModelPtr model = model_of(walk(257, 2, 8));
  double last = 0;
  int told = 0;
  Watch listening(nullptr, [&](double fraction, const char*) {
    EXPECT_GE(fraction, last);
    EXPECT_LE(fraction, 1);
    last = fraction;
    ++told;
    return false;
  });
  keep_within(*model, 1, Resolve::choice, Distance::hausdorff, listening);
  EXPECT_GT(told, 5);
  Watch stopping(nullptr, [](double fraction, const char*) { return fraction > 0.2; });
  EXPECT_THROW(keep_within(*model, 1, Resolve::choice, Distance::hausdorff, stopping), Cancelled);
}

TEST(KeepWithin, StopsInTheMiddleOfADistance) {
  const ModelPtr model = model_of(walk(513, 2, 8));
  CancelToken token;
  token.request();
  const Watch watch(&token, {});
  EXPECT_THROW(distance(*model, *model, Distance::hausdorff, watch), Cancelled);
}

TEST(KeepLevelsWithin, KeepsTheFirstLevelsThatSuffice) {
  const ModelPtr model = model_of(walk(257, 2, 9));
  for (const Distance by : all_distances)
    for (const Resolve how : {Resolve::none, Resolve::values})
      for (const double bound : {1e3, 2.0, 0.5, 1e-9}) {
        Watch watch;
        const ModelPtr sketch = keep_levels_within(*model, bound, how, by, watch);
        int levels = 0;
        while (levels < model->levels() &&
               distance(*resolved(*model, first_levels(*model, levels), how, by, watch), *model, by) > bound)
          ++levels;
        const ModelPtr wanted =
            levels == model->levels() ? model : resolved(*model, first_levels(*model, levels), how, by, watch);
        EXPECT_EQ(samples(*sketch), samples(*wanted));
      }
}

}  // namespace
