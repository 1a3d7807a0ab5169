#include "system/named.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.h"

namespace ifsm::core {
namespace {

struct Code {
  std::vector<Affine> maps;
  std::vector<double> weights;
};
using Complex = std::complex<double>;
using Places = std::vector<Vector3>;

constexpr double third = 1. / 3, sixth = 1. / 6;
// Parts of the square root of 3, which equilateral triangles are made of.
constexpr double root_quarter = 0.4330127018922193, root_sixth = 0.28867513459481287, root_third = 0.5773502691896257;
constexpr double pi = std::numbers::pi;

// Of rows a b c d e f, or a b c d e f p: x' = a x + b y + e, y' = c x + d y + f.
template <std::size_t width>
Code plane(const std::vector<std::array<double, width>>& rows) {
  Code code;
  for (const auto& r : rows) {
    Affine map;
    map.linear.topLeftCorner<2, 2>() << r[0], r[1], r[2], r[3];
    map.shift << r[4], r[5], 0;
    code.maps.push_back(map);
    if constexpr (width == 7) code.weights.push_back(r[6]);
  }
  return code;
}
Code plane6(const std::vector<std::array<double, 6>>& rows) { return plane(rows); }
Code plane7(const std::vector<std::array<double, 7>>& rows) { return plane(rows); }

// Rows of M, then t, then p.
Code space(const std::vector<std::array<double, 13>>& rows) {
  Code code;
  for (const auto& r : rows) {
    Affine map;
    map.linear << r[0], r[1], r[2], r[3], r[4], r[5], r[6], r[7], r[8];
    map.shift << r[9], r[10], r[11];
    code.maps.push_back(map);
    code.weights.push_back(r[12]);
  }
  return code;
}

// z → factor z + shift.
Affine similar(Complex factor, Complex shift) {
  Affine map;
  map.linear.topLeftCorner<2, 2>() << factor.real(), -factor.imag(), factor.imag(), factor.real();
  map.shift << shift.real(), shift.imag(), 0;
  return map;
}
Code similar(const std::vector<std::pair<Complex, Complex>>& maps) {
  Code code;
  for (const auto& [factor, shift] : maps) code.maps.push_back(similar(factor, shift));
  return code;
}

// x → scale x + place.
Code copies(int dimension, double scale, const Places& places) {
  Code code;
  for (const Vector3& place : places) {
    Affine map = Affine::identity(dimension);
    map.linear *= scale;
    map.shift = place;
    code.maps.push_back(map);
  }
  return code;
}

// The cells of an n-fold grid over the unit square or cube that are kept.
template <class Keep>
Code grid(int dimension, int n, const Keep& keep) {
  Places places;
  for (int z = 0; z < (dimension == 3 ? n : 1); ++z)
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x)
        if (keep(x, y, z)) places.emplace_back(Vector3(x, y, z) / n);
  return copies(dimension, 1. / n, places);
}

// Copies about the corners of a regular polygon of circumradius 1, and one in the middle.
Code polygon(int corners, double scale, double first_angle, bool middle) {
  Places places;
  if (middle) places.push_back(Vector3::Zero());
  for (int k = 0; k < corners; ++k) {
    const Complex at = std::polar(1 - scale, first_angle + 2 * pi * k / corners);
    places.emplace_back(at.real(), at.imag(), 0);
  }
  return copies(2, scale, places);
}

Code towards(const Places& corners) {
  Places places;
  for (const Vector3& corner : corners) places.emplace_back(corner / 2);
  return copies(3, .5, places);
}

Code koch_snowflake() {
  Code code = copies(2, 1. / 3, {});
  code.maps.push_back(similar(std::polar(1 / std::sqrt(3.0), pi / 6), 0));
  for (int k = 0; k < 6; ++k) code.maps.push_back(similar(1. / 3, std::polar(2. / 3, pi / 6 + pi * k / 3)));
  return code;
}

// The island of Gosper's flowsnake: seven copies of itself, as a tile.
Code gosper_island() {
  const Complex factor = 1. / Complex(2.5, std::sqrt(3.0) / 2);
  Code code;
  code.maps.push_back(similar(factor, 0));
  for (int k = 0; k < 6; ++k) code.maps.push_back(similar(factor, factor * std::polar(1.0, pi * k / 3)));
  return code;
}

struct Known {
  NamedSystem named;
  Code (*code)();
};

const std::vector<Known>& known() {
  constexpr std::string_view classic = "classic", bourke = "P. Bourke's collection of IFS codes";
  static const std::vector<Known> all = {
      // The papers'.
      {{"fern_barnsley", "paper 003, Fig. 5; Barnsley's probabilities", 2},
       [] {
         return plane7({{.85, .04, -.04, .85, 0, 1.6, .85},
                        {.2, -.26, .23, .22, 0, 1.6, .07},
                        {-.15, .28, .26, .24, 0, .44, .07},
                        {0, 0, 0, .16, 0, 0, .01}});
       }},
      {{"gasket_right", "paper 003, Fig. 2a", 2},
       [] {
         return plane6({{.5, 0, 0, .5, 0, 0}, {.5, 0, 0, .5, .5, 0}, {.5, 0, 0, .5, 0, .5}});
       }},
      {{"gasket_right_overlapping", "paper 003, Fig. 2b", 2},
       [] {
         return plane6({{.55, 0, 0, .55, 0, 0}, {.55, 0, 0, .55, .45, 0}, {.55, 0, 0, .55, 0, .45}});
       }},
      {{"gasket_equilateral", classic, 2},
       [] {
         return plane6({{.5, 0, 0, .5, 0, 0}, {.5, 0, 0, .5, .5, 0}, {.5, 0, 0, .5, .25, root_quarter}});
       }},
      {{"gasket_rotated_lower_left", "paper 000, Fig. 3 and 4; it prints no numbers", 2},
       [] {
         return plane6({{-.5, 0, 0, -.5, .5, root_quarter}, {.5, 0, 0, .5, .5, 0}, {.5, 0, 0, .5, .25, root_quarter}});
       }},
      {{"twin_dragon", "paper 003, Fig. 6", 2},
       [] {
         return plane6({{.5, .5, -.5, .5, -.5, .375}, {.5, .5, -.5, .5, .5, .625}});
       }},
      {{"terdragon", classic, 2},
       [] {
         return plane6({{.5, -root_sixth, root_sixth, .5, 0, 0},
                        {0, root_third, -root_third, 0, .5, root_sixth},
                        {.5, -root_sixth, root_sixth, .5, .5, -root_sixth}});
       }},
      {{"koch_curve", classic, 2},
       [] {
         return plane6({{third, 0, 0, third, 0, 0},
                        {sixth, -root_sixth, root_sixth, sixth, third, 0},
                        {sixth, root_sixth, -root_sixth, sixth, .5, root_sixth},
                        {third, 0, 0, third, 2. / 3, 0}});
       }},
      {{"fern_type1_unordered", "paper 004, Table 1 (not in a family)", 2},
       [] {
         return plane7({{.85, -.1, .1, .85, 0, .1, .72},
                        {-.15, .14, .14, .15, 0, .2, .12},
                        {.15, -.14, .14, .15, 0, .15, .12},
                        {.01, 0, 0, .2, 0, 0, .04}});
       }},
      {{"fern_type1", "paper 004, Table 2 (in a family)", 2},
       [] {
         return plane7({{.85, -.1, .1, .85, 0, .1, .72},
                        {.15, -.14, .14, .15, 0, .15, .12},
                        {-.15, .14, .14, .15, 0, .2, .12},
                        {.01, 0, 0, .2, 0, 0, .04}});
       }},
      {{"fern_type2", "paper 004, Tables 1 and 2", 2},
       [] {
         return plane7({{.74, -.11, .11, .74, 0, .2, .72},
                        {.23, -.11, .11, .23, 0, .1, .12},
                        {-.23, .11, .11, .23, 0, .15, .12},
                        {.01, 0, 0, .3, 0, 0, .04}});
       }},
      {{"fern_type2_large", "paper 004, Table 3", 2},
       [] {
         return plane7({{.74, -.11, .11, .74, 0, 2, .72},
                        {.23, -.11, .11, .23, 0, 1, .12},
                        {-.23, .11, .11, .23, 0, 1.5, .12},
                        {.01, 0, 0, .3, 0, 0, .04}});
       }},
      {{"tree_type1", "paper 004, Table 3", 2},
       [] {
         return plane7({{.49, -.075, .075, .49, 0, 2, .5},
                        {.45, -.217, .217, .45, 0, 1, .24},
                        {-.45, .217, .217, .45, 0, 1.5, .24},
                        {.05, -.003, .003, .6, 0, 0, .02}});
       }},
      {{"tree_type1_with_dummy", "paper 004, Table 4 (the fourth map is a dummy)", 2},
       [] {
         return plane7({{.49, -.075, .075, .49, 0, 2, .5},
                        {.45, -.217, .217, .45, 0, 1, .24},
                        {-.45, .217, .217, .45, 0, 1.5, .24},
                        {-.49, .075, .075, .49, 0, 1.8, 0},
                        {.05, -.003, .003, .6, 0, 0, .02}});
       }},
      {{"tree_type2", "paper 004, Table 4", 2},
       [] {
         return plane7({{.48, -.124, .124, .48, 0, 2, .25},
                        {.45, -.217, .217, .45, 0, 1, .24},
                        {-.45, .217, .217, .45, 0, .8, .24},
                        {-.48, .124, .124, .48, 0, 1.8, .24},
                        {.05, -.003, .003, .6, 0, 0, .03}});
       }},
      // Classics of the plane.
      {{"cantor_set", "Cantor 1883; on the x axis", 2},
       [] {
         return plane6({{third, 0, 0, 0, 0, 0}, {third, 0, 0, 0, 2. / 3, 0}});
       }},
      {{"cantor_dust", "Cantor's set times itself", 2},
       [] { return grid(2, 3, [](int x, int y, int) { return x != 1 && y != 1; }); }},
      {{"carpet", "Sierpinski 1916", 2}, [] { return grid(2, 3, [](int x, int y, int) { return x != 1 || y != 1; }); }},
      {{"vicsek", "Vicsek 1983", 2}, [] { return grid(2, 3, [](int x, int y, int) { return x == 1 || y == 1; }); }},
      {{"vicsek_saltire", "Vicsek's, along the diagonals", 2},
       [] { return grid(2, 3, [](int x, int y, int) { return (x == 1) == (y == 1); }); }},
      {{"heighway_dragon", "Heighway 1966; Gardner 1967", 2},
       [] {
         return similar({{{.5, .5}, 0}, {{-.5, .5}, 1}});
       }},
      {{"levy_curve", "Levy 1938", 2},
       [] {
         return similar({{{.5, .5}, 0}, {{.5, -.5}, {.5, .5}}});
       }},
      {{"koch_snowflake", "von Koch 1904; filled, of seven copies", 2}, koch_snowflake},
      {{"gosper_island", "Gosper; Mandelbrot 1977", 2}, gosper_island},
      {{"hexaflake", classic, 2}, [] { return polygon(6, 1. / 3, 0, true); }},
      {{"pentagon_gasket", classic, 2}, [] { return polygon(5, (3 - std::sqrt(5.0)) / 2, pi / 2, false); }},
      {{"pentaflake", "Duerer 1525", 2},
       [] {
         Code code = polygon(5, (3 - std::sqrt(5.0)) / 2, pi / 2, true);
         code.maps[0].linear *= -1;  // the one in the middle stands on its head
         return code;
       }},
      {{"minkowski_sausage", "Minkowski; Mandelbrot 1977", 2},
       [] {
         const Complex s = .25, up = {0, .25}, down = {0, -.25};
         return similar({{s, 0},
                         {up, .25},
                         {s, {.25, .25}},
                         {down, {.5, .25}},
                         {down, .5},
                         {s, {.5, -.25}},
                         {up, {.75, -.25}},
                         {s, .75}});
       }},
      {{"maple_leaf", bourke, 2},
       [] {
         return plane7({{.14, .01, 0, .51, -.08, -1.31, .1},
                        {.43, .52, -.45, .5, 1.49, -.75, .35},
                        {.45, -.49, .47, .47, -1.62, -.74, .35},
                        {.49, 0, 0, .51, .02, 1.62, .2}});
       }},
      {{"fern_cyclosorus", bourke, 2},
       [] {
         return plane7({{0, 0, 0, .25, 0, -.4, .02},
                        {.95, .005, -.005, .93, -.002, .5, .84},
                        {.035, -.2, .16, .04, -.09, .02, .07},
                        {-.04, .2, .16, .04, .083, .12, .07}});
       }},
      {{"spiral", "Fractint, fractint.ifs", 2},
       [] {
         return plane7({{.787879, -.424242, .242424, .859848, 1.758647, 1.408065, .9},
                        {-.121212, .257576, .151515, .05303, -6.721654, 1.377236, .05},
                        {.181818, -.136364, .090909, .181818, 6.086107, 1.568035, .05}});
       }},
      // Of space.
      {{"menger_sponge", "Menger 1926", 3},
       [] { return grid(3, 3, [](int x, int y, int z) { return (x == 1) + (y == 1) + (z == 1) < 2; }); }},
      {{"cantor_dust_3d", "Cantor's set, three times", 3},
       [] { return grid(3, 3, [](int x, int y, int z) { return x != 1 && y != 1 && z != 1; }); }},
      {{"tetrahedron", "Sierpinski's gasket in space", 3},
       [] {
         return towards({{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}});
       }},
      {{"octahedron", "the octahedron's gasket", 3},
       [] {
         return towards({{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}});
       }},
      {{"fern_3d", "Barnsley; Fractint, fractint.ifs", 3},
       [] {
         return space({{0, 0, 0, 0, .18, 0, 0, 0, 0, 0, 0, 0, .01},
                       {.85, 0, 0, 0, .85, .1, 0, -.1, .85, 0, 1.6, 0, .85},
                       {.2, -.2, 0, .2, .2, 0, 0, 0, .3, 0, .8, 0, .07},
                       {-.2, .2, 0, .2, .2, 0, 0, 0, .3, 0, .8, 0, .07}});
       }},
  };
  return all;
}

constexpr std::pair<std::string_view, std::string_view> aliases[] = {
    {"fern", "fern_barnsley"}, {"gasket", "gasket_equilateral"}, {"dragon", "heighway_dragon"}, {"koch", "koch_curve"},
    {"levy", "levy_curve"},    {"snowflake", "koch_snowflake"},  {"sponge", "menger_sponge"}};

}  // namespace

std::span<const NamedSystem> named_systems() {
  static const std::vector<NamedSystem> names = [] {
    std::vector<NamedSystem> all;
    for (const Known& each : known()) all.push_back(each.named);
    return all;
  }();
  return names;
}

namespace {

// Letters to put in, leave out or change until one is the other (Levenshtein's distance).
std::size_t edits_between(std::string_view from, std::string_view to) {
  std::vector<std::size_t> edits(to.size() + 1);  // from the letters of `from` so far to the first k of `to`
  std::iota(edits.begin(), edits.end(), std::size_t{0});
  for (std::size_t row = 1; row <= from.size(); ++row) {
    std::size_t diagonal = std::exchange(edits[0], row);
    for (std::size_t k = 1; k <= to.size(); ++k) {
      const std::size_t changed = diagonal + (from[row - 1] == to[k - 1] ? 0 : 1);
      diagonal = std::exchange(edits[k], std::min({edits[k] + 1, edits[k - 1] + 1, changed}));
    }
  }
  return edits.back();
}

// A name that may have been meant: " Did you mean fern?", or nothing.
std::string suggestion(std::string_view wanted) {
  constexpr std::size_t longest = 64;
  if (wanted.size() > longest) return "";
  std::string_view nearest;
  std::size_t least = wanted.size() / 4 + 2;  // of so many it is another word
  const auto compare = [&](std::string_view name) {
    const std::size_t edits = edits_between(wanted, name);
    if (edits < least) least = edits, nearest = name;
  };
  for (const auto& [alias, meant] : aliases) compare(alias);
  for (const Known& each : known()) compare(each.named.name);
  return nearest.empty() ? "" : " Did you mean " + std::string(nearest) + "?";
}

}  // namespace

SystemPtr named_system(std::string_view name) {
  std::string wanted(name);
  std::replace(wanted.begin(), wanted.end(), '-', '_');
  for (const auto& [alias, meant] : aliases)
    if (wanted == alias) wanted = meant;
  for (const Known& each : known()) {
    if (each.named.name != wanted) continue;
    Code code = each.code();
    return std::make_shared<System>(each.named.dimension, std::move(code.maps), std::move(code.weights));
  }
  std::string names;
  for (const Known& each : known()) names += (names.empty() ? "" : ", ") + std::string(each.named.name);
  std::string shorts;
  for (const auto& [alias, meant] : aliases) shorts += (shorts.empty() ? "" : ", ") + std::string(alias);
  throw Error(Status::range, "name",
              "There is no system \"" + std::string(name) + "\"." + suggestion(wanted) + " There are " + names +
                  "; for short " + shorts + ".");
}

}  // namespace ifsm::core
