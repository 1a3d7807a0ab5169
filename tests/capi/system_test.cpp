// Systems through the C ABI: each function's answer, exact where there is one, and the refusals that the misuse matrix
// does not know of.
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>

#include "shapes.h"
#include "systems.h"

namespace {

using Doubles = std::vector<double>;
using Symbols = std::vector<int32_t>;

Doubles maps_of(ifsm_system system) {
  return all_of<double>(
      [&](double* to, int64_t room, int64_t* count) { return ifsm_system_maps(system, to, room, count); });
}
Doubles parameters_of(ifsm_system system) {
  return all_of<double>(
      [&](double* to, int64_t room, int64_t* count) { return ifsm_system_parameters(system, to, room, count); });
}
Doubles probabilities_of(ifsm_system system) {
  return all_of<double>(
      [&](double* to, int64_t room, int64_t* count) { return ifsm_system_probabilities(system, to, room, count); });
}
Doubles fixed_points_of(ifsm_system system) {
  return all_of<double>(
      [&](double* to, int64_t room, int64_t* count) { return ifsm_system_fixed_points(system, to, room, count); });
}
Symbols witness_of(ifsm_system system) {
  return all_of<int32_t>(
      [&](int32_t* to, int64_t room, int64_t* count) { return ifsm_system_witness(system, to, room, count); });
}
Doubles word_of(ifsm_system system, const Symbols& word) {
  return all_of<double>([&](double* to, int64_t room, int64_t* count) {
    return ifsm_system_word(system, word.data(), static_cast<int64_t>(word.size()), to, room, count);
  });
}
Doubles point_of(ifsm_system system, const Symbols& word, int64_t period) {
  return all_of<double>([&](double* to, int64_t room, int64_t* count) {
    return ifsm_system_point(system, word.data(), static_cast<int64_t>(word.size()), period, to, room, count);
  });
}
Symbols addresses_of(ifsm_system system, const Doubles& point, int32_t length, double tolerance = 0) {
  return all_of<int32_t>([&](int32_t* to, int64_t room, int64_t* count) {
    return ifsm_system_addresses(system, point.data(), static_cast<int64_t>(point.size()), length, tolerance, to, room,
                                 count);
  });
}
Doubles box_of(ifsm_system system, double tolerance = 0) {
  return all_of<double>(
      [&](double* to, int64_t room, int64_t* count) { return ifsm_system_box(system, tolerance, to, room, count); });
}
Doubles ball_of(ifsm_system system, double tolerance = 0) {
  return all_of<double>(
      [&](double* to, int64_t room, int64_t* count) { return ifsm_system_ball(system, tolerance, to, room, count); });
}
ifsm_system_info info_of(ifsm_system system) {
  ifsm_system_info info{};
  info.struct_size = sizeof info;
  EXPECT_EQ(ifsm_system_describe(system, &info), IFSM_OK) << last_error().message;
  return info;
}

class Systems : public WithSystems {};

TEST_F(Systems, TellTheMapsThatTheyAreMadeOf) {
  const Doubles maps = {.1, .2, .3, -.4, .5, -.6, 0, 0, 7, 0, .25, 8};
  const ifsm_system system = of(maps, {1, 3});
  EXPECT_EQ(maps_of(system), maps);
  EXPECT_EQ(probabilities_of(system), (Doubles{.25, .75}));
  // (x, y) = M (x, y) + t: of the flat map x = 7, y = 8 / (1 - 1/4).
  const Doubles fixed = fixed_points_of(system);
  ASSERT_EQ(fixed.size(), 4U);
  EXPECT_NEAR(.1 * fixed[0] + .2 * fixed[1] + .3, fixed[0], 1e-15);
  EXPECT_NEAR(-.4 * fixed[0] + .5 * fixed[1] - .6, fixed[1], 1e-15);
  EXPECT_DOUBLE_EQ(fixed[2], 7);
  EXPECT_DOUBLE_EQ(fixed[3], 8 / .75);
  const ifsm_system_info info = info_of(system);
  EXPECT_EQ(info.dimension, 2);
  EXPECT_EQ(info.maps, 2);
  EXPECT_EQ(info.active, 2);
  EXPECT_EQ(info.contractive, 1);
  EXPECT_GE(info.word_length, 1);
  EXPECT_TRUE(std::isnan(info.radius));

  const Doubles space = {.5, 0, 0, 1, 0, .5, 0, 2, 0, 0, .25, 3};
  const ifsm_system solid = of(space, {}, 3);
  EXPECT_EQ(maps_of(solid), space);
  EXPECT_EQ(fixed_points_of(solid), (Doubles{2, 4, 4}));
  EXPECT_EQ(info_of(solid).dimension, 3);
  // Where a map has no fixed point, or many, none is told.
  for (const double each : fixed_points_of(of({1, 0, 1, 0, 1, 0}))) EXPECT_FALSE(std::isfinite(each));
}

TEST_F(Systems, HaveProbabilitiesByDeterminantWhereNoneAreGiven) {
  // |det| 1/4, 1/16 and 0, which counts as a 25th of their mean.
  const Doubles maps = {.5, 0, 0, 0, .5, 0, 0, -.25, 1, .25, 0, 0, .5, 0, 2, 0, 0, 0};
  const double mean = (1. / 4 + 1. / 16) / 3, sum = 1. / 4 + 1. / 16 + mean / 25;
  const Doubles wanted = {1. / 4 / sum, 1. / 16 / sum, mean / 25 / sum};
  const Doubles told = probabilities_of(of(maps));
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(told[k], wanted[k], 1e-15);
  EXPECT_EQ(probabilities_of(of({0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0, 4})), (Doubles{.5, .5}));
  EXPECT_EQ(info_of(of(maps, {1, 0, 1})).active, 2);
}

TEST_F(Systems, RefuseMapsAndProbabilitiesByName) {
  ifsm_system system{};
  const Doubles maps = {.5, 0, 0, 0, .5, 0, .5, 0, 1, 0, .5, 0};
  FAILS(ifsm_system_create(2, maps.data(), 11, nullptr, 0, &system), IFSM_ERROR_SHAPE, "maps");
  FAILS(ifsm_system_create(2, maps.data(), 0, nullptr, 0, &system), IFSM_ERROR_SHAPE, "maps");
  const Doubles many(6 * 257);
  FAILS(ifsm_system_create(2, many.data(), 6 * 257, nullptr, 0, &system), IFSM_ERROR_RANGE, "maps");
  const double one[] = {1}, negative[] = {1, -1}, none[] = {0, 0};
  FAILS(ifsm_system_create(2, maps.data(), 12, one, 1, &system), IFSM_ERROR_SHAPE, "probabilities");
  FAILS(ifsm_system_create(2, maps.data(), 12, negative, 2, &system), IFSM_ERROR_RANGE, "probabilities");
  EXPECT_EQ(last_error().index, 1);
  FAILS(ifsm_system_create(2, maps.data(), 12, none, 2, &system), IFSM_ERROR_RANGE, "probabilities");
  EXPECT_EQ(system.id, 0U);
  EXPECT_EQ(info_of(of(Doubles(6 * 256))).maps, 256);
}

TEST_F(Systems, AreMadeOfWhatTheirMapsDo) {
  ifsm_system system{};
  // Shear, then scale, then a quarter of a turn: (x, y) -> (-3 y, 2 (x + y / 4)), moved.
  const Doubles parameters = {std::numbers::pi / 2, 2, 3, .25, 5, 6};
  WORKS(ifsm_system_from_parameters(2, parameters.data(), 6, nullptr, 0, &system));
  keep(system);
  const Doubles map = maps_of(system), wanted = {0, -3, 5, 2, .5, 6};
  for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(map[k], wanted[k], 4e-16) << k;
  const Doubles back = parameters_of(system);
  for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(back[k], parameters[k], 4e-15) << k;

  // About z, in space; all three shears.
  const Doubles space = {0, 0, std::numbers::pi / 2, .5, .25, .125, .5, .75, -.5, 1, 2, 3};
  WORKS(ifsm_system_from_parameters(3, space.data(), 12, nullptr, 0, &system));
  keep(system);
  const Doubles solid = maps_of(system), wanted3 = {0, -.25, .125, 1, .5, .25, .375, 2, 0, 0, .125, 3};
  for (std::size_t k = 0; k < 12; ++k) EXPECT_NEAR(solid[k], wanted3[k], 4e-16) << k;
  const Doubles back3 = parameters_of(system);
  for (std::size_t k = 0; k < 12; ++k) EXPECT_NEAR(back3[k], space[k], 4e-15) << k;

  // Of a reflection the last scale is negative.
  EXPECT_EQ(parameters_of(of({.5, 0, 0, 0, -.25, 0})), (Doubles{0, .5, -.25, 0, 0, 0}));
  FAILS(ifsm_system_from_parameters(3, space.data(), 6, nullptr, 0, &system), IFSM_ERROR_SHAPE, "parameters");
}

TEST_F(Systems, HaveNamesOfWhichThereIsACatalogue) {
  ifsm_system_entry entry{};
  entry.struct_size = sizeof entry;
  int64_t index = 0;
  for (; ifsm_system_catalog(index, &entry) == IFSM_OK; ++index) {
    const ifsm_system_info info = info_of(named(entry.name));
    EXPECT_EQ(info.dimension, entry.dimension) << entry.name;
    EXPECT_EQ(info.contractive, 1) << entry.name;
    EXPECT_GT(std::strlen(entry.source), 3U) << entry.name;
  }
  EXPECT_GE(index, 36);
  FAILS(ifsm_system_catalog(index, &entry), IFSM_ERROR_RANGE, "index");
  EXPECT_NE(std::string(last_error().message).find(std::to_string(index - 1)), std::string::npos);
  FAILS(ifsm_system_catalog(-1, &entry), IFSM_ERROR_RANGE, "index");

  EXPECT_EQ(maps_of(named("fern")), maps_of(named("fern_barnsley")));
  EXPECT_EQ(maps_of(named("koch-curve")), maps_of(named("koch")));
  ifsm_system system{};
  FAILS(ifsm_system_named("ferm", &system), IFSM_ERROR_RANGE, "name");
  EXPECT_NE(std::string(last_error().message).find("twin_dragon"), std::string::npos);
}

TEST_F(Systems, TellWhetherTheyContractAndWhichWordDoesNot) {
  const ifsm_system system = growing();
  const ifsm_system_info info = info_of(system);
  EXPECT_EQ(info.maps, 3);
  EXPECT_EQ(info.active, 2);
  EXPECT_EQ(info.contractive, -1);
  EXPECT_EQ(info.word_length, 2);
  EXPECT_NEAR(info.radius, 4, 1e-12);
  const Symbols word = witness_of(system);
  EXPECT_TRUE((word == Symbols{0, 2}) || (word == Symbols{2, 0}));
  EXPECT_EQ(info_of(of({2, 0, 0, 0, .5, 0})).radius, 2);
  EXPECT_TRUE(witness_of(gasket()).empty());

  // Its spectral radius is below 1 by less than any word that is tried can tell.
  const ifsm_system slow = of({1 - 1e-12, 0, 0, 0, .5, 0});
  EXPECT_EQ(info_of(slow).contractive, 0);
  EXPECT_TRUE(witness_of(slow).empty());
  double box[4];
  FAILS(ifsm_system_box(slow, 0, box, 4, &count), IFSM_ERROR_NUMERICAL, "system");
}

// All that asks for an attractor, of a system that has none: the word is named.
TEST_F(Systems, WithoutAnAttractorAreRefusedWithTheWord) {
  const ifsm_system system = growing();
  double room[64];
  int32_t symbols[64];
  const int32_t word[] = {0, 2};
  const double place[] = {0, 0};
  ifsm_dimension_report report{};
  report.struct_size = sizeof report;
  ifsm_model model{};
  const auto names_the_word = [] {
    const std::string message = last_error().message;
    EXPECT_TRUE(message.find("word 0 2") != std::string::npos || message.find("word 2 0") != std::string::npos)
        << message;
    EXPECT_NEAR(last_error().value, 4, 1e-12);
  };
  FAILS(ifsm_system_box(system, 0, room, 64, &count), IFSM_ERROR_RANGE, "system");
  names_the_word();
  FAILS(ifsm_system_ball(system, 0, room, 64, &count), IFSM_ERROR_RANGE, "system");
  names_the_word();
  FAILS(ifsm_system_diameter(system, 0, room), IFSM_ERROR_RANGE, "system");
  names_the_word();
  FAILS(ifsm_system_moments(system, 1, nullptr, 0, room, 64, &count), IFSM_ERROR_RANGE, "system");
  names_the_word();
  FAILS(ifsm_system_addresses(system, place, 2, 3, 0, symbols, 64, &count), IFSM_ERROR_RANGE, "system");
  names_the_word();
  FAILS(ifsm_system_point(system, word, 2, 1, room, 64, &count), IFSM_ERROR_RANGE, "system");
  names_the_word();
  FAILS(ifsm_system_box_dimension(system, 6, &report, room, 64, &count), IFSM_ERROR_RANGE, "system");
  names_the_word();
  FAILS(ifsm_model_from_system(system, IFSM_TOPOLOGY_SQUARE, nullptr, 3, &model), IFSM_ERROR_RANGE, "system");
  names_the_word();
  // Its parts are there.
  EXPECT_EQ(word_of(system, {0, 2}), (Doubles{4, 0, 2, 0, 0, 0}));
}

TEST_F(Systems, ComposeWords) {
  const ifsm_system system = of({.5, 0, 1, 0, .5, 2, 0, -1, 3, 1, 0, 4});
  EXPECT_EQ(word_of(system, {}), (Doubles{1, 0, 0, 0, 1, 0}));
  EXPECT_EQ(word_of(system, {1}), (Doubles{0, -1, 3, 1, 0, 4}));
  // x -> map 0 (map 1 (x)).
  EXPECT_EQ(word_of(system, {0, 1}), (Doubles{0, -.5, 2.5, .5, 0, 4}));
  EXPECT_EQ(word_of(system, {1, 0}), (Doubles{0, -.5, 1, .5, 0, 5}));
  double map[6];
  const int32_t wrong[] = {0, 1, 2};
  FAILS(ifsm_system_word(system, wrong, 3, map, 6, &count), IFSM_ERROR_RANGE, "symbols");
  EXPECT_EQ(last_error().index, 2);
  const Symbols longest(1025);
  FAILS(ifsm_system_word(system, longest.data(), 1025, map, 6, &count), IFSM_ERROR_RANGE, "symbol_count");
  WORKS(ifsm_system_word(system, longest.data(), 1024, map, 6, &count));
}

TEST_F(Systems, HavePointsWithAddressesAndAddressesOfPoints) {
  const ifsm_system system = gasket();
  EXPECT_EQ(point_of(system, {1}, 1), (Doubles{1, 0}));
  EXPECT_EQ(point_of(system, {0, 1}, 1), (Doubles{.5, 0}));
  EXPECT_EQ(point_of(system, {1, 0}, 1), (Doubles{.5, 0}));
  // 0 1 0 1 …: x = (1/2 + x/2) / 2.
  const Doubles third = point_of(system, {0, 1}, 2);
  EXPECT_NEAR(third[0], 1. / 3, 1e-16);
  EXPECT_EQ(third[1], 0);
  EXPECT_EQ(addresses_of(system, {.5, 0}, 1), (Symbols{0, 1}));
  EXPECT_EQ(addresses_of(system, {.5, 0}, 3), (Symbols{0, 1, 1, 1, 0, 0}));
  EXPECT_EQ(addresses_of(system, third, 6), (Symbols{0, 1, 0, 1, 0, 1}));
  EXPECT_TRUE(addresses_of(system, {.3, .3}, 2).empty());
  EXPECT_EQ(addresses_of(system, {.3, .3}, 1, .2), (Symbols{0, 1, 2}));

  double point[2];
  const int32_t symbols[] = {0, 1};
  FAILS(ifsm_system_point(system, symbols, 2, 3, point, 2, &count), IFSM_ERROR_RANGE, "period");
  FAILS(ifsm_system_point(system, symbols, 2, 0, point, 2, &count), IFSM_ERROR_RANGE, "period");
  FAILS(ifsm_system_point(system, symbols, 0, 1, point, 2, &count), IFSM_ERROR_RANGE, "symbol_count");
  // Maps of probability 0 take no part.
  const int32_t dummy[] = {0, 1};
  FAILS(ifsm_system_point(of({.5, 0, 0, 0, .5, 0, .5, 0, 1, 0, .5, 0}, {1, 0}), dummy, 2, 1, point, 2, &count),
        IFSM_ERROR_RANGE, "symbols");
  EXPECT_EQ(last_error().index, 1);
  int32_t room[8];
  const double place[] = {.5, 0};
  FAILS(ifsm_system_addresses(system, place, 1, 1, 0, room, 8, &count), IFSM_ERROR_SHAPE, "point_count");
  FAILS(ifsm_system_addresses(system, place, 2, 1, -1, room, 8, &count), IFSM_ERROR_RANGE, "tolerance");
  // More than 65536 words.
  FAILS(ifsm_system_addresses(system, place, 2, 20, 1, room, 8, &count), IFSM_ERROR_LIMIT, "length");
}

TEST_F(Systems, TellWhereTheAttractorIs) {
  const double within = 1e-9 * 4;  // a billionth of the attractor's size, which is told by its ellipsoid
  const Doubles box = box_of(gasket()), unit = {0, 0, 1, 1};
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(box[k], unit[k], within) << k;
    EXPECT_TRUE(k < 2 ? box[k] <= unit[k] : box[k] >= unit[k]) << k;
  }
  double across = 0;
  WORKS(ifsm_system_diameter(gasket(), 0, &across));
  EXPECT_GE(across, std::sqrt(2.));
  EXPECT_NEAR(across, std::sqrt(2.), within);
  const Doubles ball = ball_of(gasket(), 1e-4);
  ASSERT_EQ(ball.size(), 3U);
  // The smallest one is about (1/2, 1/2), and a hundredth smaller at most.
  EXPECT_LE(ball[2], 1.01 * std::sqrt(.5));
  EXPECT_LE(std::hypot(ball[0] - .5, ball[1] - .5), .02 * std::sqrt(.5));
  double farthest = 0;
  for (const auto& [x, y] : {std::pair{0, 0}, {1, 0}, {0, 1}})
    farthest = std::max(farthest, std::hypot(ball[0] - x, ball[1] - y));
  EXPECT_GE(ball[2], farthest);
  EXPECT_LE(ball[2], farthest + 1e-4);
  EXPECT_EQ(ball_of(named("sponge"), 1e-2).size(), 4U);
  const Doubles solid = box_of(named("sponge"), 1e-3);
  ASSERT_EQ(solid.size(), 6U);
  for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(solid[k], k < 3 ? 0 : 1, 1e-3);

  // Of a single point too.
  for (const double each : box_of(of({.5, 0, 1, 0, .5, 2}))) EXPECT_TRUE(each < 5 && each > 1);
  double room[6];
  for (const double wrong : {-1e-6, 1e6}) {
    FAILS(ifsm_system_box(gasket(), wrong, room, 4, &count), IFSM_ERROR_RANGE, "tolerance");
    FAILS(ifsm_system_ball(gasket(), wrong, room, 4, &count), IFSM_ERROR_RANGE, "tolerance");
    FAILS(ifsm_system_diameter(gasket(), wrong, room), IFSM_ERROR_RANGE, "tolerance");
  }
  FAILS(ifsm_system_box(gasket(), 1e-15, room, 4, &count), IFSM_ERROR_RANGE, "tolerance");
}

TEST_F(Systems, OfASinglePointHaveAPlaceAndNoExtent) {
  for (const Doubles& map : {Doubles{.5, 0, 1, 0, .5, 2}, Doubles{0, 0, 2, 0, 0, 4}, Doubles{.5, 0, 0, 0, .5, 0}}) {
    const ifsm_system system = of(map);
    const Doubles box = box_of(system), place = map[2] > 0 ? Doubles{2, 4, 2, 4} : Doubles(4);
    EXPECT_EQ(addresses_of(system, {place[0], place[1]}, 3), (Symbols{0, 0, 0}));
    for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(box[k], place[k], 1e-12) << k;
    const Doubles ball = ball_of(system);
    EXPECT_NEAR(ball[2], 0, 1e-12);
    double across = -1;
    WORKS(ifsm_system_diameter(system, 0, &across));
    EXPECT_NEAR(across, 0, 1e-12);
  }
}

TEST_F(Systems, TellMomentsExactly) {
  const auto moments = [&](ifsm_system system, int32_t degree, const Doubles& about) {
    return all_of<double>([&](double* to, int64_t room, int64_t* told) {
      return ifsm_system_moments(system, degree, about.data(), static_cast<int64_t>(about.size()), to, room, told);
    });
  };
  const Doubles second = moments(gasket(), 2, {});
  const Doubles wanted = {1, 1. / 3, 1. / 3, 5. / 27, 2. / 27, 5. / 27};
  ASSERT_EQ(second.size(), 6U);
  for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(second[k], wanted[k], 1e-15) << k;
  const Doubles central = moments(gasket(), 2, {1. / 3, 1. / 3});
  const Doubles wanted_central = {1, 0, 0, 2. / 27, -1. / 27, 2. / 27};
  for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(central[k], wanted_central[k], 1e-15) << k;
  EXPECT_EQ(moments(named("sponge"), 2, {}).size(), 10U);
  double room[6];
  const double about[] = {1, 2, 3};
  FAILS(ifsm_system_moments(gasket(), 2, about, 3, room, 6, &count), IFSM_ERROR_SHAPE, "about_count");
}

TEST_F(Systems, TellDimensions) {
  double dimension = 0;
  WORKS(ifsm_system_similarity_dimension(gasket(), &dimension));
  EXPECT_NEAR(dimension, std::log2(3), 1e-14);
  WORKS(ifsm_system_similarity_dimension(square(), &dimension));
  EXPECT_NEAR(dimension, 2, 1e-14);
  FAILS(ifsm_system_similarity_dimension(named("fern"), &dimension), IFSM_ERROR_SHAPE, "system");
  EXPECT_EQ(last_error().index, 1);  // map 0 turns and shrinks

  ifsm_dimension_report report{};
  report.struct_size = sizeof report;
  const Doubles rows = all_of<double>([&](double* to, int64_t room, int64_t* told) {
    return ifsm_system_box_dimension(square(), 7, &report, to, room, told);
  });
  ASSERT_EQ(rows.size(), 14U);
  EXPECT_EQ(report.scales, 7);
  for (std::size_t k = 0; k < 7; ++k) {
    EXPECT_NEAR(rows[2 * k], std::ldexp(1, -static_cast<int>(k) - 1), 1e-9) << k;
    EXPECT_EQ(rows[2 * k + 1], std::ldexp(1, 2 * static_cast<int>(k) + 2)) << k;  // all of them
  }
  EXPECT_NEAR(report.dimension, 2, 1e-9);
  EXPECT_NEAR(report.r_squared, 1, 1e-12);
  WORKS(ifsm_system_box_dimension(gasket(), 0, &report, nullptr, 0, &count));
  EXPECT_EQ(count, 20);  // 10 scales in the plane
  EXPECT_NEAR(report.dimension, std::log2(3), .05);
  double room[40];
  FAILS(ifsm_system_box_dimension(gasket(), 5, &report, room, 40, &count), IFSM_ERROR_RANGE, "finest");
  FAILS(ifsm_system_box_dimension(named("sponge"), 10, &report, room, 40, &count), IFSM_ERROR_RANGE, "finest");
  FAILS(ifsm_system_box_dimension(origin(), 6, &report, room, 40, &count), IFSM_ERROR_SHAPE, "system");
}

TEST_F(Systems, ComeBackFromFilesBitForBit) {
  const ifsm_system system = of({.1, 1. / 3, .3, -.4, .5, -.6, 0, 0, 7e-300, 0, .25, 8}, {.3, .6});
  for (const int32_t format : {IFSM_FORMAT_JSON, IFSM_FORMAT_CBOR, IFSM_FORMAT_FRACTINT}) {
    const auto bytes = all_of<uint8_t>([&](uint8_t* to, int64_t room, int64_t* told) {
      return ifsm_system_save(system, format, "of two maps", to, room, told);
    });
    ifsm_system back{};
    WORKS(ifsm_system_load(bytes.data(), static_cast<int64_t>(bytes.size()), nullptr, &back));
    keep(back);
    EXPECT_EQ(maps_of(back), maps_of(system)) << format;
    EXPECT_EQ(probabilities_of(back), probabilities_of(system)) << format;
    const auto names = all_of<uint8_t>([&](uint8_t* to, int64_t room, int64_t* told) {
      return ifsm_system_file_names(bytes.data(), static_cast<int64_t>(bytes.size()), to, room, told);
    });
    const std::string told(names.begin(), names.end());
    EXPECT_EQ(told, format == IFSM_FORMAT_FRACTINT ? "of_two_maps\n" : "\n") << format;
  }
}

TEST_F(Systems, AreChosenByNameFromAFileOfSeveral) {
  const std::string text = "one { .5 0 0 .5 1 2 1 }\ntwo { .25 0 0 .25 0 0 .5\n 0 .5 .5 0 3 4 .5 }\n";
  const auto* bytes = reinterpret_cast<const uint8_t*>(text.data());
  const auto size = static_cast<int64_t>(text.size());
  ifsm_system system{};
  WORKS(ifsm_system_load(bytes, size, "two", &system));
  keep(system);
  EXPECT_EQ(maps_of(system), (Doubles{.25, 0, 0, 0, .25, 0, 0, .5, 3, .5, 0, 4}));
  uint8_t names[16];
  WORKS(ifsm_system_file_names(bytes, size, names, 16, &count));
  EXPECT_EQ(std::string(names, names + count), "one\ntwo\n");
  system = {};
  FAILS(ifsm_system_load(bytes, size, nullptr, &system), IFSM_ERROR_RANGE, "name");
  EXPECT_NE(std::string(last_error().message).find("\"one\""), std::string::npos) << last_error().message;
  FAILS(ifsm_system_load(bytes, size, "three", &system), IFSM_ERROR_RANGE, "name");
  FAILS(ifsm_system_load(bytes, size - 5, "two", &system), IFSM_ERROR_FORMAT, "bytes");
  FAILS(ifsm_system_load(bytes, 0, nullptr, &system), IFSM_ERROR_FORMAT, "bytes");
  EXPECT_EQ(system.id, 0U);
}

// The point at a parameter of the model's limit is the point of that parameter's address.
TEST_F(Systems, AreModelsOfTheirOwnLimitAndBack) {
  ifsm_filter filter{};
  WORKS(ifsm_filter_named("koch", IFSM_TOPOLOGY_JOINED, 0, 0, &filter));
  const Doubles triangle = {0, 0, .5, std::sqrt(3.) / 6, 1, 0};
  const ifsm_curve polygon = curve_of(triangle);
  ifsm_model model{};
  WORKS(ifsm_model_from_polygon(filter, &polygon, 3, &model));
  ifsm_system system{};
  WORKS(ifsm_system_from_model(model, &system));
  keep(system);
  const ifsm_system_info info = info_of(system);
  EXPECT_EQ(info.maps, 4);
  for (const double p : probabilities_of(system)) EXPECT_EQ(p, .25);
  double dimension = 0;
  WORKS(ifsm_system_similarity_dimension(system, &dimension));
  EXPECT_NEAR(dimension, std::log(4) / std::log(3), 1e-12);

  ifsm_model again{};
  WORKS(ifsm_model_from_system(system, IFSM_TOPOLOGY_JOINED, nullptr, 3, &again));
  for (const ifsm_model each : {model, again}) {
    const double parameters[] = {1. / 4 + 3. / 16, .9};  // 1 3 0 0 …
    double at[4];
    WORKS(ifsm_model_evaluate(each, IFSM_CURVE_LIMIT, parameters, 2, at, 4, &count));
    const Doubles point = point_of(system, {1, 3, 0}, 1);
    EXPECT_NEAR(at[0], point[0], 1e-12);
    EXPECT_NEAR(at[1], point[1], 1e-12);
  }
  WORKS(ifsm_model_from_system(gasket(), IFSM_TOPOLOGY_SQUARE, &polygon, 4, &again));
  Doubles told(6);
  WORKS(ifsm_model_control_points(again, told.data(), 6, &count));
  for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(told[k], triangle[k], 1e-12);

  // The gasket's pieces are no chain, as they stand: map 0 ends where map 1 does not begin.
  FAILS(ifsm_model_from_system(gasket(), IFSM_TOPOLOGY_JOINED, nullptr, 3, &again), IFSM_ERROR_SHAPE, "system");
  EXPECT_EQ(last_error().index, 1);
  const Doubles line = {0, 0, 1, 1, 2, 2};
  const ifsm_curve flat = curve_of(line), closed = curve_of(triangle, 2, 1);
  FAILS(ifsm_model_from_system(gasket(), IFSM_TOPOLOGY_SQUARE, &flat, 3, &again), IFSM_ERROR_SINGULAR, "polygon");
  FAILS(ifsm_model_from_system(gasket(), IFSM_TOPOLOGY_SQUARE, &closed, 3, &again), IFSM_ERROR_RANGE, "closed");
  FAILS(ifsm_model_from_system(origin(), IFSM_TOPOLOGY_SQUARE, nullptr, 3, &again), IFSM_ERROR_RANGE, "system");
  ifsm_filter wide{};
  WORKS(ifsm_filter_named("casteljau", IFSM_TOPOLOGY_JOINED, 4, 2, &wide));
  const Doubles four = {0, 0, 1, 1, 2, 0, 3, 1};
  const ifsm_curve cubic = curve_of(four);
  ifsm_model other{};
  WORKS(ifsm_model_from_polygon(wide, &cubic, 2, &other));
  FAILS(ifsm_system_from_model(other, &system), IFSM_ERROR_SHAPE, "model");
}

}  // namespace
