#include "curve/evaluate.h"

#include "support.h"

using namespace ifsm::core;
using namespace ifsm::core::testing;

namespace {

std::vector<ModelPtr> models(Random& random, Index count, bool closed) {
  std::vector<ModelPtr> all;
  for (const Topology topology : {Topology::joined, Topology::square})
    for (const int n : {1, 2, 3, 5, 8})
      for (const int maps : {2, 3, 5}) {
        if (n == 1 && topology == Topology::joined) continue;
        std::vector<int> strides = {0};
        if (topology == Topology::square) strides = {1, n};
        for (const int stride : strides)
          all.push_back(
              analyze(casteljau(Shape(topology, n, maps, stride)), random_curve(random, count, 2, Kind::walk), closed));
      }
  return all;
}

std::vector<double> parameters_of(const Model& model) {
  std::vector<double> t;
  for (Index k = 0; k < model.placement().samples(); ++k) t.push_back(model.placement().parameter(k));
  return t;
}

TEST(Polyline, ReturnsTheSamplesAtTheirParametersBitForBit) {
  Random random(1);
  for (const bool closed : {false, true})
    for (const Index count : {2, 7, 61, 300})
      for (const ModelPtr& model : models(random, count, closed))
        EXPECT_EQ(evaluate(*model, Curve::polyline, parameters_of(*model)), samples(*model)) << model->shape();
}

TEST(Polyline, HasTheSameBitsForFewParametersAndForMany) {
  Random random(2);
  for (const bool closed : {false, true})
    for (const ModelPtr& model : models(random, 200, closed)) {
      std::vector<double> t = parameters_of(*model);
      for (int k = 0; k < 60; ++k)
        t.push_back(std::uniform_real_distribution<double>(closed ? -3 : 0, closed ? 3 : 1)(random));
      t.push_back(0);
      t.push_back(1);
      ASSERT_GT(static_cast<Index>(t.size()) * 16, model->placement().places());  // many: all at once
      const Points together = evaluate(*model, Curve::polyline, t);
      for (std::size_t k = 0; k < t.size(); ++k) {
        ASSERT_LE(16, model->placement().places());  // one: along its path
        const Points alone = evaluate(*model, Curve::polyline, {&t[k], 1});
        ASSERT_EQ(alone.matrix().row(0), together.matrix().row(static_cast<Index>(k)))
            << model->shape() << (closed ? " closed" : " open") << " at " << t[k];
      }
    }
}

TEST(Polyline, HasTheSameBitsForFewAndManyAfterDetailsWereDropped) {  // places read twice disagree then
  Random random(3);
  for (const bool closed : {false, true})
    for (const ModelPtr& whole : models(random, 150, closed)) {
      const ModelPtr model = keep(*whole, random_choice(*whole, random, 0.5));
      const Points together = samples(*model);
      for (Index k = 0; k < 150; k += 7) {
        const double t = model->placement().parameter(k);
        ASSERT_EQ(evaluate(*model, Curve::polyline, {&t, 1}).matrix().row(0), together.matrix().row(k))
            << model->shape();
      }
    }
}

TEST(Polyline, IsStraightBetweenPlaces) {
  Random random(4);
  for (const bool closed : {false, true})
    for (const ModelPtr& model : models(random, 90, closed)) {
      const Points places = points(*model, model->levels());
      const Index g = model->placement().places();
      for (const Index p : {Index{0}, Index{1}, g / 3, g - 2, g - 1}) {
        if (!closed && p == g - 1) continue;
        const double t = (static_cast<double>(p) + 0.25) / static_cast<double>(closed ? g : g - 1);
        const Eigen::RowVectorXd wanted = 0.75 * places.matrix().row(p) + 0.25 * places.matrix().row((p + 1) % g);
        // The parameter is rounded: position known to 2 eps · g, times the step to the next place.
        EXPECT_LE((evaluate(*model, Curve::polyline, {&t, 1}).matrix().row(0) - wanted).norm(),
                  8 * epsilon * (static_cast<double>(g) + 4) * (largest(places) + 1))
            << model->shape();
      }
    }
}

TEST(Polyline, OfAClosedCurveIsPeriodic) {
  Random random(5);
  for (const ModelPtr& model : models(random, 64, true)) {
    const double t[] = {0.25, 1.25, -0.75, 0.0, 1.0, -4.0};
    for (const Curve curve : {Curve::polyline, Curve::limit}) {
      const Points points = evaluate(*model, curve, t);
      EXPECT_EQ(points.matrix().row(0), points.matrix().row(1));
      EXPECT_EQ(points.matrix().row(0), points.matrix().row(2));
      EXPECT_EQ(points.matrix().row(3), points.matrix().row(4));
      EXPECT_EQ(points.matrix().row(3), points.matrix().row(5));
    }
  }
}

TEST(Evaluation, RefusesParametersThatTheCurveDoesNotHave) {
  Random random(6);
  const FilterPtr filter = casteljau(Shape(Topology::joined, 3, 2));
  const ModelPtr open = analyze(filter, random_curve(random, 9, 2, Kind::walk), false);
  const ModelPtr closed = analyze(filter, random_curve(random, 9, 2, Kind::walk), true);
  for (const double bad : {-1e-300, 1 + epsilon, 2.0}) {
    const double t[] = {0, 0.5, bad};
    const Error error = refusal([&] { evaluate(*open, Curve::polyline, t); });
    EXPECT_EQ(error.status(), Status::range);
    EXPECT_EQ(error.argument(), "parameters");
    EXPECT_EQ(error.index(), 2);
    EXPECT_EQ(error.value(), bad);
    EXPECT_NO_THROW(evaluate(*closed, Curve::polyline, t));
  }
  const double nan[] = {0, std::nan("")};
  for (const auto& model : {open, closed}) {
    const Error error = refusal([&] { evaluate(*model, Curve::limit, nan); });
    EXPECT_EQ(error.status(), Status::not_finite);
    EXPECT_EQ(error.index(), 1);
  }
  EXPECT_EQ(evaluate(*open, Curve::polyline, {}).count(), 0);
}

TEST(Limit, OfAFilterThatDoesNotContractIsRefused) {
  const Shape shape(Topology::square, 2, 2);
  RowMatrix t(2, 4);
  t << 1.1, -0.1, 0.75, 0.25, -0.1, 1.1, 0.25, 0.75;
  const auto filter = std::make_shared<Filter>(shape, with_complement(shape, t));
  ASSERT_EQ(filter->contractivity(), Contractivity::refuted);
  Random random(7);
  const ModelPtr model = analyze(filter, random_curve(random, 9, 2, Kind::walk), false);
  const double half[] = {0.5};
  EXPECT_EQ(refusal([&] { evaluate(*model, Curve::limit, half); }).status(), Status::range);
  EXPECT_NO_THROW(evaluate(*model, Curve::polyline, half));
}

TEST(Limit, EndsWhereJoinedPolygonsEnd) {
  Random random(8);
  for (const bool closed : {false, true})
    for (const ModelPtr& model : models(random, 120, closed)) {
      if (!model->shape().joined()) continue;
      const Points places = points(*model, model->levels());
      const Index leaves = model->shape().nodes(model->levels());
      for (Index q = 0; q <= leaves; q += 1 + q / 3) {
        const double t = static_cast<double>(q) / static_cast<double>(leaves);
        const Points found = evaluate(*model, Curve::limit, {&t, 1});
        EXPECT_LE((found.matrix().row(0) - places.matrix().row(q * model->shape().polygon_step())).norm(),
                  1e-14 * (model->parts().diagonal + largest(places)))
            << model->shape() << " joint " << q;
      }
    }
}

// Exactly what "goes on below the finest level with zero details" says: the polygon some levels further down.
TEST(Limit, IsWhatFinerLevelsWithoutDetailsApproach) {
  Random random(9);
  for (const bool closed : {false, true})
    for (const ModelPtr& model : models(random, 40, closed)) {
      ModelParts parts = model->parts();
      const Shape& shape = model->shape();
      for (int more = 0; more < 4; ++more)
        parts.details.push_back(
            std::make_shared<Points>(model->dimension(), shape.detail_count(model->levels() + more)));
      parts.samples = shape.places(model->levels() + 4, closed);
      const Model finer(parts);
      for (int k = 0; k <= 10; ++k) {
        const double t = std::uniform_real_distribution<double>(0, 1)(random);
        EXPECT_LE(distance(evaluate(finer, Curve::limit, {&t, 1}), evaluate(*model, Curve::limit, {&t, 1})),
                  1e-10 * model->parts().diagonal)  // the curve's speed times the parameter's rounding, N^4 times
            << shape << " at " << t;
      }
    }
}

// Deep trees, curves far from the centre, maps with entries that are no doubles: the limit must be found everywhere.
TEST(Limit, IsFoundAtAnyParameterOfDeepModels) {
  Random random(10);
  std::vector<FilterPtr> filters = {
      named_filter("koch", Topology::joined, 0, 0), named_filter("koch", Topology::square, 0, 0),
      named_filter("bspline", Topology::square, 0, 0), named_filter("four-point", Topology::square, 0, 0),
      named_filter("takagi", Topology::joined, 0, 0)};
  for (const int maps : {2, 3, 5, 7}) {
    filters.push_back(named_filter("casteljau", Topology::joined, 5, maps));
    filters.push_back(named_filter("casteljau", Topology::joined, 12, maps));
    filters.push_back(random_filter(Shape(Topology::joined, 4, maps), random, 0.05));
    filters.push_back(random_filter(Shape(Topology::square, 4, maps), random, 0.05));
  }
  for (const FilterPtr& filter : filters)
    for (const Kind kind : {Kind::walk, Kind::smooth, Kind::constant, Kind::repeated}) {
      const ModelPtr model = analyze(filter, random_curve(random, 5000, 2, kind), false);
      std::vector<double> t = {0, 1, 0.5, 1.0 / 3, 0.1, std::nextafter(1.0, 0.0), 1e-300};
      for (int k = 0; k < 100; ++k) t.push_back(std::uniform_real_distribution<double>(0, 1)(random));
      EXPECT_NO_THROW({
        const Points found = evaluate(*model, Curve::limit, t);
        EXPECT_TRUE(found.matrix().allFinite());
      }) << filter->shape()
         << " kind " << static_cast<int>(kind);
    }
}

TEST(PolygonOf, IsThatOfTheLineBitForBit) {
  Random random(11);
  for (const bool closed : {false, true})
    for (const ModelPtr& model : models(random, 80, closed))
      for (int level = 0; level <= model->levels(); ++level) {
        const Points whole = line(*model, level);
        for (Index node = 0; node < model->shape().nodes(level); ++node)
          ASSERT_EQ(polygon_of(*model, level, node).matrix(),
                    whole.polygon(node * model->shape().polygon_step(), model->shape().control_points()))
              << model->shape() << " level " << level << " node " << node;
      }
}

}  // namespace
