#include "curve/shape.h"

#include "support.h"

using namespace ifsm::core;
using namespace ifsm::core::testing;

namespace {

TEST(Shape, CountsPlacesAsTheMathDoes) {
  for (const Shape& s : all_shapes())
    for (int level = 0; level <= 3; ++level) {
      const auto nodes = static_cast<Index>(std::llround(std::pow(s.maps(), level)));
      const Index n = s.control_points();
      EXPECT_EQ(s.nodes(level), nodes) << s;
      if (s.joined()) {
        EXPECT_EQ(s.places(level, false), (n - 1) * nodes + 1) << s;
        EXPECT_EQ(s.places(level, true), (n - 1) * nodes) << s;
        EXPECT_EQ(s.line_length(level), (n - 1) * nodes + 1) << s;
      } else {
        EXPECT_EQ(s.places(level, false), s.stride() * (nodes - 1) + n) << s;
        EXPECT_EQ(s.places(level, true), s.stride() * nodes) << s;
        EXPECT_EQ(s.line_length(level), n * nodes) << s;
      }
    }
}

TEST(Shape, IsCriticallySampledWhenJoined) {
  for (const Shape& s : all_shapes())
    if (s.joined())
      for (int levels = 0; levels <= 4; ++levels) {
        Index values = s.control_points();
        for (int l = 0; l < levels; ++l) values += s.detail_count(l);
        EXPECT_EQ(values, s.places(levels, false)) << s << " levels " << levels;
        EXPECT_EQ(s.first_node(levels) * s.details_per_node() + s.control_points(), values) << s;
      }
}

TEST(Shape, HasAsManyDetailsANodeAsTheMathSays) {
  for (const Shape& s : all_shapes()) {
    const int n = s.control_points(), maps = s.maps();
    EXPECT_EQ(s.details_per_node(), s.joined() ? (n - 1) * (maps - 1) : n * (maps - 1)) << s;
    EXPECT_EQ(s.rows(), s.joined() ? (n - 1) * maps + 1 : n * maps) << s;
  }
}

TEST(Shape, ChoosesTheSmallestNumberOfLevelsThatHoldsTheSamples) {
  for (const Shape& s : all_shapes(6, 4))
    for (const bool closed : {false, true})
      for (const Index samples : {2, 3, 5, 17, 100, 1000, 1 << 20}) {
        const int levels = s.levels_for(samples, closed);
        EXPECT_GE(s.places(levels, closed), samples) << s;
        if (levels > 0) {
          EXPECT_LT(s.places(levels - 1, closed), samples) << s;
        }
      }
}

TEST(Shape, RefusesWhatItDoesNotHaveAndNamesTheArgument) {
  const auto argument = [](const auto& call) {
    const Error error = refusal(call);
    EXPECT_EQ(error.status(), Status::range);
    return error.argument();
  };
  EXPECT_EQ(argument([] { Shape(Topology::joined, 1, 2); }), "control_points");
  EXPECT_EQ(argument([] { Shape(Topology::square, 0, 2); }), "control_points");
  EXPECT_EQ(argument([] { Shape(Topology::square, 17, 2); }), "control_points");
  EXPECT_EQ(argument([] { Shape(Topology::joined, 3, 1); }), "maps");
  EXPECT_EQ(argument([] { Shape(Topology::joined, 3, 9); }), "maps");
  EXPECT_EQ(argument([] { Shape(Topology::joined, 3, 2, 1); }), "stride");
  EXPECT_EQ(argument([] { Shape(Topology::square, 3, 2, 4); }), "stride");
  EXPECT_EQ(argument([] { Shape(Topology::square, 3, 2, -1); }), "stride");
  EXPECT_EQ(argument([] { Shape(Topology::joined, 3, 2).checked_levels(-1); }), "levels");
}

TEST(Shape, RefusesTreesBeyondTheLimitWithoutOverflow) {
  for (const Shape& s : all_shapes()) {
    for (const Index levels : {41, 64, 1 << 20}) {
      const Error error = refusal([&] { (void)s.checked_levels(levels); });
      EXPECT_TRUE(error.status() == Status::limit || error.status() == Status::range) << s;
      EXPECT_EQ(error.argument(), "levels") << s;
    }
    EXPECT_EQ(refusal([&] { (void)s.levels_for(Index{1} << 62, false); }).argument(), "levels") << s;
    EXPECT_EQ(s.checked_levels(0), 0);
    EXPECT_EQ(s.checked_levels(10), 10);
  }
}

TEST(Shape, RefusesTreesThatNoMemoryHoldsBeforeAnythingIsAllocated) {
  const Shape shape(Topology::joined, 3, 2);
  EXPECT_NO_THROW(shape.require_memory(10, 2));
  const Error error = refusal([&] { shape.require_memory(38, 4); });  // 64 TiB
  EXPECT_EQ(error.status(), Status::memory);
  EXPECT_EQ(error.argument(), "levels");
}

}  // namespace
