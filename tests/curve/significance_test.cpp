#include "curve/significance.h"

#include "support.h"

using namespace ifsm::core;
using namespace ifsm::core::testing;

namespace {

// What a unit detail does: the sum of its squared changes over all places.
double brute_force(const FilterPtr& filter, int levels, int level, Index detail) {
  const Shape& shape = filter->shape();
  ModelParts parts;
  parts.filter = filter;
  parts.center = {0.0};
  parts.polygon = Points(1, shape.control_points());
  for (int l = 0; l < levels; ++l) {
    auto details = std::make_shared<Points>(1, shape.detail_count(l));
    if (l == level) details->plane(0)[static_cast<std::size_t>(detail)] = 1;
    parts.details.push_back(std::move(details));
  }
  return std::sqrt(lay(shape, false, line(parts, levels), levels).matrix().squaredNorm());
}

TEST(Gains, AreWhatAUnitDetailDoesToThePlaces) {
  Random random(1);
  for (const Topology topology : {Topology::joined, Topology::square})
    for (int n = topology == Topology::joined ? 2 : 1; n <= 6; ++n)
      for (int maps = 2; maps <= 4; ++maps)
        for (const bool perturbed : {false, true}) {
          const Shape shape(topology, n, maps, topology == Topology::joined ? 0 : n);  // square: each place read once
          const FilterPtr filter = perturbed ? random_filter(shape, random) : casteljau(shape);
          const int levels = maps == 2 ? 4 : 3;
          const auto g = gains(*filter, levels);
          ASSERT_EQ(g.size(), static_cast<std::size_t>(levels));
          for (int level = 0; level < levels; ++level) {
            const Index nodes = shape.nodes(level), d = shape.details_per_node();
            ASSERT_EQ(g[static_cast<std::size_t>(level)].size(), d);
            for (const Index node : {Index{0}, nodes / 2, nodes - 1})
              for (Index j = 0; j < d; ++j) {
                const double found = g[static_cast<std::size_t>(level)](j);
                EXPECT_NEAR(found, brute_force(filter, levels, level, node * d + j),
                            64 * shape.rows() * epsilon * (1 + found))
                    << shape << " level " << level << " node " << node << " detail " << j;
              }
          }
        }
}

TEST(Gains, OfASmallerStrideCountEachReadingByItsShare) {
  for (int n = 2; n <= 5; ++n)
    for (int stride = 1; stride <= n; ++stride) {
      const FilterPtr whole = casteljau(Shape(Topology::square, n, 2, n)),
                      part = casteljau(Shape(Topology::square, n, 2, stride));
      const auto a = gains(*whole, 3), b = gains(*part, 3);
      for (std::size_t l = 0; l < 3; ++l)
        EXPECT_LE((b[l] - a[l] * std::sqrt(static_cast<double>(stride) / n)).norm(), 16 * epsilon * a[l].norm());
    }
}

TEST(Significance, IsTheLengthOfADetailTimesItsGain) {
  Random random(2);
  for (const Shape& shape : all_shapes(5, 3)) {
    const ModelPtr model = analyze(casteljau(shape), random_curve(random, 60, 3, Kind::walk), false);
    const auto g = gains(model->filter(), model->levels());
    for (int level = 0; level < model->levels(); ++level) {
      const Eigen::VectorXd values = significance(*model, level);
      ASSERT_EQ(values.size(), shape.detail_count(level));
      for (Index i = 0; i < values.size(); ++i) {
        const double wanted = model->details(level).matrix().row(i).norm() *
                              g[static_cast<std::size_t>(level)](i % shape.details_per_node());
        EXPECT_NEAR(values(i), wanted, 16 * epsilon * wanted);
      }
    }
    EXPECT_EQ(refusal([&] { significance(*model, model->levels()); }).argument(), "level");
    EXPECT_EQ(refusal([&] { significance(*model, -1); }).argument(), "level");
  }
}

TEST(Significance, NeitherOverflowsNorUnderflows) {
  Random random(3);
  const FilterPtr filter = casteljau(Shape(Topology::joined, 4, 2));
  for (const double scale : {1e-200, 1e200}) {
    Points given = random_curve(random, 40, 2, Kind::noise);
    given.matrix() *= scale;
    const ModelPtr model = analyze(filter, given, false);
    EXPECT_TRUE(significance(*model, 0).allFinite());
    EXPECT_GT(significance(*model, 0).minCoeff(), 0.0);
  }
}

}  // namespace
