#include "fit/collage.h"

#include <gtest/gtest.h>

#include "curves.h"

namespace ifsm::core {
namespace {

bool any(const RowMatrix& matrix) { return matrix.allFinite(); }

// The Koch curve's polygons are made from their parents by one filter, which need not be known: de Casteljau's analysis
// passes the ends of polygons on, and with three control points two of the three are ends.
TEST(Collage, ComesNearAFilterThatTheCurveWasMadeBy) {
  const FilterPtr koch = named_filter("koch", Topology::joined, 0, 0);
  const ModelPtr model = analyze(koch, koch_samples(4), false);
  const std::vector<ModelPtr> models = {model};
  const RowMatrix found = collage(models, any);
  // Its own polygons leave nothing to better.
  EXPECT_LT((found.topRows(3) - koch->matrix().topRows(3)).norm(), 1e-10);
  const ModelPtr rough = analyze(named_filter("casteljau", Topology::joined, 3, 4), koch_samples(4), false);
  const std::vector<ModelPtr> others = {rough};
  const RowMatrix other = collage(others, any);
  EXPECT_GT((other.topRows(3) - rough->filter().matrix().topRows(3)).norm(), 0.1);
  for (Index c = 0; c < other.cols(); ++c) EXPECT_NEAR(other.col(c).head(3).sum(), 1, 1e-14);
}

TEST(Collage, IsDrawnBackAsFarAsItIsAskedTo) {
  const ModelPtr model = analyze(named_filter("casteljau", Topology::joined, 5, 2), walk(300, 2, 1), false);
  const std::vector<ModelPtr> models = {model};
  EXPECT_EQ(collage(models, [](const RowMatrix&) { return false; }), model->filter().matrix());
  int asked = 0;
  const RowMatrix nearer = collage(models, [&](const RowMatrix&) { return ++asked == 3; });
  const RowMatrix whole = collage(models, any), own = model->filter().matrix();
  // A quarter of the way.
  EXPECT_LT((4 * (nearer - own).topRows(5) - (whole - own).topRows(5)).norm(), 1e-12);
}

}  // namespace
}  // namespace ifsm::core
