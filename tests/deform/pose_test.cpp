#include "deform/pose.h"

#include <algorithm>
#include <set>

#include "deform/handles.h"
#include "linalg/spectrum.h"
#include "support.h"

using namespace ifsm::core;
using namespace ifsm::core::testing;

namespace {

constexpr Turning all_turnings[] = {Turning::similarity, Turning::rotation, Turning::linear};

Pose still(const Model& model) {
  return {model.parts().polygon, std::vector<Moves>(static_cast<std::size_t>(model.levels()) + 1)};
}

Vector random_vector(Random& random, Index dimension, double size = 1) {
  return Vector::NullaryExpr(dimension, [&] { return size * normal(random); });
}

// Control points moved, both ends of a ring alike.
void move_root(Pose& pose, const Model& model, Random& random) {
  auto m = pose.polygon.matrix();
  for (Index i = 0; i < m.rows(); ++i) m.row(i) += random_vector(random, m.cols(), 3).transpose();
  if (model.closed() && model.shape().joined()) m.bottomRows(1) = m.row(0);
}

Points whole(const Posed& posed, const Model& model, int level) {
  return posed.places(level, 0, model.shape().places(level, model.closed()));
}

Points laid(const Model& model, int level) {
  Points places = lay(model.shape(), model.closed(), line(model, level), level);
  Points cut(places.dimension(), model.shape().places(level, model.closed()));
  cut.matrix() = places.matrix().topRows(cut.count());
  return cut;
}

// What a pose with moves at one level comes to, told by the definition: (P'_0 | … | P'_N-1) = (P' | L δ) R, node by
// node, the nodes of `level` that hold a moved handle turning by their own polygon.
class Definition {
 public:
  Definition(const Model& model, const Pose& pose, int level, Turning turning)
      : model_(model), pose_(pose), level_(level), turning_(turning), line_(model.dimension(), 0) {
    line_ = Points(model.dimension(), model.shape().line_length(model.levels()));
    const Matrix base = model.parts().polygon.matrix(), polygon = pose.polygon.matrix();
    root_ = turn(base, polygon, turning);
    go(0, 0, base, polygon, root_);
  }
  Points places() const {
    const Points all = lay(model_.shape(), model_.closed(), line_, model_.levels());
    Points cut(all.dimension(), model_.shape().places(model_.levels(), model_.closed()));
    cut.matrix() = all.matrix().topRows(cut.count());
    return cut;
  }

 private:
  void go(int level, Index node, const Matrix& base, Matrix polygon, SmallMatrix turned) {
    const Shape& shape = model_.shape();
    const int n = shape.control_points(), d = shape.details_per_node();
    if (level == level_ && level > 0) {
      const Handles handles(shape, model_.closed(), level);
      bool moved = false;
      for (int c = 0; c < n; ++c)
        if (const auto at = pose_.moves[static_cast<std::size_t>(level)].own.find(handles.handle({node, c}));
            at != pose_.moves[static_cast<std::size_t>(level)].own.end()) {
          polygon.row(c) += (root_ * at->second).transpose();
          moved = true;
        }
      if (moved) turned = turn(base, polygon, turning_);
    }
    if (level == model_.levels()) {
      line_.matrix().middleRows(node * shape.polygon_step(), n) = polygon;
      return;
    }
    const Matrix own = model_.details(level).matrix().middleRows(node * d, d);
    const Matrix top = model_.filter().matrix().topRows(n), bottom = model_.filter().matrix().bottomRows(d);
    const Matrix base_below = top.transpose() * base + bottom.transpose() * own;
    const Matrix below = top.transpose() * polygon + bottom.transpose() * (own * turned.transpose());
    for (int i = 0; i < shape.maps(); ++i)
      go(level + 1, node * shape.maps() + i, base_below.middleRows(i * shape.polygon_step(), n),
         below.middleRows(i * shape.polygon_step(), n), turned);
  }

  const Model& model_;
  const Pose& pose_;
  int level_;
  Turning turning_;
  SmallMatrix root_;
  Points line_;
};

TEST(Posed, IsTheBaseToTheBitWhereNothingMoved) {
  Random random(1);
  for (const Subject& s : subjects(random)) {
    const ModelPtr model = rough(s, random);
    const Base base(model);
    const Pose pose = still(*model);
    for (const Follow follow : {Follow::moved, Follow::each, Follow::none}) {
      const Posed posed(base, pose, {Turning::similarity, follow});
      for (int level = 0; level <= model->levels(); ++level)
        EXPECT_EQ(whole(posed, *model, level), laid(*model, level)) << name(*model) << " level " << level;
    }
  }
}

TEST(Posed, IsWhatTheDefinitionSays) {
  Random random(2);
  for (const Subject& s : subjects(random))
    for (const Turning turning : all_turnings)
      for (const int level : {0, 1, 2}) {
        const ModelPtr model = rough(s, random);
        const Base base(model);
        Pose pose = still(*model);
        move_root(pose, *model, random);
        const Index handles = model->shape().places(level, model->closed());
        for (int k = 0; level > 0 && k < 3; ++k)
          pose.moves[static_cast<std::size_t>(level)].own[uniform(random, 0, handles - 1)] =
              random_vector(random, s.dimension);
        const Posed posed(base, pose, {turning, Follow::moved});
        const Points told = whole(posed, *model, model->levels());
        const Points wanted = Definition(*model, pose, level, turning).places();
        // R^-1 is not used; sums of some ten products a level, of turned details as large as the curve.
        EXPECT_LE(distance(told, wanted), 1e-12 * (1 + largest(wanted)))
            << name(*model) << " level " << level << " turning " << static_cast<int>(turning);
      }
}

TEST(Posed, KeepsEveryBitOutsideTheNodesThatHoldAMovedHandle) {
  Random random(3);
  for (const Subject& s : subjects(random))
    for (const bool bent : {false, true}) {
      const ModelPtr model = rough(s, random);
      const Base base(model);
      const int level = 2;
      const Handles handles(model->shape(), model->closed(), level);
      Pose before = still(*model);
      if (bent) move_root(before, *model, random);
      Pose after = before;
      const Index handle = uniform(random, 0, handles.count() - 1);
      after.moves[level].own[handle] = random_vector(random, s.dimension);
      std::set<Index> nodes;
      for (const Seat& seat : handles.seats(handle)) nodes.insert(seat.node);
      // Places that polygons of those nodes read.
      const int finest = model->levels();
      const Handles places(model->shape(), model->closed(), finest);
      const Index below = model->shape().nodes(finest - level);
      const Points a = whole(Posed(base, before, {}), *model, finest),
                   b = whole(Posed(base, after, {}), *model, finest);
      Index changed = 0;
      for (Index p = 0; p < a.count(); ++p) {
        const auto seats = places.seats(p);
        const bool touched =
            std::ranges::any_of(seats, [&](const Seat& seat) { return nodes.contains(seat.node / below); });
        const bool alike = a.matrix().row(p) == b.matrix().row(p);
        if (!touched) {
          ASSERT_TRUE(alike) << name(*model) << " handle " << handle << " place " << p;
        }
        changed += alike ? 0 : 1;
      }
      EXPECT_GT(changed, 0) << name(*model);
    }
}

TEST(Posed, PutsHandlesWhereTheyAreMovedTo) {
  Random random(4);
  for (const Subject& s : subjects(random)) {
    if (!s.filter->shape().joined()) continue;  // square places are means of several polygons' points
    const ModelPtr model = rough(s, random);
    const Base base(model);
    Pose pose = still(*model);
    move_root(pose, *model, random);
    for (const int level : {1, 3, 2}) {  // what is above moves on: below, displacements are told in its frame
      const Index handle = uniform(random, 0, model->shape().places(level, model->closed()) - 1);
      const Vector by = random_vector(random, s.dimension);
      const Posed before(base, pose, {});
      const Points old = before.places(level, handle, 1);
      Pose moved = pose;
      moved.moves[static_cast<std::size_t>(level)].own[handle] = inverse(before.frame(level, handle)) * by;
      const Points now = Posed(base, moved, {}).places(level, handle, 1);
      EXPECT_LE((now.matrix().row(0) - old.matrix().row(0) - by.transpose()).cwiseAbs().maxCoeff(),
                1e-12 * (1 + largest(old)))
          << name(*model) << " level " << level;
      pose = moved;
    }
  }
}

TEST(Posed, HoldsPinsWhateverMovesAboveThem) {
  Random random(5);
  for (const Subject& s : subjects(random)) {
    if (!s.filter->shape().joined()) continue;
    const ModelPtr model = rough(s, random);
    const Base base(model);
    Pose pose = still(*model);
    const int level = 2;
    const Index handle = uniform(random, 0, model->shape().places(level, model->closed()) - 1);
    const Points place = laid(*model, level);
    pose.moves[level].pins[handle] = place.matrix().row(handle).transpose();
    EXPECT_EQ(whole(Posed(base, pose, {}), *model, model->levels()), laid(*model, model->levels()));
    move_root(pose, *model, random);
    pose.moves[1].own[1] = random_vector(random, s.dimension);
    EXPECT_EQ(Posed(base, pose, {}).places(level, handle, 1).matrix().row(0), place.matrix().row(handle))
        << name(*model);
  }
}

TEST(Posed, TellsTheSameBitsThroughAnyWindow) {
  Random random(6);
  for (const Subject& s : subjects(random)) {
    const ModelPtr model = rough(s, random, 300);
    const Base base(model);
    Pose pose = still(*model);
    move_root(pose, *model, random);
    pose.moves[1].field[0] = random_vector(random, s.dimension);
    pose.moves[2].own[2] = random_vector(random, s.dimension);
    for (const Follow follow : {Follow::moved, Follow::each}) {
      const Posed posed(base, pose, {Turning::similarity, follow});
      for (const int level : {2, model->levels()}) {
        const Points all = whole(posed, *model, level);
        for (int trial = 0; trial < 5; ++trial) {
          const Index first = uniform(random, 0, all.count() - 1), count = uniform(random, 1, all.count() - first);
          EXPECT_EQ(posed.places(level, first, count).matrix(), all.matrix().middleRows(first, count)) << name(*model);
        }
      }
    }
  }
}

// Paper 002, Local: the moved handles are analysed up; the details below take the root's turn.
TEST(Posed, OfAFieldIsThePapersLocalDeformation) {
  Random random(7);
  for (const Subject& s : subjects(random))
    for (const Turning turning : all_turnings) {
      const ModelPtr model = rough(s, random);
      const Shape& shape = model->shape();
      const int level = 2;
      const Base base(model);
      Pose pose = still(*model);
      const Handles handles(shape, model->closed(), level);
      const Points unmoved = line(*model, level);
      Points moved = unmoved;
      for (Index h = 0; h < handles.count(); ++h) {
        pose.moves[level].field[h] = random_vector(random, s.dimension);
        for (const Seat& seat : handles.seats(h))
          moved.matrix().row(seat.node * shape.polygon_step() + seat.point) =
              unmoved.matrix().row(seat.node * shape.polygon_step() + seat.point) +
              pose.moves[level].field[h].transpose();
      }
      ModelParts parts = model->parts();
      Points fine = moved;
      for (int l = level - 1; l >= 0; --l) {
        Points coarse(s.dimension, shape.line_length(l));
        auto details = std::make_shared<Points>(s.dimension, shape.detail_count(l));
        for (Index axis = 0; axis < s.dimension; ++axis)
          plain::analyze_level(model->filter(), fine.plane(axis), coarse.plane(axis), details->plane(axis));
        parts.details[static_cast<std::size_t>(l)] = details;
        fine = coarse;
      }
      const SmallMatrix turned = turn(model->parts().polygon.matrix(), fine.matrix(), turning);
      parts.polygon = fine;
      for (int l = level; l < model->levels(); ++l) {
        auto details = std::make_shared<Points>(model->details(l));
        details->matrix() = model->details(l).matrix() * turned.transpose();
        parts.details[static_cast<std::size_t>(l)] = details;
      }
      const Points wanted = laid(*std::make_shared<Model>(parts), model->levels());
      EXPECT_LE(distance(whole(Posed(base, pose, {turning, Follow::moved}), *model, model->levels()), wanted),
                1e-11 * (1 + largest(wanted)))
          << name(*model) << " turning " << static_cast<int>(turning);
    }
}

TEST(Posed, SnapshotsAgree) {
  Random random(8);
  for (const Subject& s : subjects(random))
    for (const Follow follow : {Follow::moved, Follow::each, Follow::none}) {
      const ModelPtr model = rough(s, random);
      const Base base(model);
      Pose pose = still(*model);
      move_root(pose, *model, random);
      pose.moves[1].own[1] = random_vector(random, s.dimension);
      pose.moves[2].field[3] = random_vector(random, s.dimension);
      pose.moves[2].own[1] = random_vector(random, s.dimension);
      const Posed posed(base, pose, {Turning::similarity, follow});
      const ModelPtr snapshot = posed.snapshot();
      const Points told = whole(posed, *model, model->levels());
      EXPECT_LE(distance(laid(*snapshot, model->levels()), told), 1e-12 * (1 + largest(told))) << name(*model);
      EXPECT_EQ(snapshot->placement().samples(), model->placement().samples());
    }
}

// Each mode follows the motions that it can tell: similarities, rigid motions, affine maps.
TEST(Posed, FollowsMotionsOfTheWholeCurve) {
  Random random(9);
  for (const Subject& s : subjects(random)) {
    const ModelPtr model = rough(s, random);
    // Affine maps are told by points that span; a ring's first and last are one.
    const bool ring = s.closed && s.filter->shape().joined();
    if (s.filter->shape().control_points() - (ring ? 1 : 0) <= s.dimension) continue;
    const Base base(model);
    const Matrix rotation = random_rotation(random, s.dimension);
    const Matrix any = Matrix::NullaryExpr(s.dimension, s.dimension, [&] { return normal(random); });
    const Vector shift = random_vector(random, s.dimension);
    for (const auto& [turning, map] : {std::pair<Turning, Matrix>{Turning::similarity, 1.7 * rotation},
                                       {Turning::rotation, rotation},
                                       {Turning::linear, any}}) {
      Pose pose = still(*model);
      pose.polygon.matrix() = ((pose.polygon.matrix() * map.transpose()).rowwise() + shift.transpose()).eval();
      const Points wanted =
          points_from((laid(*model, model->levels()).matrix() * map.transpose()).rowwise() + shift.transpose());
      // A ring's ends are rounded alike.
      if (ring) pose.polygon.matrix().bottomRows(1) = pose.polygon.matrix().row(0);
      const Points told = whole(Posed(base, pose, {turning, Follow::moved}), *model, model->levels());
      // The pseudo-inverse of polygons that are nearly flat loses what their condition says.
      const double close = turning == Turning::linear ? 1e-9 : 1e-12;
      EXPECT_LE(distance(told, wanted), close * (1 + largest(wanted)))
          << name(*model) << " turning " << static_cast<int>(turning);
    }
  }
}

TEST(Posed, OfCollinearAndCoincidentPolygonsIsFinite) {
  Random random(10);
  for (const Subject& s : subjects(random))
    for (const Kind kind : {Kind::collinear, Kind::constant, Kind::repeated})
      for (const Turning turning : all_turnings) {
        const ModelPtr model = analyze(s.filter, random_curve(random, 40, s.dimension, kind), s.closed);
        const Base base(model);
        Pose pose = still(*model);
        move_root(pose, *model, random);
        pose.moves[1].own[1] = random_vector(random, s.dimension);
        EXPECT_TRUE(whole(Posed(base, pose, {turning, Follow::moved}), *model, model->levels()).matrix().allFinite());
        pose.polygon.matrix().setZero();  // all in one point
        EXPECT_TRUE(whole(Posed(base, pose, {turning, Follow::moved}), *model, model->levels()).matrix().allFinite());
      }
}

}  // namespace
