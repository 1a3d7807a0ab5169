#include "curve/model.h"

#include <gtest/gtest.h>
// The order matters: after gtest.
#include <rapidcheck/gtest.h>

#include "support.h"

using namespace ifsm::core;
using namespace ifsm::core::testing;

namespace {

// How far reconstruction may be off beyond 1e-12 of the diagonal: what rounding the largest polygon does, times 16 for
// sums of rows() products of such in several levels (measured over all shapes: up to 3).
double honest(const Model& model) { return 16 * epsilon * model.parts().largest_polygon; }

// And what samples() rounds when it adds the centre.
double of_center(const Points& samples) { return epsilon * largest(samples); }

double lost(const Model& model, const Points& given) { return distance(samples(model), given); }

std::string name(const Model& m, const Points& given) {
  std::ostringstream out;
  out << m.shape() << (m.closed() ? " closed" : " open") << " levels=" << m.levels() << " samples=" << given.count()
      << " diagonal=" << m.parts().diagonal << " largest=" << m.parts().largest_polygon
      << " condition=" << m.filter().condition();
  return out.str();
}

TEST(Analysis, OfEveryShapeGivesTheSamplesBack) {
  Random random(1);
  for (const Shape& shape : all_shapes()) {
    const FilterPtr filter = casteljau(shape);
    for (const bool closed : {false, true})
      for (const Kind kind : all_kinds) {
        const Points given = random_curve(random, uniform(random, 2, 300), uniform(random, 1, 4), kind);
        const ModelPtr model = analyze(filter, given, closed);
        const double close = 1e-12 * diagonal(given);
        ASSERT_LE(lost(*model, given), shape.control_points() <= 12 ? close : std::max(close, honest(*model)))
            << name(*model, given) << " kind " << static_cast<int>(kind);
        if (kind == Kind::offset) {  // differences from the centre are exact, and so is their sum
          ASSERT_EQ(lost(*model, given), 0.0) << name(*model, given);
        }
      }
  }
}

struct Case {
  Topology topology;
  int n, maps, stride;
  bool closed;
  Index count, dimension;
  Kind kind;
  int more_levels;
  unsigned seed;
};

std::ostream& operator<<(std::ostream& out, const Case& c) {
  return out << (c.topology == Topology::joined ? "joined" : "square") << " n=" << c.n << " N=" << c.maps
             << " stride=" << c.stride << (c.closed ? " closed" : " open") << " samples=" << c.count
             << " d=" << c.dimension << " kind=" << static_cast<int>(c.kind) << " more levels=" << c.more_levels
             << " seed=" << c.seed;
}

rc::Gen<Case> any_case() {
  return rc::gen::exec([] {
    Case c;
    c.topology = *rc::gen::element(Topology::joined, Topology::square);
    c.n = *rc::gen::inRange(c.topology == Topology::joined ? 2 : 1, 17);
    c.maps = *rc::gen::inRange(2, 9);
    c.stride = c.topology == Topology::joined ? 0 : *rc::gen::inRange(0, c.n + 1);
    c.closed = *rc::gen::arbitrary<bool>();
    c.count = *rc::gen::inRange<Index>(2, 301);
    c.dimension = *rc::gen::inRange<Index>(1, 5);
    c.kind = *rc::gen::elementOf(std::vector<Kind>(std::begin(all_kinds), std::end(all_kinds)));
    c.more_levels = *rc::gen::inRange(0, 2);
    c.seed = *rc::gen::arbitrary<unsigned>();
    return c;
  });
}

RC_GTEST_PROP(AnalysisProperty, GivesTheSamplesBackUnderDeCasteljau, ()) {
  const Case c = *any_case();
  RC_LOG() << c;
  Random random(c.seed);
  const Shape shape(c.topology, c.n, c.maps, c.stride);
  const Points given = random_curve(random, c.count, c.dimension, c.kind);
  const int levels = shape.levels_for(c.count, c.closed) + c.more_levels;
  const ModelPtr model = analyze(casteljau(shape), given, c.closed, levels);
  const double close = 1e-12 * diagonal(given) + of_center(given);
  RC_LOG() << " lost " << lost(*model, given) / diagonal(given) << " " << name(*model, given);
  RC_ASSERT(lost(*model, given) <= (c.n <= 12 ? close : std::max(close, honest(*model))));
}

RC_GTEST_PROP(AnalysisProperty, GivesTheSamplesBackUnderRandomFilters, ()) {
  const Case c = *any_case();
  RC_LOG() << c;
  Random random(c.seed);
  const Shape shape(c.topology, c.n, c.maps, c.stride);
  FilterPtr filter;
  try {
    filter = random_filter(shape, random, 0.05);
  } catch (const Error&) {
    RC_DISCARD("singular");
  }
  const Points given = random_curve(random, c.count, c.dimension, c.kind);
  const ModelPtr model = analyze(filter, given, c.closed);
  const double bound = std::max(1e-12 * diagonal(given) + of_center(given), honest(*model));
  RC_LOG() << " lost " << lost(*model, given) / diagonal(given) << " " << name(*model, given);
  RC_ASSERT(lost(*model, given) <= bound);
}

TEST(Analysis, GivesLargeCurvesBack) {
  Random random(2);
  for (const auto& [topology, n, maps, count] : {std::tuple{Topology::joined, 5, 2, Index{100000}},
                                                 {Topology::square, 5, 2, 100000},
                                                 {Topology::joined, 4, 3, 65537},
                                                 {Topology::joined, 12, 2, 50000},
                                                 {Topology::square, 1, 2, 65536},
                                                 {Topology::joined, 16, 8, 30000}})
    for (const bool closed : {false, true}) {
      const Points given = random_curve(random, count, 2, Kind::walk);
      const ModelPtr model = analyze(casteljau(Shape(topology, n, maps)), given, closed);
      EXPECT_LE(lost(*model, given), std::max(1e-12 * diagonal(given), n > 12 ? honest(*model) : 0.0))
          << name(*model, given);
    }
}

TEST(Analysis, OfTwoSamplesAndOfEveryFewIsExact) {
  Random random(3);
  for (const Shape& shape : all_shapes(12))
    for (const bool closed : {false, true})
      for (const Index count : {2, 3}) {
        const Points given = random_curve(random, count, 2, Kind::noise);
        const ModelPtr model = analyze(casteljau(shape), given, closed);
        ASSERT_LE(lost(*model, given), 1e-12 * diagonal(given)) << name(*model, given);
      }
}

TEST(Analysis, OfEqualSamplesHasNoDetails) {
  for (const Shape& shape : all_shapes())
    for (const bool closed : {false, true}) {
      Points given(3, 50);
      for (Index axis = 0; axis < 3; ++axis)
        for (double& value : given.plane(axis)) value = 1e8 + 0.1 * static_cast<double>(axis);
      const ModelPtr model = analyze(casteljau(shape), given, closed);
      EXPECT_EQ(model->details_kept(), 0) << shape;
      EXPECT_EQ(samples(*model), given) << shape;
      EXPECT_GT(model->details_total(), 0);
    }
}

TEST(Analysis, RefusesWhatItCannotTake) {
  Random random(4);
  const FilterPtr filter = casteljau(Shape(Topology::joined, 5, 2));
  Error error = refusal([&] { analyze(filter, Points(2, 1), false); });
  EXPECT_EQ(error.status(), Status::range);
  EXPECT_EQ(error.argument(), "count");
  EXPECT_EQ(error.required(), 2);
  error = refusal([&] { analyze(filter, Points(5, 9), false); });
  EXPECT_EQ(error.argument(), "dimension");
  error = refusal([&] { analyze(filter, random_curve(random, 100, 2, Kind::walk), false, 4); });
  EXPECT_EQ(error.status(), Status::range);
  EXPECT_EQ(error.argument(), "levels");
  EXPECT_EQ(error.required(), 5);
  error = refusal([&] { analyze(filter, random_curve(random, 100, 2, Kind::walk), false, -1); });
  EXPECT_EQ(error.argument(), "levels");
  Points wide(1, 5);
  wide.plane(0)[0] = -1.7e308;
  wide.plane(0)[4] = 1.7e308;
  EXPECT_EQ(refusal([&] { analyze(filter, wide, false); }).status(), Status::numerical);
}

TEST(Polygon, MakesAModelWithoutDetailsWhoseSamplesAreItsPlaces) {
  Random random(5);
  for (const Shape& shape : all_shapes(6, 3))
    for (int levels = 0; levels <= 3; ++levels)
      for (const bool closed : {false, true}) {
        Points polygon = random_curve(random, shape.control_points(), 2, Kind::noise);
        if (closed && shape.joined()) polygon.matrix().bottomRows(1) = polygon.matrix().row(0).eval();
        const ModelPtr model = from_polygon(casteljau(shape), polygon, closed, levels);
        EXPECT_EQ(model->details_kept(), 0);
        EXPECT_EQ(model->levels(), levels);
        EXPECT_EQ(samples(*model).count(), shape.places(levels, closed));
        EXPECT_LE(distance(control_points(*model), polygon), 4 * epsilon * largest(polygon));
      }
}

TEST(Polygon, IsRefusedWhenItDoesNotFit) {
  const FilterPtr filter = casteljau(Shape(Topology::joined, 3, 2));
  Error error = refusal([&] { from_polygon(filter, Points(2, 4), false, 1); });
  EXPECT_EQ(error.status(), Status::shape);
  EXPECT_EQ(error.required(), 3);
  Points open(2, 3);
  open.plane(0)[2] = 1;
  EXPECT_EQ(refusal([&] { from_polygon(filter, open, true, 1); }).status(), Status::shape);
  EXPECT_EQ(refusal([&] { from_polygon(filter, open, false, -1); }).argument(), "levels");
  EXPECT_EQ(refusal([&] { from_polygon(filter, open, false, 60); }).argument(), "levels");
  open.plane(0)[1] = -1.7e308;
  open.plane(0)[2] = 1.7e308;
  EXPECT_EQ(refusal([&] { from_polygon(filter, open, false, 1); }).status(), Status::numerical);
}

TEST(Places, AreLaidAndReadBack) {
  Random random(6);
  for (const Topology topology : {Topology::joined, Topology::square})
    for (int n = topology == Topology::joined ? 2 : 1; n <= 6; ++n)
      for (int stride = topology == Topology::joined ? 0 : 1; stride <= (topology == Topology::joined ? 0 : n);
           ++stride)
        for (int level = 0; level <= 3; ++level)
          for (const bool closed : {false, true}) {
            const Shape shape(topology, n, 2, stride);
            const Points places = random_curve(random, shape.places(level, closed), 2, Kind::noise);
            const Points line = read(shape, closed, places, level);
            ASSERT_EQ(line.count(), shape.line_length(level)) << shape;
            Points laid = lay(shape, closed, line, level);
            if (shape.joined() && closed) {  // the first point again
              EXPECT_EQ(laid.count(), places.count() + 1);
              EXPECT_EQ(laid.matrix().row(places.count()), laid.matrix().row(0));
              EXPECT_EQ(laid.matrix().topRows(places.count()), places.matrix()) << shape;
            } else {
              EXPECT_EQ(laid, places) << shape << " level " << level;
            }
          }
}

// Changes that a model's details must survive: cut to a budget, rounded to a grid, replaced.
ModelPtr damaged(const Model& model, Random& random) {
  ModelParts parts = model.parts();
  const Kept kept = random_choice(model, random, 0.5);
  const auto what = uniform(random, 0, 2);
  std::size_t flag = 0;
  for (auto& level : parts.details) {
    auto changed = std::make_shared<Points>(*level);
    for (Index i = 0; i < changed->count(); ++i, ++flag)
      for (Index axis = 0; axis < changed->dimension(); ++axis) {
        double& value = changed->plane(axis)[static_cast<std::size_t>(i)];
        if (what == 0 && !kept[flag]) value = 0;
        if (what == 1) value = std::round(value * 8) / 8;
        if (what == 2) value = 100 * normal(random);
      }
    level = std::move(changed);
  }
  return std::make_shared<Model>(std::move(parts));
}

TEST(JoinedModel, StaysInOnePieceWhateverBecomesOfItsDetails) {
  Random random(7);
  for (int trial = 0; trial < 300; ++trial) {
    const Shape shape(Topology::joined, static_cast<int>(uniform(random, 2, 9)),
                      static_cast<int>(uniform(random, 2, 5)));
    const bool closed = trial % 2 == 1;
    const FilterPtr filter = trial % 3 == 0 ? casteljau(shape) : random_filter(shape, random, 0.03);
    const ModelPtr model = analyze(filter, random_curve(random, uniform(random, 2, 200), 2, Kind::walk), closed);
    const ModelPtr changed = damaged(*model, random);
    for (int level = 0; level <= changed->levels(); ++level) {
      const Points curve = line(*changed, level);
      for (Index node = 0; node < shape.nodes(level); ++node) {
        const Points polygon = polygon_of(*changed, level, node);
        const Index first = node * shape.polygon_step(), n = shape.control_points();
        ASSERT_EQ(polygon.matrix(), curve.polygon(first, n)) << shape << " level " << level << " node " << node;
        if (node + 1 < shape.nodes(level)) {
          const Points next = polygon_of(*changed, level, node + 1);
          ASSERT_EQ(polygon.matrix().row(n - 1), next.matrix().row(0)) << shape;
        }
      }
      if (level > 0) {  // joints of the coarser level stay
        const Points coarser = line(*changed, level - 1);
        for (Index node = 0; node <= shape.nodes(level - 1); ++node)
          ASSERT_EQ(curve.matrix().row(node * shape.children_step()),
                    coarser.matrix().row(node * shape.polygon_step()));
      }
      if (closed) {
        ASSERT_EQ(curve.matrix().row(0), curve.matrix().bottomRows(1)) << shape;
      }
    }
  }
}

TEST(Model, UnderASimilarityIsThatSimilarityOfItsPolygonsAndDetails) {
  Random random(8);
  for (int trial = 0; trial < 200; ++trial) {
    const auto topology = trial % 2 == 0 ? Topology::joined : Topology::square;
    const Shape shape(topology, static_cast<int>(uniform(random, 2, 8)), static_cast<int>(uniform(random, 2, 4)));
    const Index d = uniform(random, 1, 4);
    const FilterPtr filter = casteljau(shape);
    const Points given = random_curve(random, uniform(random, 2, 200), d, Kind::walk);
    Matrix q = random_rotation(random, d);
    if (trial % 4 == 0) q.col(0) *= -1;
    const double s = std::exp(normal(random));
    const Eigen::RowVectorXd t = Eigen::RowVectorXd::NullaryExpr(d, [&] { return 10 * normal(random); });
    const auto moved = [&](const Matrix& m) { return Matrix((s * m * q.transpose()).rowwise() + t); };
    const bool closed = trial % 3 == 0;
    const ModelPtr model = analyze(filter, given, closed),
                   other = analyze(filter, points_from(moved(given.matrix())), closed);
    const double close = 1e-12 * (s * diagonal(given) + t.norm());  // the shift's own rounding included
    EXPECT_LE((control_points(*other).matrix() - moved(control_points(*model).matrix())).cwiseAbs().maxCoeff(), close);
    for (int level = 0; level < model->levels(); ++level)
      EXPECT_LE(
          (other->details(level).matrix() - s * model->details(level).matrix() * q.transpose()).cwiseAbs().maxCoeff(),
          close);
  }
}

TEST(Model, TakesAnotherFilterOfItsShapeOnly) {
  Random random(9);
  const Shape shape(Topology::joined, 4, 2);
  const ModelPtr model = analyze(casteljau(shape), random_curve(random, 40, 2, Kind::walk), false);
  const FilterPtr other = random_filter(shape, random);
  const ModelPtr changed = with_filter(*model, other);
  EXPECT_EQ(&changed->filter(), other.get());
  EXPECT_EQ(changed->parts().polygon, model->parts().polygon);
  for (int l = 0; l < model->levels(); ++l) EXPECT_EQ(changed->details(l), model->details(l));
  EXPECT_EQ(samples(*with_filter(*changed, model->parts().filter)), samples(*model));
  const Error error = refusal([&] { with_filter(*model, casteljau(Shape(Topology::square, 4, 2))); });
  EXPECT_EQ(error.status(), Status::shape);
  EXPECT_EQ(error.argument(), "filter");
}

TEST(Model, CountsTheDetailsThatAreNotZero) {
  Random random(10);
  const ModelPtr model =
      analyze(casteljau(Shape(Topology::joined, 4, 2)), random_curve(random, 97, 2, Kind::noise), false);
  EXPECT_EQ(model->details_total(), 93);
  EXPECT_EQ(model->details_kept(), 93);
  EXPECT_EQ(keep(*model, most_significant(*model, 10))->details_kept(), 10);
}

}  // namespace
