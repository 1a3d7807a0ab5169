#include "system/address.h"

#include "base/error.h"
#include "support.h"
#include "system/named.h"

using namespace ifsm::core;
using namespace ifsm::core::testing;

namespace {

using Letters = std::vector<std::int64_t>;

TEST(WordMap, ComposesTheFirstLetterLast) {
  const auto fern = named_system("fern");
  const Vector3 x(.3, .7, 0);
  EXPECT_EQ(word_map(*fern, Letters{0, 2, 1})(x), (fern->maps()[0] * fern->maps()[2] * fern->maps()[1])(x));
  EXPECT_EQ(word_map(*fern, Letters{})(x), x);
  EXPECT_NEAR((word_map(*fern, Letters{0, 2})(x) - fern->maps()[0](fern->maps()[2](x))).norm(), 0, 4 * epsilon);
}

TEST(PointOf, IsTheFixedPointOfAPeriod) {
  const auto gasket = named_system("gasket_right");
  EXPECT_EQ(point_of(*gasket, Letters{1}, 1), Vector3(1, 0, 0));
  EXPECT_EQ(point_of(*gasket, Letters{0, 1}, 1), Vector3(.5, 0, 0));
  EXPECT_EQ(point_of(*gasket, Letters{1, 0}, 1), Vector3(.5, 0, 0));
  // .010101… in twos.
  EXPECT_NEAR((point_of(*gasket, Letters{0, 1}, 2) - Vector3(1. / 3, 0, 0)).norm(), 0, epsilon);
}

TEST(PointOf, TellsTheTenthLetterThatIsNone) {
  const auto gasket = named_system("gasket_right");
  for (const std::int64_t bad : {std::int64_t{-1}, std::int64_t{3}, INT64_MAX}) {
    Letters word(12, 1);
    word[10] = bad;
    try {
      point_of(*gasket, word, 2);
      ADD_FAILURE();
    } catch (const Error& error) {
      EXPECT_EQ(error.argument(), "symbols");
      EXPECT_EQ(error.index(), 10);
    }
  }
  EXPECT_THROW(point_of(*gasket, Letters{1}, 0), Error);
  EXPECT_THROW(point_of(*gasket, Letters{1}, 2), Error);
  EXPECT_THROW(point_of(*gasket, Letters{}, 1), Error);
  EXPECT_THROW(point_of(*named_system("tree_type1_with_dummy"), Letters{3}, 1), Error);
}

TEST(AddressesOf, AreBothWordsOfAPointWhereTwoPiecesMeet) {
  const auto gasket = named_system("gasket_right");
  EXPECT_EQ(addresses_of(*gasket, Vector3(.5, 0, 0), 4, 1e-9, 100), (std::vector<Letters>{{0, 1, 1, 1}, {1, 0, 0, 0}}));
  EXPECT_EQ(addresses_of(*gasket, Vector3(0, 1, 0), 3, 1e-9, 100), (std::vector<Letters>{{2, 2, 2}}));
  EXPECT_TRUE(addresses_of(*gasket, Vector3(.5, .6, 0), 3, 1e-9, 100).empty());
}

TEST(AddressesOf, AreTheWordThatAPointWasMadeOf) {
  Random random(5);
  for (const char* name : {"fern", "gasket", "koch", "heighway_dragon", "menger_sponge", "fern_3d"}) {
    const auto system = named_system(name);
    for (int k = 0; k < 20; ++k) {
      Letters word;
      for (int i = 0; i < 24; ++i)
        word.push_back(uniform(random, 0, static_cast<Eigen::Index>(system->maps().size()) - 1));
      const auto found = addresses_of(*system, point_of(*system, word, 1), 5, 1e-6, 1000);
      const Letters wanted(word.begin(), word.begin() + 5);
      EXPECT_NE(std::find(found.begin(), found.end(), wanted), found.end()) << name;
      for (const Letters& each : found) {
        double nearest = INFINITY;
        const Affine piece = word_map(*system, each);
        for (const Vector3& x : points_of(*system, system->maps().size() > 8 ? 3 : 6))
          nearest = std::min(nearest, (piece(x) - point_of(*system, word, 1)).norm());
        EXPECT_LE(nearest, stretch(piece.linear) * 2 * system->enclosure().axes.norm()) << name;
      }
    }
  }
}

TEST(AddressesOf, AreAllThatAreNearAndNoneThatIsFar) {
  const auto fern = named_system("fern");
  Random random(6);
  const auto points = points_of(*fern, 7);
  for (int k = 0; k < 60; ++k) {
    const Vector3 x(3 * normal(random), 5 + 3 * normal(random), 0);
    const double tolerance = .2;
    const auto found = addresses_of(*fern, x, 1, tolerance, 1000);
    for (const int i : fern->active()) {
      double nearest = INFINITY;
      for (const Vector3& y : points)
        nearest = std::min(nearest, (fern->maps()[static_cast<std::size_t>(i)](y) - x).norm());
      const bool named = std::find(found.begin(), found.end(), Letters{i}) != found.end();
      if (nearest <= tolerance) {
        EXPECT_TRUE(named) << k << " " << i;
      }
      // Points of words of seven letters leave the tips of the main branch out.
      if (nearest > 2 * tolerance + std::pow(.86, 7) * 10) {
        EXPECT_FALSE(named) << k << " " << i;
      }
    }
  }
}

TEST(AddressesOf, EndWithAnErrorWhereThereAreTooMany) {
  // The stem of the fern: every word of flat maps' ends.
  const System interval(2, {plane(.9, 0, 0, .9, 0, 0), plane(.9, 0, 0, .9, .1, 0)});
  try {
    addresses_of(interval, Vector3(.5, 0, 0), 60, 1e-3, 1000);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Status::limit);
  }
}

TEST(AddressesOf, TheOriginAloneAreThoseOfAllWords) {
  const System origin(2, {plane(.5, 0, 0, .5, 0, 0), plane(.2, .1, 0, .5, 0, 0)});
  EXPECT_EQ(addresses_of(origin, Vector3::Zero(), 2, 0, 100).size(), 4U);
  EXPECT_TRUE(addresses_of(origin, Vector3(1e-100, 0, 0), 2, 0, 100).empty());
}

}  // namespace
