#include "curve/attractor.h"

#include <Eigen/Geometry>

#include "../linalg/support.h"
#include "support.h"
#include "system/address.h"
#include "system/named.h"

using namespace ifsm::core;
using namespace ifsm::core::testing;

namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

double difference(const System& a, const System& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.maps().size(); ++i) {
    largest = std::max(largest, (a.maps()[i].linear - b.maps()[i].linear).cwiseAbs().maxCoeff());
    largest = std::max(largest, (a.maps()[i].shift - b.maps()[i].shift).cwiseAbs().maxCoeff());
  }
  return largest;
}

// math.md section 5: Koch's control triangle with its four matrices, exactly.
TEST(SystemOfAModel, IsKochsCurveForKochsMatrices) {
  const Matrix triangle{{0, 0}, {.5, std::sqrt(3) / 6}, {1, 0}};
  const ModelPtr model = from_polygon(named_filter("koch", Topology::square, 3, 4), points_from(triangle), false, 2);
  const SystemPtr system = system_of(*model);
  ASSERT_EQ(system->maps().size(), 4U);
  // w_1: a third, turned by 60 degrees, to (1/3, 0). Inverse of a triangle of height .29: some ten roundings.
  const Affine& turned = system->maps()[1];
  EXPECT_NEAR(turned.linear(0, 0), 1. / 6, 16 * eps);
  EXPECT_NEAR(turned.linear(1, 0), std::sqrt(3) / 6, 16 * eps);
  EXPECT_NEAR(turned.shift(0), 1. / 3, 16 * eps);
  EXPECT_NEAR(turned.shift(1), 0, 16 * eps);
  EXPECT_EQ(system->probabilities(), std::vector<double>(4, .25));
}

TEST(ModelOfASystem, HasTheSystemsMapsAndBackAgain) {
  for (const NamedSystem& named : named_systems()) {
    const SystemPtr system = named_system(named.name);
    if (system->active().size() < 2 || system->active().size() > 8) continue;
    if (system->active().size() < system->maps().size()) continue;
    ModelPtr model;
    try {
      model = model_of(*system, Topology::square, {}, 2);
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), Status::singular) << named.name << ": " << error.what();  // flat: T's rows dependent
      continue;
    }
    // B^-1 w B and back: B is a box's corners, whose condition is some size over distance.
    EXPECT_LT(difference(*system, *system_of(*model)), 1e-12) << named.name;
  }
}

TEST(ModelOfASystem, RunsThroughTheAttractorWhenItsPiecesAreAChain) {
  for (const char* name : {"koch", "levy"}) {
    const SystemPtr system = named_system(name);
    const ModelPtr model = model_of(*system, Topology::joined, {}, 6);
    const Points ends = points(*model, 6);
    // Each place that ends a polygon is the image of an end under a word: here that of the first fixed point.
    const int maps = model->shape().maps();
    for (Index node = 0; node < model->shape().nodes(6); node += 7) {
      std::vector<std::int64_t> word(6);
      Index rest = node;
      for (int letter = 5; letter >= 0; --letter) word[static_cast<std::size_t>(letter)] = rest % maps, rest /= maps;
      const Vector3 begin = word_map(*system, word)(fixed_point(system->maps().front()));
      const auto row = ends.matrix().row(node * 2);
      EXPECT_LT(std::hypot(row(0) - begin(0), row(1) - begin(1)), 1e-13) << name << " node " << node;
    }
  }
}

TEST(ModelOfASystem, LiesInSpaceWithFourPoints) {
  const SystemPtr system = named_system("tetrahedron");
  const ModelPtr model = model_of(*system, Topology::square, {}, 3);
  EXPECT_EQ(model->dimension(), 3);
  EXPECT_EQ(model->shape().control_points(), 4);
  EXPECT_LT(difference(*system, *system_of(*model)), 1e-14);
}

TEST(ModelOfASystem, NamesTheMapWhereAChainBreaks) {
  const SystemPtr fern = named_system("fern");
  const Error error = refusal([&] { model_of(*fern, Topology::joined, {}, 2); });
  EXPECT_EQ(error.status(), Status::shape);
  EXPECT_EQ(error.argument(), "system");
  EXPECT_EQ(error.index(), 1);
}

TEST(ModelOfASystem, RefusesPolygonsThatTellNothing) {
  const SystemPtr koch = named_system("koch");
  const auto refused = [&](const Matrix& rows) {
    return refusal([&] { model_of(*koch, Topology::joined, points_from(rows), 2); });
  };
  EXPECT_EQ(refused(Matrix{{0, 0}, {.5, 0}, {1, 0}}).status(), Status::singular);
  EXPECT_EQ(refused(Matrix{{0, 0}, {1, 0}}).status(), Status::shape);
  EXPECT_EQ(refused(Matrix{{0, .1}, {.5, .5}, {1, 0}}).index(), 0);  // not the first fixed point
  EXPECT_EQ(refused(Matrix{{0, 0}, {.5, .5}, {1, .1}}).index(), 3);  // not the last one
}

TEST(SystemOfAModel, NeedsOnePointMoreThanDimensions) {
  const ModelPtr model =
      from_polygon(named_filter("casteljau", Topology::joined, 4, 2), points_from(Matrix::Random(4, 2)), false, 1);
  EXPECT_EQ(refusal([&] { system_of(*model); }).required(), 3);
  const ModelPtr flat = from_polygon(named_filter("casteljau", Topology::joined, 3, 2),
                                     points_from(Matrix{{0, 0}, {1, 1}, {2, 2}}), false, 1);
  EXPECT_EQ(refusal([&] { system_of(*flat); }).status(), Status::singular);
}

TEST(ModelOfASystem, SaysWhenNoPolygonCanBeChosen) {
  Affine half = Affine::identity(2), quarter = half;
  half.linear *= .5, quarter.linear *= .25;
  const System point(2, {half, quarter});  // its attractor is the origin
  for (const Topology topology : {Topology::joined, Topology::square}) {
    const Error error = refusal([&] { model_of(point, topology, {}, 2); });
    EXPECT_EQ(error.status(), Status::singular);
    EXPECT_EQ(error.argument(), "system");
  }
}

}  // namespace
