#include "curve/transform.h"

#include <hwy/targets.h>

#include <bit>
#include <cmath>
#include <limits>
#include "support.h"

using namespace ifsm::core;
using namespace ifsm::core::testing;

namespace {

using Values = std::vector<double>;

Values random_values(Random& random, Index count) {
  Values values(static_cast<std::size_t>(count));
  for (double& value : values) value = normal(random);
  return values;
}

Values joined_values(const Values& a, const Values& b) {
  Values both = a;
  both.insert(both.end(), b.begin(), b.end());
  return both;
}

struct Level {
  Values coarse, details, fine;
};

Level random_level(const Shape& shape, Random& random, int level) {
  return {random_values(random, shape.line_length(level)), random_values(random, shape.detail_count(level)),
          random_values(random, shape.line_length(level + 1))};
}

// Largest magnitudes a sum of `rows` products may reach: what its rounding is proportional to.
double bound(const RowMatrix& matrix) { return matrix.cwiseAbs().colwise().sum().maxCoeff(); }

std::vector<std::uint64_t> bits(const Values& values) {
  std::vector<std::uint64_t> result;
  for (const double value : values) result.push_back(std::bit_cast<std::uint64_t>(value));
  return result;
}

TEST(Transform, IsThePlainFormulaWithinRoundingForEveryShape) {
  Random random(1);
  for (const Shape& shape : all_shapes()) {
    const FilterPtr filter = casteljau(shape);
    for (int level = 0; level <= 1; ++level) {
      const Level given = random_level(shape, random, level);
      Values fast(given.fine.size()), slow(given.fine.size());
      synthesize_level(*filter, given.coarse, given.details, fast);
      plain::synthesize_level(*filter, given.coarse, given.details, slow);
      // Two orders of summing rows() products of values below 6.
      const double k = 2 * shape.rows() * 6 * epsilon;
      for (std::size_t i = 0; i < fast.size(); ++i)
        ASSERT_NEAR(fast[i], slow[i], k * bound(filter->matrix())) << shape << " place " << i;

      Values coarse(given.coarse.size()), details(given.details.size()), c(coarse), d(details);
      analyze_level(*filter, given.fine, coarse, details);
      plain::analyze_level(*filter, given.fine, c, d);
      for (std::size_t i = 0; i < coarse.size(); ++i)
        ASSERT_NEAR(coarse[i], c[i], k * bound(filter->inverse())) << shape << " coarse " << i;
      for (std::size_t i = 0; i < details.size(); ++i)
        ASSERT_NEAR(details[i], d[i], k * bound(filter->inverse())) << shape << " detail " << i;
    }
  }
}

TEST(Transform, HasTheSameBitsOnEveryTargetOfThisMachine) {
  struct Restore {
    ~Restore() { hwy::SetSupportedTargetsForTest(0); }
  } restore;
  Random random(2);
  int targets_seen = 0;
  for (const Shape& shape : all_shapes()) {
    const FilterPtr filter = casteljau(shape);
    const Level given = random_level(shape, random, 1);
    std::vector<std::uint64_t> first;
    hwy::SetSupportedTargetsForTest(0);
    const auto supported = static_cast<std::uint64_t>(hwy::SupportedTargets());
    targets_seen = 0;
    for (std::uint64_t bit = 1; bit != 0; bit <<= 1) {
      if ((supported & bit) == 0) continue;
      hwy::SetSupportedTargetsForTest(static_cast<std::int64_t>(bit));
      hwy::GetChosenTarget().Update(hwy::SupportedTargets());
      ++targets_seen;
      Values fine(given.fine.size()), coarse(given.coarse.size()), details(given.details.size());
      synthesize_level(*filter, given.coarse, given.details, fine);
      analyze_level(*filter, given.fine, coarse, details);
      const auto now = bits(joined_values(fine, joined_values(coarse, details)));
      if (first.empty()) first = now;
      ASSERT_EQ(now, first) << shape << " target " << bit;
    }
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }
  RecordProperty("targets", targets_seen);
  EXPECT_GE(targets_seen, 1);
}

TEST(Transform, WritesNothingBeyondItsLine) {
  Random random(3);
  for (const Shape& shape : all_shapes(7, 4)) {
    const FilterPtr filter = casteljau(shape);
    for (int level = 0; level <= 2; ++level) {
      const Level given = random_level(shape, random, level);
      const auto guarded = [&](std::size_t count, const auto& write) {
        Values padded(count + 64, -7.0);
        write(Line{padded.data(), count});
        for (std::size_t i = count; i < padded.size(); ++i) ASSERT_EQ(padded[i], -7.0) << shape;
      };
      guarded(given.fine.size(), [&](Line out) { synthesize_level(*filter, given.coarse, given.details, out); });
      guarded(given.coarse.size(), [&](Line out) {
        Values details(given.details.size());
        analyze_level(*filter, given.fine, out, details);
      });
      guarded(given.details.size(), [&](Line out) {
        Values coarse(given.coarse.size());
        analyze_level(*filter, given.fine, coarse, out);
      });
    }
  }
}

TEST(Transform, CoarsensToThePolygonsOfAnalysisBitForBit) {
  Random random(5);
  for (const Shape& shape : all_shapes(7, 4)) {
    const FilterPtr filter = casteljau(shape);
    const Level given = random_level(shape, random, 1);
    Values analyzed(given.coarse.size()), coarse(given.coarse.size()), details(given.details.size());
    analyze_level(*filter, given.fine, analyzed, details);
    coarsen_level(shape, filter->inverse(), given.fine, coarse);
    EXPECT_EQ(analyzed, coarse) << shape;
  }
}

struct Tree {
  Values polygon;
  std::vector<Values> details;
  Values fine;

  Tree(const Shape& shape, int levels) : polygon(static_cast<std::size_t>(shape.control_points())) {
    for (int l = 0; l < levels; ++l) details.emplace_back(static_cast<std::size_t>(shape.detail_count(l)));
    fine.resize(static_cast<std::size_t>(shape.line_length(levels)));
  }
  std::vector<Line> lines() { return {details.begin(), details.end()}; }
  std::vector<ConstLine> const_lines() const { return {details.begin(), details.end()}; }
  bool operator==(const Tree&) const = default;
};

double largest_of(const Values& values) {
  double largest = 0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  return largest;
}

// Taken apart one level after the other, and put together again.
struct LevelByLevel {
  Tree tree;
  Extent extent{0, 0};

  LevelByLevel(const Filter& filter, const Values& fine, int levels) : tree(filter.shape(), levels) {
    Values line = fine;
    for (int l = levels; l-- > 0;) {
      Values coarse(static_cast<std::size_t>(filter.shape().line_length(l)));
      Values& details = tree.details[static_cast<std::size_t>(l)];
      analyze_level(filter, line, coarse, details);
      extent = {std::max(extent.polygons, largest_of(coarse)), std::max(extent.details, largest_of(details))};
      line = coarse;
    }
    tree.polygon = line;
    for (int l = 0; l < levels; ++l) {
      Values next(static_cast<std::size_t>(filter.shape().line_length(l + 1)));
      synthesize_level(filter, line, tree.details[static_cast<std::size_t>(l)], next);
      line = next;
    }
    tree.fine = line;
  }
};

// Enough levels that the tree has several blocks, whose roots are parted again.
int several_blocks(const Shape& shape) {
  int levels = 1;
  while (shape.line_length(levels) < 40'000) ++levels;
  return levels;
}

TEST(Transform, OfAllLevelsHasTheBitsOfOneLevelAfterTheOther) {
  Random random(6);
  for (const Shape& shape : all_shapes(9, 4)) {
    const FilterPtr filter = random_filter(shape, random);
    for (const int levels : {0, 1, 2, several_blocks(shape)}) {
      const Values fine = random_values(random, shape.line_length(levels));
      const LevelByLevel expected(*filter, fine, levels);
      Tree tree(shape, levels);
      const Extent extent = analyze(*filter, fine, tree.polygon, tree.lines());
      synthesize(*filter, tree.polygon, tree.const_lines(), tree.fine);
      ASSERT_EQ(tree, expected.tree) << shape << " levels " << levels;
      ASSERT_EQ(extent.details, expected.extent.details) << shape << " levels " << levels;
      if (levels > 0) {
        ASSERT_EQ(extent.polygons, std::max(expected.extent.polygons, largest_of(tree.polygon))) << shape;
      }
    }
  }
}

TEST(Transform, TellsThatANumberLeftTheRangeOfDoublesWhereverItDid) {
  Random random(8);
  const Shape shape(Topology::joined, 5, 2);
  const FilterPtr filter = casteljau(shape);
  const int levels = several_blocks(shape);
  for (const double bad : {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
    for (const std::size_t at : {std::size_t{1}, std::size_t{4003}, std::size_t{40'001}}) {
      Values fine = random_values(random, shape.line_length(levels));
      ASSERT_LT(at, fine.size());
      fine[at] = bad;
      Tree tree(shape, levels);
      const Extent extent = analyze(*filter, fine, tree.polygon, tree.lines());
      EXPECT_FALSE(std::isfinite(extent.polygons)) << bad << " at " << at;
      EXPECT_FALSE(std::isfinite(extent.details)) << bad << " at " << at;
    }
}

TEST(Transform, SynthesisUndoesAnalysis) {
  Random random(4);
  for (const Shape& shape : all_shapes(12)) {
    const FilterPtr filter = random_filter(shape, random);
    const Level given = random_level(shape, random, 1);
    Values fine(given.fine.size()), coarse(given.coarse.size()), details(given.details.size());
    analyze_level(*filter, given.fine, coarse, details);
    synthesize_level(*filter, coarse, details, fine);
    // R^-1 is known to eps · condition; values below 6.
    const double k = 8 * shape.rows() * 6 * epsilon * filter->condition();
    for (std::size_t i = 0; i < fine.size(); ++i) ASSERT_NEAR(fine[i], given.fine[i], k) << shape;
  }
}

TEST(Transform, LeavesJointsUntouchedBitForBit) {
  Random random(5);
  for (const Shape& shape : all_shapes(8, 5)) {
    if (!shape.joined()) continue;
    const FilterPtr filter = random_filter(shape, random);
    const Level given = random_level(shape, random, 2);
    Values fine(given.fine.size());
    synthesize_level(*filter, given.coarse, given.details, fine);
    for (Index node = 0; node <= shape.nodes(2); ++node)
      ASSERT_EQ(fine[static_cast<std::size_t>(node * shape.children_step())],
                given.coarse[static_cast<std::size_t>(node * shape.polygon_step())])
          << shape;
    Values coarse(given.coarse.size()), details(given.details.size());
    analyze_level(*filter, given.fine, coarse, details);
    for (Index node = 0; node <= shape.nodes(2); ++node)
      ASSERT_EQ(coarse[static_cast<std::size_t>(node * shape.polygon_step())],
                given.fine[static_cast<std::size_t>(node * shape.children_step())])
          << shape;
  }
}

}  // namespace
