#include "system/system.h"

#include "base/error.h"
#include "support.h"
#include "system/named.h"

using namespace ifsm::core;
using namespace ifsm::core::testing;

namespace {

TEST(System, TakesMapsAsOftenAsTheyAreLargeAndFlatOnesToo) {
  const System fern(2, named_system("fern")->maps());
  const double sizes[] = {.7241, .1038, .1088, 1. / 25 * (.7241 + .1038 + .1088) / 4};
  const double sum = sizes[0] + sizes[1] + sizes[2] + sizes[3];
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(fern.probabilities()[i], sizes[i] / sum, 4 * epsilon);
  EXPECT_TRUE(fern.weights().empty());
}

TEST(System, TakesMapsAlikeWhenAllAreFlat) {
  const System set(2, {plane(.3, 0, 0, 0, 0, 0), plane(.2, 0, 0, 0, 1, 0)});
  EXPECT_EQ(set.probabilities(), (std::vector<double>{.5, .5}));
}

TEST(System, DividesWeightsByTheirSumAndKeepsThemAsTheyWereGiven) {
  const auto maps = named_system("gasket_right")->maps();
  const System system(2, maps, {1, 2, 5});
  EXPECT_EQ(system.probabilities(), (std::vector<double>{.125, .25, .625}));
  EXPECT_EQ(system.weights(), (std::vector<double>{1, 2, 5}));
  EXPECT_EQ(system, System(2, maps, {1, 2, 5}));
  EXPECT_FALSE(system == System(2, maps, {2, 4, 10}));
  EXPECT_FALSE(system == System(2, maps));
  const System huge(2, maps, {1e308, 1e308, 1e308});
  for (const double p : huge.probabilities()) EXPECT_NEAR(p, 1. / 3, epsilon);
}

TEST(System, LeavesOutMapsOfProbabilityZero) {
  const auto tree = named_system("tree_type1_with_dummy");
  EXPECT_EQ(tree->active(), (std::vector<int>{0, 1, 2, 4}));
  // A dummy that would not contract changes nothing.
  const System system(2, {plane(.5, 0, 0, .5, 0, 0), plane(3, 0, 0, 3, 0, 0), plane(.5, 0, 0, .5, 1, 0)}, {1, 0, 1});
  EXPECT_EQ(system.contraction().answer, Contractivity::proven);
}

TEST(System, RefusesWhatIsNoSystemAndSaysWhere) {
  const auto maps = named_system("gasket_right")->maps();
  EXPECT_EQ(refusal([&] { System(4, maps); }).argument(), "dimension");
  EXPECT_EQ(refusal([&] { System(2, {}); }).status(), Status::range);
  EXPECT_EQ(refusal([&] { System(2, std::vector<Affine>(257, maps[0])); }).value(), 257);
  auto broken = maps;
  broken[1].shift(0) = NAN;
  EXPECT_EQ(refusal([&] { System(2, broken); }).index(), 1);
  EXPECT_EQ(refusal([&] { System(2, maps, {1, 2}); }).required(), 3);
  EXPECT_EQ(refusal([&] { System(2, maps, {1, 2, -1}); }).index(), 2);
  EXPECT_EQ(refusal([&] { System(2, maps, {1, INFINITY, 1}); }).status(), Status::not_finite);
  EXPECT_EQ(refusal([&] { System(2, maps, {0, 0, 0}); }).argument(), "probabilities");
  EXPECT_EQ(refusal([&] {
              System(2, {plane(.5, 0, 0, .5, 1e308, 1e308), plane(.9, 0, 0, .9, 0, -1e308)});
            }).argument(),
            "maps");
}

TEST(Contraction, IsProvenByOneLetterWhereACommonChangeOfCoordinatesShowsIt) {
  for (const NamedSystem& each : named_systems()) {
    const auto system = named_system(each.name);
    EXPECT_EQ(system->contraction().answer, Contractivity::proven) << each.name;
    EXPECT_LE(system->contraction().length, 8) << each.name;
  }
}

TEST(Contraction, IsProvenThoughSingleMapsStretch) {
  // Each stretches by more than two, alone and in most norms; every product of two is small.
  const System system(2, {plane(0, 3, 0, 0, 1, 0), plane(.1, 2, 0, .1, 0, 1)});
  EXPECT_GT(stretch(system.maps()[0].linear), 2);
  EXPECT_EQ(system.contraction().answer, Contractivity::proven);
}

TEST(Contraction, IsRefutedByAWordWhoseRadiusIsTold) {
  // Norms of 1.2 and radii of 0, but of their product 1.44.
  const System system(2, {plane(0, 1.2, 0, 0, 1, 0), plane(0, 0, 1.2, 0, 0, 1)});
  const Contraction& answer = system.contraction();
  EXPECT_EQ(answer.answer, Contractivity::refuted);
  EXPECT_EQ(answer.word.size(), 2u);
  EXPECT_NEAR(answer.radius, 1.44, 8 * epsilon);
  const Error error = refusal([&] { static_cast<void>(system.enclosure()); });
  EXPECT_EQ(error.status(), Status::range);
  EXPECT_EQ(error.value(), answer.radius);
  EXPECT_NE(std::string(error.what()).find("0 1"), std::string::npos) << error.what();
}

TEST(Contraction, NamesLettersAmongAllMaps) {
  const System system(2, {plane(.5, 0, 0, .5, 0, 0), plane(9, 0, 0, 9, 0, 0), plane(1.5, 0, 0, .5, 0, 0)}, {1, 0, 1});
  EXPECT_EQ(system.contraction().word, (Word{2}));
  EXPECT_EQ(system.contraction().radius, 1.5);
}

TEST(Contraction, IsUndecidedWhereMapsContractTooLittle) {
  const double almost = 1 - 0x1p-40;
  const System system(2, {plane(almost, 0, 0, almost, 0, 0), plane(almost, 0, 0, almost, 1, 0)});
  EXPECT_EQ(system.contraction().answer, Contractivity::undecided);
  EXPECT_EQ(refusal([&] { static_cast<void>(system.enclosure()); }).status(), Status::numerical);
}

TEST(Contraction, SurvivesEntriesThatOverflow) {
  const System system(2, {plane(1e300, 0, 0, 1e300, 0, 0), plane(0, 1e308, 1e308, 0, 1, 1)});
  EXPECT_EQ(system.contraction().answer, Contractivity::refuted);
}

TEST(Enclosure, HoldsTheAttractorOfEveryNamedAndOfRandomSystems) {
  const auto holds = [](const System& system) {
    const Ellipsoid& e = system.enclosure();
    double farthest = 0;
    for (const Vector3& x : points_of(system, 4)) {
      // In the ellipsoid's own coordinates: a least squares solution, since that of the plane is flat.
      const Matrix y = least_squares(e.axes, x - e.centre);
      EXPECT_NEAR((e.axes * y - (x - e.centre)).norm(), 0, 64 * epsilon * (x.norm() + e.centre.norm()));
      farthest = std::max(farthest, y.norm());
    }
    EXPECT_LE(farthest, 1);
  };
  for (const NamedSystem& each : named_systems())
    if (each.name != "menger_sponge") holds(*named_system(each.name));
  Random random(1);
  for (int k = 0; k < 40; ++k) holds(random_system(random, k % 2 + 2, .9));
}

}  // namespace
