#include "curve/resolve.h"

#include <algorithm>

#include "support.h"

using namespace ifsm::core;
using namespace ifsm::core::testing;

namespace {

// What counts of the distance at a place: half of it between samples.
Eigen::VectorXd counted(const Model& model) {
  const Placement& placement = model.placement();
  Eigen::VectorXd counted = Eigen::VectorXd::Constant(placement.places(), 0.5);
  for (Index k = 0; k < placement.samples(); ++k) counted(placement.place(k)) = 1;
  return counted;
}

// That of a curve's places, from its centre.
Matrix told(const Model& model, const ModelParts& parts) {
  const Points places = lay(model.shape(), model.closed(), line(parts, model.levels()), model.levels());
  return counted(model).asDiagonal() * places.matrix().topRows(model.placement().places());
}

Matrix wanted(const Model& model, const Points& given) {
  return counted(model).asDiagonal() * model.placement().fill(to_center(given, model.parts().center)).matrix();
}

double error(const Model& sketch, const Points& given) {
  return (told(sketch, sketch.parts()) - wanted(sketch, given)).squaredNorm();
}

// The linear map of one coordinate from control points (closed and joined: the last is the first) and kept details to
// what counts, column by column through the plain synthesis.
Matrix dense(const Model& model, const Kept& kept) {
  const Shape& shape = model.shape();
  const bool ring = model.closed() && shape.joined();
  const Index n = shape.control_points() - (ring ? 1 : 0);
  ModelParts zero = model.parts();
  zero.polygon = Points(1, shape.control_points());
  for (auto& level : zero.details) level = std::make_shared<Points>(1, level->count());
  const auto column = [&](const ModelParts& parts) -> Eigen::VectorXd { return told(model, parts); };
  Matrix a(model.placement().places(), n + std::ranges::count(kept, char{1}));
  Index next = 0;
  for (Index i = 0; i < n; ++i) {
    ModelParts parts = zero;
    parts.polygon.plane(0)[static_cast<std::size_t>(i)] = 1;
    if (ring && i == 0) parts.polygon.plane(0).back() = 1;
    a.col(next++) = column(parts);
  }
  Index flag = 0;
  for (int l = 0; l < model.levels(); ++l)
    for (Index i = 0; i < model.details(l).count(); ++i, ++flag) {
      if (!kept[static_cast<std::size_t>(flag)]) continue;
      ModelParts parts = zero;
      auto level = std::make_shared<Points>(1, model.details(l).count());
      level->plane(0)[static_cast<std::size_t>(i)] = 1;
      parts.details[static_cast<std::size_t>(l)] = level;
      a.col(next++) = column(parts);
    }
  return a;
}

double dense_error(const Model& model, const Points& given, const Kept& kept) {
  const Matrix a = dense(model, kept), b = wanted(model, given);
  return (a * least_squares(a, b) - b).squaredNorm();
}

struct Subject {
  FilterPtr filter;
  Index samples;
  bool closed;
};

std::vector<Subject> subjects(Random& random) {
  std::vector<Subject> all;
  for (const bool closed : {false, true})
    for (const Index count : {2, 9, 33, 50, 64, 65})
      for (const auto& [topology, n, maps, stride] : {std::tuple{Topology::joined, 2, 2, 0},
                                                      {Topology::joined, 3, 3, 0},
                                                      {Topology::joined, 5, 2, 0},
                                                      {Topology::square, 1, 2, 0},
                                                      {Topology::square, 3, 2, 2},
                                                      {Topology::square, 4, 2, 1},
                                                      {Topology::square, 4, 3, 4}}) {
        const Shape shape(topology, n, maps, stride);
        all.push_back({casteljau(shape), count, closed});
        if (n > 1) all.push_back({random_filter(shape, random, 0.05), count, closed});
      }
  return all;
}

std::string name(const Model& m, Index kept) {
  std::ostringstream out;
  out << m.shape() << (m.closed() ? " closed" : " open") << " samples=" << m.placement().samples()
      << " places=" << m.placement().places() << " kept=" << kept << " of " << m.details_total();
  return out.str();
}

TEST(Resolve, IsTheDenseLeastSquares) {
  Random random(1);
  for (const Subject& subject : subjects(random))
    for (const double share : {0.0, 0.2, 0.6, 0.9}) {
      const Points given = random_curve(random, subject.samples, 2, Kind::walk);
      const ModelPtr model = analyze(subject.filter, given, subject.closed);
      const Kept kept = random_choice(*model, random, share);
      const double least = dense_error(*model, given, kept);
      const double found = error(*resolve(*model, kept, {}), given);
      const double whole = diagonal(given) * diagonal(given);
      // 1e-10 of the error, or what 1e-11 of the diagonal a sample comes to when nothing is left. Square polygons that
      // overlap have singular values down to 1e-7 of the largest, which conjugate gradients do not reach.
      const double close = subject.filter->shape().joined() ? 1e-10 : 1e-5;
      EXPECT_LE(found, least * (1 + close) + 1e-22 * whole) << name(*model, std::ranges::count(kept, char{1}));
      EXPECT_GE(found, least * (1 - 1e-10) - 1e-22 * whole) << name(*model, std::ranges::count(kept, char{1}));
    }
}

TEST(Resolve, LeavesWhatTheSamplesDoNotTellAsItWas) {  // details that no sample sees must not carry rounding's whims
  Random random(9);
  for (const Subject& subject : subjects(random)) {
    const ModelPtr model =
        analyze(subject.filter, random_curve(random, subject.samples, 2, Kind::walk), subject.closed);
    if (!model->shape().joined()) continue;  // overlapping polygons tell many curves by large details that cancel
    for (const double share : {0.2, 0.6, 1.0}) {
      const ModelPtr solved = resolve(*model, random_choice(*model, random, share), {});
      for (int l = 0; l < model->levels(); ++l)
        EXPECT_LE(largest(solved->details(l)), 1e4 * model->parts().diagonal) << name(*model, -1) << " level " << l;
    }
  }
}

TEST(Resolve, LetsNoPlaceFlyOffBetweenTheSamples) {
  Random random(10);
  for (const Subject& subject : subjects(random)) {
    if (subject.samples < 9) continue;
    const Points given = random_curve(random, subject.samples, 2, Kind::walk);
    const ModelPtr model = analyze(subject.filter, given, subject.closed);
    for (const double share : {0.5, 0.8, 0.95}) {
      const Kept kept = random_choice(*model, random, share);
      // The least error is at most that of what is kept as it is, and no place alone can be more than all of it.
      const double most = error(*keep(*model, kept), given);
      const ModelPtr solved = resolve(*model, kept, {});
      const Points there = lay(model->shape(), model->closed(), line(*solved, model->levels()), model->levels());
      const Points straight = model->placement().fill(to_center(given, model->parts().center));
      const double farthest =
          (there.matrix().topRows(straight.count()) - straight.matrix()).rowwise().norm().maxCoeff();
      EXPECT_LE(farthest, 2 * std::sqrt(most) * (1 + 1e-9) + 1e-11 * diagonal(given))
          << name(*model, std::ranges::count(kept, char{1}));
    }
  }
}

TEST(Resolve, LeavesDroppedDetailsZero) {
  Random random(2);
  for (const Subject& subject : subjects(random)) {
    const ModelPtr model =
        analyze(subject.filter, random_curve(random, subject.samples, 2, Kind::walk), subject.closed);
    const Kept kept = random_choice(*model, random, 0.3);
    const ModelPtr solved = resolve(*model, kept, {});
    std::size_t flag = 0;
    for (int l = 0; l < model->levels(); ++l)
      for (Index i = 0; i < model->details(l).count(); ++i, ++flag)
        if (!kept[flag]) {
          ASSERT_EQ(solved->details(l).matrix().row(i).norm(), 0.0) << model->shape();
        }
    if (model->closed() && model->shape().joined()) {
      EXPECT_EQ(solved->parts().polygon.matrix().row(0), solved->parts().polygon.matrix().bottomRows(1))
          << model->shape();
    }
  }
}

TEST(Resolve, OfEverythingReturnsTheSamples) {
  Random random(3);
  for (const Subject& subject : subjects(random))
    for (const Kind kind : {Kind::walk, Kind::offset, Kind::constant}) {
      const Points given = random_curve(random, subject.samples, 2, kind);
      const ModelPtr model = analyze(subject.filter, given, subject.closed);
      const Kept all(static_cast<std::size_t>(model->details_total()), char{1});
      EXPECT_LE(distance(samples(*resolve(*model, all, {})), given), 1e-12 * diagonal(given)) << name(*model, -1);
    }
}

TEST(Resolve, IsNeverWorseThanWhatItStartsFrom) {
  Random random(4);
  for (const Subject& subject : subjects(random))
    for (const Kind kind : {Kind::walk, Kind::smooth, Kind::repeated, Kind::collinear, Kind::tiny, Kind::huge}) {
      const Points given = random_curve(random, subject.samples, 3, kind);
      const ModelPtr model = analyze(subject.filter, given, subject.closed);
      const Kept kept = most_significant(*model, model->details_total() / 4);
      const double unit = diagonal(given) > 0 ? diagonal(given) : 1.0;
      const auto relative = [&](const Model& m) { return ((told(m, m.parts()) - wanted(m, given)) / unit).norm(); };
      EXPECT_LE(relative(*resolve(*model, kept, {})), relative(*keep(*model, kept)) * (1 + 1e-12) + 1e-12)
          << name(*model, model->details_total() / 4) << " kind " << static_cast<int>(kind);
    }
}

TEST(Resolve, FollowsAShiftOfTheCurve) {
  Random random(5);
  for (const Subject& subject : subjects(random)) {
    const Points given = random_curve(random, subject.samples, 2, Kind::walk);
    Points far = given;
    far.matrix() = (given.matrix() * 1e-3).array() + 1e6;
    const Points near = points_from((far.matrix().array() - 1e6).matrix());  // what is left of it, exactly
    const ModelPtr a = analyze(subject.filter, near, subject.closed), b = analyze(subject.filter, far, subject.closed);
    const Kept kept = random_choice(*a, random, 0.3);
    const ModelPtr c = resolve(*a, kept, {}), d = resolve(*b, kept, {});
    // From their centres, where nothing was rounded.
    const auto at_samples = [](const Model& m, double shift) {
      const Points from_its_center = m.placement().pick(lay(m.shape(), m.closed(), line(m, m.levels()), m.levels()));
      std::vector<double> center = m.parts().center;
      for (double& value : center) value -= shift;
      return from_center(from_its_center, center);
    };
    // Conjugate gradients see less of small values: those of square polygons that overlap go down to 1e-7 of the
    // largest.
    const double close = subject.filter->shape().joined() ? 1e-10 : 1e-6;
    EXPECT_LE(distance(at_samples(*c, 0), at_samples(*d, 1e6)), close * diagonal(near)) << name(*a, -1);
  }
}

TEST(ResolveChoice, IsNeverWorseThanTheMostSignificantResolved) {
  Random random(6);
  for (const Subject& subject : subjects(random)) {
    const Points given = random_curve(random, subject.samples, 2, Kind::walk);
    const ModelPtr model = analyze(subject.filter, given, subject.closed);
    for (const Index divisor : {2, 4, 10}) {
      const Index count = model->details_total() / divisor;
      const Kept kept = most_significant(*model, count);
      const ModelPtr better = resolve_choice(*model, kept, {}), plain = resolve(*model, kept, {});
      EXPECT_LE(error(*better, given), error(*plain, given) * (1 + 1e-9) + 1e-22 * given.matrix().squaredNorm())
          << name(*model, count);
      EXPECT_LE(better->details_kept(), count);
    }
  }
}

TEST(ResolveChoice, IsBetterOnSomeCurves) {
  Random random(7);
  double plain = 0, better = 0;
  for (int trial = 0; trial < 10; ++trial) {
    const Points given = random_curve(random, 257, 2, Kind::walk);
    const ModelPtr model = analyze(casteljau(Shape(Topology::joined, 5, 2)), given, false);
    const Kept kept = most_significant(*model, 40);
    plain += std::log(error(*resolve(*model, kept, {}), given));
    better += std::log(error(*resolve_choice(*model, kept, {}), given));
  }
  EXPECT_LT(better, plain - 10 * 0.05);  // 5 % less squared error on average, or the pursuit does nothing
}

TEST(Resolve, IsCancelled) {
  Random random(8);
  CancelToken token;
  token.request();
  const Watch watch(&token, {});
  for (const auto topology : {Topology::joined, Topology::square}) {
    const ModelPtr model = analyze(casteljau(Shape(topology, 4, 2)), random_curve(random, 100, 2, Kind::walk), false);
    EXPECT_THROW(resolve(*model, most_significant(*model, 10), watch), Cancelled);
    EXPECT_THROW(resolve_choice(*model, most_significant(*model, 10), watch), Cancelled);
  }
}

TEST(Resolve, OfAModelWithoutLevelsOrWithoutSpreadIsThatModel) {
  const FilterPtr filter = casteljau(Shape(Topology::joined, 2, 2));
  Points two(2, 2);
  two.plane(0)[1] = 1;
  const ModelPtr flat = analyze(filter, two, false);
  EXPECT_LE(distance(samples(*resolve(*flat, {}, {})), two), 4 * epsilon);
  EXPECT_LE(distance(samples(*resolve_choice(*flat, {}, {})), two), 4 * epsilon);
}

}  // namespace
