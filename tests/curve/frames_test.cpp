#include "curve/frames.h"

#include "linalg/turn.h"

#include "support.h"

using namespace ifsm::core;
using namespace ifsm::core::testing;

namespace {

constexpr Frame frames[] = {Frame::absolute, Frame::node};

ModelPtr random_model(Random& random, int trial, Kind kind = Kind::walk, Index least_points = 2) {
  const auto topology = trial % 2 == 0 ? Topology::joined : Topology::square;
  const Shape shape(topology, static_cast<int>(uniform(random, least_points, 7)),
                    static_cast<int>(uniform(random, 2, 4)));
  return analyze(casteljau(shape), random_curve(random, uniform(random, 2, 150), uniform(random, 1, 4), kind),
                 trial % 3 == 0);
}

void expect_same_bits(const Model& a, const Model& b) {
  EXPECT_EQ(a.parts().polygon, b.parts().polygon) << a.shape();
  for (int l = 0; l < a.levels(); ++l) EXPECT_EQ(a.details(l), b.details(l)) << a.shape() << " level " << l;
  EXPECT_EQ(samples(a), samples(b));
}

struct Similarity {
  double s;
  Matrix q;
  Eigen::RowVectorXd t;
  Points operator()(const Points& points) const {
    return points_from(Matrix((s * points.matrix() * q.transpose()).rowwise() + t));
  }
};

Similarity random_similarity(Random& random, Index d, bool rotation = true) {
  const Matrix q = rotation ? random_rotation(random, d) : Matrix::Identity(d, d);
  return {std::exp(normal(random)), q, Eigen::RowVectorXd::NullaryExpr(d, [&] { return normal(random); })};
}

TEST(ControlPoints, GivenBackAsReadChangeNoBit) {
  Random random(1);
  for (int trial = 0; trial < 200; ++trial)
    for (const Kind kind : {Kind::walk, Kind::offset, Kind::repeated, Kind::collinear, Kind::constant}) {
      const ModelPtr model = random_model(random, trial, kind);
      for (const Frame frame : frames)
        expect_same_bits(*with_control_points(*model, control_points(*model), frame), *model);
    }
}

TEST(Details, GivenBackAsReadChangeNoBitWhenAbsolute) {
  Random random(2);
  for (int trial = 0; trial < 100; ++trial) {
    const ModelPtr model = random_model(random, trial);
    for (int l = 0; l < model->levels(); ++l)
      expect_same_bits(*with_details(*model, l, details(*model, l, Frame::absolute), Frame::absolute), *model);
  }
}

TEST(Details, GivenBackAsReadGiveTheModelBackInNodeFrames) {
  Random random(3);
  for (int trial = 0; trial < 300; ++trial)
    for (const Kind kind : {Kind::walk, Kind::repeated, Kind::collinear, Kind::smooth}) {
      const ModelPtr model = random_model(random, trial, kind);
      for (int l = 0; l < model->levels(); ++l) {
        const ModelPtr back = with_details(*model, l, details(*model, l, Frame::node), Frame::node);
        EXPECT_EQ(back->parts().polygon, model->parts().polygon);
        for (int k = 0; k < model->levels(); ++k)
          EXPECT_LE(distance(back->details(k), model->details(k)), 1e-12 * model->parts().diagonal)
              << model->shape() << " levels " << l << " " << k << " kind " << static_cast<int>(kind);
        EXPECT_LE(distance(samples(*back), samples(*model)), 1e-12 * model->parts().diagonal) << model->shape();
      }
    }
}

TEST(NodeFrames, TellDetailsThatASimilarityDoesNotChange) {
  Random random(4);
  for (int trial = 0; trial < 300; ++trial) {
    const ModelPtr model = random_model(random, trial, Kind::walk, 3);
    // No closed curve of n = 2, n = 1: their root polygons are points, which have no size to measure in.
    const Similarity move = random_similarity(random, model->dimension(), trial % 4 != 1);
    const ModelPtr other = analyze(model->parts().filter, move(samples(*model)), model->closed());
    for (int l = 0; l < model->levels(); ++l) {
      const Points before = details(*model, l, Frame::node), after = details(*other, l, Frame::node);
      // The root's frame is the identity for the polygon that a model has: details of `other` are told in it, turned.
      const Points turned = points_from(before.matrix() * move.q.transpose());
      EXPECT_LE(distance(after, turned), 1e-9 * (1 + largest(before))) << model->shape() << " level " << l;
    }
  }
}

TEST(ControlPoints, MovedByASimilarityMoveTheCurveByIt) {
  Random random(5);
  for (int trial = 0; trial < 300; ++trial)
    for (const Kind kind : {Kind::walk, Kind::smooth, Kind::repeated}) {
      const ModelPtr model = random_model(random, trial, kind, 3);
      const bool ring = model->closed() && model->shape().joined();  // its last control point is its first
      if (model->shape().control_points() - (ring ? 1 : 0) < model->dimension()) continue;  // turn not determined
      const Similarity move = random_similarity(random, model->dimension());
      const ModelPtr moved = with_control_points(*model, move(control_points(*model)), Frame::node);
      const double close = 1e-12 * (move.s * model->parts().diagonal + move.t.norm());
      EXPECT_LE(distance(samples(*moved), move(samples(*model))), close)
          << model->shape() << (model->closed() ? " closed" : " open") << " d=" << model->dimension() << " kind "
          << static_cast<int>(kind);
      for (int l = 0; l < model->levels(); ++l)
        EXPECT_LE(distance(moved->details(l), points_from(move.s * model->details(l).matrix() * move.q.transpose())),
                  10 * close);
    }
}

TEST(ControlPoints, MovedAbsolutelyLeaveEveryDetailBit) {
  Random random(6);
  for (int trial = 0; trial < 50; ++trial) {
    const ModelPtr model = random_model(random, trial);
    Points polygon = control_points(*model);
    for (Index axis = 0; axis < polygon.dimension(); ++axis)
      for (double& value : polygon.plane(axis)) value += 1;
    const ModelPtr moved = with_control_points(*model, polygon, Frame::absolute);
    for (int l = 0; l < model->levels(); ++l) EXPECT_EQ(moved->details(l), model->details(l));
    EXPECT_LE(distance(control_points(*moved), polygon), 4 * epsilon * largest(polygon));
  }
}

TEST(ControlPoints, MovedInNodeFramesTurnEachNodesDetailsAsItsPolygonTurns) {
  Random random(7);
  for (int trial = 0; trial < 100; ++trial) {
    const ModelPtr model = random_model(random, trial, Kind::walk, 3);
    if (model->shape().control_points() <= model->dimension()) continue;  // leaves a turn open: the parent's may do
    Points polygon = control_points(*model);
    const double size = 0.2 * model->parts().diagonal;
    for (Index axis = 0; axis < polygon.dimension(); ++axis) {
      auto plane = polygon.plane(axis);
      for (double& value : plane) value += size * normal(random);
      if (model->closed() && model->shape().joined()) plane.back() = plane.front();
    }
    const ModelPtr moved = with_control_points(*model, polygon, Frame::node);
    for (int l = 0; l < model->levels(); ++l) {
      const Points from = line(*model, l), to = line(*moved, l);
      const Index d = model->shape().details_per_node(), n = model->shape().control_points();
      for (Index node = 0; node < model->shape().nodes(l); ++node) {
        const Index first = node * model->shape().polygon_step();
        const Matrix expected = model->details(l).matrix().middleRows(node * d, d) *
                                turn(from.polygon(first, n), to.polygon(first, n)).transpose();
        const Matrix now = moved->details(l).matrix().middleRows(node * d, d);
        // Polygons that are nearly flat leave a turn open; none here is that flat.
        EXPECT_LE((now - expected).norm(), 1e-7 * (expected.norm() + size)) << model->shape() << " level " << l;
      }
    }
  }
}

// Frames handed down from node to node once turned distant parts of a fitted curve by any angle: a move of 10 km
// became one of 1800.
TEST(ControlPoints, MovedALittleMoveNoPartOfTheCurveFar) {
  Random random(17);
  const FilterPtr coast = named_filter("coast", Topology::joined, 0, 0);
  for (int trial = 0; trial < 20; ++trial) {
    const ModelPtr model = analyze(coast, random_curve(random, 800, 2, Kind::walk), false);
    const double size = 0.01 * model->parts().diagonal;
    Points polygon = control_points(*model);
    polygon.plane(trial % 2)[static_cast<std::size_t>(trial % 5)] += size;
    for (const Frame frame : {Frame::absolute, Frame::node})
      EXPECT_LE(distance(samples(*with_control_points(*model, polygon, frame)), samples(*model)), 8 * size) << trial;
  }
}

TEST(Details, ChangedAtOneLevelInNodeFramesCarryTheFinerOnesAlong) {
  Random random(8);
  for (int trial = 0; trial < 100; ++trial) {
    const ModelPtr model = random_model(random, trial, Kind::walk, 3);
    if (model->levels() < 2) continue;
    Points told = details(*model, 0, Frame::node);
    for (Index axis = 0; axis < told.dimension(); ++axis)
      for (double& value : told.plane(axis)) value += 0.05 * normal(random);
    const ModelPtr changed = with_details(*model, 0, told, Frame::node);
    EXPECT_LE(distance(details(*changed, 0, Frame::node), told), 1e-12 * (1 + largest(told)));
    for (int l = 1; l < model->levels(); ++l) {
      const Points before = details(*model, l, Frame::node);
      EXPECT_LE(distance(details(*changed, l, Frame::node), before), 1e-8 * (1 + largest(before)))
          << model->shape() << " level " << l;
    }
  }
}

TEST(NodeFrames, AreFiniteWherePolygonsArePoints) {
  Random random(9);
  for (int trial = 0; trial < 60; ++trial)
    for (const Kind kind : {Kind::constant, Kind::repeated, Kind::collinear}) {
      const ModelPtr model = random_model(random, trial, kind);
      Points point(model->dimension(), model->shape().control_points());
      for (Index axis = 0; axis < point.dimension(); ++axis)
        for (double& value : point.plane(axis)) value = 0.1;
      const ModelPtr collapsed = with_control_points(*model, point, Frame::node);
      EXPECT_TRUE(samples(*collapsed).matrix().allFinite());
      for (int l = 0; l < model->levels(); ++l) {
        // A polygon of coincident points up to rounding must not blow its details up.
        EXPECT_LE(largest(details(*model, l, Frame::node)), 1e6 * (1 + model->parts().diagonal)) << model->shape();
        EXPECT_TRUE(details(*collapsed, l, Frame::node).matrix().allFinite());
      }
    }
}

TEST(Edits, AreRefusedWhenTheyDoNotFit) {
  Random random(10);
  const ModelPtr model =
      analyze(casteljau(Shape(Topology::joined, 4, 2)), random_curve(random, 40, 2, Kind::walk), false);
  Error error = refusal([&] { with_control_points(*model, Points(2, 3), Frame::node); });
  EXPECT_EQ(error.status(), Status::shape);
  EXPECT_EQ(error.argument(), "points");
  EXPECT_EQ(error.required(), 8);
  EXPECT_EQ(refusal([&] { with_control_points(*model, Points(3, 4), Frame::node); }).status(), Status::shape);
  Points bad(2, 4);
  bad.plane(1)[2] = std::nan("");
  error = refusal([&] { with_control_points(*model, bad, Frame::absolute); });
  EXPECT_EQ(error.status(), Status::not_finite);
  EXPECT_EQ(refusal([&] { with_details(*model, 4, Points(2, 24), Frame::absolute); }).argument(), "level");
  EXPECT_EQ(refusal([&] { with_details(*model, -1, Points(2, 24), Frame::absolute); }).argument(), "level");
  error = refusal([&] { with_details(*model, 1, Points(2, 5), Frame::absolute); });
  EXPECT_EQ(error.argument(), "vectors");
  EXPECT_EQ(error.required(), 12);
  const ModelPtr ring =
      analyze(casteljau(Shape(Topology::joined, 4, 2)), random_curve(random, 40, 2, Kind::walk), true);
  Points open = control_points(*ring);
  open.plane(0)[3] += 1;
  for (const Frame frame : frames)
    EXPECT_EQ(refusal([&] { with_control_points(*ring, open, frame); }).status(), Status::shape);
}

}  // namespace
