#include "measure/crossings.h"

#include <numeric>
#include <set>
#include <tuple>

#include "support.h"

using namespace ifsm::core;
using namespace ifsm::core::testing;

namespace {

using Whole = std::int64_t;
struct Spot {
  Whole x, y;
  friend bool operator==(const Spot&, const Spot&) = default;
};

Whole cross(Spot a, Spot b, Spot c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

// A fraction in lowest terms.
std::pair<Whole, Whole> fraction(Whole above, Whole below) {
  const Whole common = std::gcd(above, below) * (below < 0 ? -1 : 1);
  return {above / common, below / common};
}

// segment p, segment q, and where within each the meeting begins and ends: all of it in whole numbers.
using Meeting = std::tuple<Index, Index, std::pair<Whole, Whole>, std::pair<Whole, Whole>, std::pair<Whole, Whole>,
                           std::pair<Whole, Whole>>;

// How far along a → b a point of its line is.
std::pair<Whole, Whole> share(Spot a, Spot b, Spot x) {
  return b.x != a.x ? fraction(x.x - a.x, b.x - a.x) : fraction(x.y - a.y, b.y - a.y);
}

bool less(std::pair<Whole, Whole> a, std::pair<Whole, Whole> b) { return a.first * b.second < b.first * a.second; }

// Straight from the definition, for points without repeats, in rational arithmetic: solves for both shares.
std::set<Meeting> meetings(const std::vector<Spot>& points, bool closed) {
  std::set<Meeting> all;
  const auto count = static_cast<Index>(points.size());
  const Index segments = closed ? count : count - 1;
  const std::pair<Whole, Whole> zero{0, 1}, one{1, 1};
  for (Index p = 0; p < segments; ++p)
    for (Index q = p + 1; q < segments; ++q) {
      const Spot a = points[static_cast<std::size_t>(p)], b = points[static_cast<std::size_t>((p + 1) % count)];
      const Spot c = points[static_cast<std::size_t>(q)], d = points[static_cast<std::size_t>((q + 1) % count)];
      const bool neighbours = q == p + 1 || (closed && p == 0 && q == segments - 1);
      const bool owns_p = !closed && p == segments - 1, owns_q = !closed && q == segments - 1;
      const Whole turn = (b.x - a.x) * (d.y - c.y) - (b.y - a.y) * (d.x - c.x);
      if (turn != 0) {
        const auto s = fraction((c.x - a.x) * (d.y - c.y) - (c.y - a.y) * (d.x - c.x), turn);
        const auto t = fraction((c.x - a.x) * (b.y - a.y) - (c.y - a.y) * (b.x - a.x), turn);
        const bool in_p = !less(s, zero) && (less(s, one) || (owns_p && s == one));
        const bool in_q = !less(t, zero) && (less(t, one) || (owns_q && t == one));
        if (in_p && in_q && !neighbours) all.insert({p, q, s, t, s, t});
        continue;
      }
      if (cross(a, b, c) != 0) continue;
      auto from = share(a, b, c), to = share(a, b, d);
      if (less(to, from)) std::swap(from, to);
      if (less(from, zero)) from = zero;
      if (less(one, to)) to = one;
      if (less(to, from)) continue;
      // Where that is on q: the shares are affine images of each other.
      const auto on_q = [&](std::pair<Whole, Whole> s) {
        const Whole n = s.first, m = s.second;
        return b.x != a.x ? fraction((a.x - c.x) * m + n * (b.x - a.x), m * (d.x - c.x))
                          : fraction((a.y - c.y) * m + n * (b.y - a.y), m * (d.y - c.y));
      };
      if (less(from, to)) {
        all.insert({p, q, from, on_q(from), to, on_q(to)});
      } else if (!neighbours) {
        const auto t = on_q(from);
        if ((less(from, one) || owns_p) && (less(t, one) || owns_q)) all.insert({p, q, from, t, from, t});
      }
    }
  return all;
}

Points as_points(const std::vector<Spot>& spots) {
  Points points(2, static_cast<Index>(spots.size()));
  for (std::size_t k = 0; k < spots.size(); ++k) {
    points.matrix()(static_cast<Index>(k), 0) = static_cast<double>(spots[k].x);
    points.matrix()(static_cast<Index>(k), 1) = static_cast<double>(spots[k].y);
  }
  return points;
}

double parameter_of(const Polyline& polyline, Index segment, std::pair<Whole, Whole> within) {
  return polyline.parameter(segment, static_cast<double>(within.first) / static_cast<double>(within.second));
}

void expect_the_meetings(const std::vector<Spot>& spots, bool closed, const std::string& what) {
  const Polyline polyline(as_points(spots), closed);
  const std::set<Meeting> wanted = meetings(spots, closed);
  const std::vector<Crossing> found = crossings(polyline);
  ASSERT_EQ(found.size(), wanted.size()) << what;
  auto each = found.begin();
  for (const auto& [p, q, s0, t0, s1, t1] : wanted) {
    // Each share is a quotient of numbers that are right to a few roundings, and so is the parameter.
    EXPECT_NEAR(each->first_p, parameter_of(polyline, p, s0), 8 * epsilon) << what;
    EXPECT_NEAR(each->first_q, parameter_of(polyline, q, t0), 8 * epsilon) << what;
    EXPECT_NEAR(each->last_p, parameter_of(polyline, p, s1), 8 * epsilon) << what;
    EXPECT_NEAR(each->last_q, parameter_of(polyline, q, t1), 8 * epsilon) << what;
    const Spot a = spots[static_cast<std::size_t>(p)], b = spots[(static_cast<std::size_t>(p) + 1) % spots.size()];
    const double s = static_cast<double>(s0.first) / static_cast<double>(s0.second);
    const double size = static_cast<double>(std::abs(a.x) + std::abs(b.x) + std::abs(a.y) + std::abs(b.y));
    EXPECT_NEAR(each->point[0], static_cast<double>(a.x) + s * static_cast<double>(b.x - a.x), 8 * epsilon * size);
    EXPECT_NEAR(each->point[1], static_cast<double>(a.y) + s * static_cast<double>(b.y - a.y), 8 * epsilon * size);
    ++each;
  }
}

// Small grids, so that touching, passing through points, and overlapping happen all the time.
TEST(Crossings, AreThoseOfRationalArithmeticOnGrids) {
  Random random(1);
  std::size_t overlaps = 0, touches = 0, all = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const Whole reach = std::vector<Whole>{1, 2, 4, 100, 1000000}[static_cast<std::size_t>(trial % 5)];
    const Index count = uniform(random, 2, trial % 7 == 0 ? 60 : 12);
    const bool closed = trial % 2 == 0;
    std::vector<Spot> spots;
    while (static_cast<Index>(spots.size()) < count) {
      const Spot next{uniform(random, -reach, reach), uniform(random, -reach, reach)};
      if (!spots.empty() && (next == spots.back() || next == spots.front())) continue;  // its own test below
      spots.push_back(next);
    }
    const std::string what = "trial " + std::to_string(trial);
    expect_the_meetings(spots, closed, what);
    if (HasFailure()) FAIL() << what;
    for (const auto& [p, q, s0, t0, s1, t1] : meetings(spots, closed)) {
      ++all;
      overlaps += s0 != s1;
      touches += s0 == s1 && (s0.first == 0 || t0.first == 0);
    }
  }
  EXPECT_GT(overlaps, 1000U);
  EXPECT_GT(touches, 1000U);
  EXPECT_GT(all, overlaps + touches + 1000U);
}

TEST(Crossings, AreFoundByTheTreeAsByComparingAllPairs) {
  Random random(2);
  for (const Kind kind : all_kinds)
    for (const bool closed : {false, true})
      for (const Index count : {2, 3, 8, 9, 17, 400}) {
        const Polyline polyline(random_curve(random, count, 2, kind), closed);
        EXPECT_EQ(crossings(polyline), plain::crossings(polyline)) << static_cast<int>(kind) << ", " << count;
      }
}

TEST(Crossings, DoNotMindPointsThatAreRepeated) {
  Random random(3);
  for (int trial = 0; trial < 200; ++trial) {
    const bool closed = trial % 2 == 0;
    const Points once = random_curve(random, 40, 2, Kind::walk);
    std::vector<std::vector<double>> rows;
    for (Index k = 0; k < once.count(); ++k)
      for (Index repeats = uniform(random, 1, 3); repeats > 0; --repeats)
        rows.push_back({once.matrix()(k, 0), once.matrix()(k, 1)});
    if (closed) rows.push_back(rows.front());
    const auto wanted = crossings(Polyline(once, closed)), found = crossings(Polyline(points_of(rows), closed));
    ASSERT_EQ(found.size(), wanted.size());
    for (std::size_t k = 0; k < found.size(); ++k) EXPECT_EQ(found[k].point, wanted[k].point);
  }
  EXPECT_TRUE(crossings(Polyline(points_of({{1, 1}, {1, 1}, {1, 1}}), true)).empty());
  EXPECT_TRUE(crossings(Polyline(points_of({{1, 1}}), false)).empty());
}

TEST(Crossings, OfAnEightAreOneAndOfAKochCurveNone) {
  const Polyline eight(points_of({{0, 0}, {2, 2}, {2, 0}, {0, 2}}), true);
  const auto found = crossings(eight);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0], (Crossing{0.125, 0.625, 0.125, 0.625, {1, 1}}));
  EXPECT_TRUE(crossings(Polyline(koch_curve(6), false)).empty());
  EXPECT_TRUE(crossings(Polyline(circle(10000, 1), true)).empty());
}

TEST(Crossings, TellPiecesThatAreGoneTwice) {
  // There and half-way back; on through it once more.
  const auto back = crossings(Polyline(points_of({{0, 0}, {4, 0}, {2, 0}}), false));
  ASSERT_EQ(back.size(), 1U);
  EXPECT_EQ(back[0], (Crossing{0.25, 1, 0.5, 0.5, {2, 0}}));
  // A loop that ends where it began.
  const auto loop = crossings(Polyline(points_of({{0, 0}, {1, 0}, {0, 1}, {0, 0}}), false));
  ASSERT_EQ(loop.size(), 1U);
  EXPECT_EQ(loop[0], (Crossing{0, 1, 0, 1, {0, 0}}));
}

TEST(Crossings, AreWhereTheModelSaysThatBothParametersAre) {
  Random random(4);
  const ModelPtr model =
      analyze(casteljau(Shape(Topology::joined, 4, 2)), random_curve(random, 700, 2, Kind::walk), true);
  const auto found = crossings(Polyline(*model));
  ASSERT_GT(found.size(), 10U);
  for (const Crossing& crossing : found) {
    const double parameters[] = {crossing.first_p, crossing.first_q};
    const Points there = evaluate(*model, Curve::polyline, parameters);
    // A parameter is rounded to eps, the curve is as fast as its places times its longest step.
    const double tolerance = 8 * epsilon * static_cast<double>(model->placement().places()) * 10;
    EXPECT_LE((there.matrix().row(0) - there.matrix().row(1)).norm(), tolerance);
    EXPECT_LT(crossing.first_p, crossing.first_q);
  }
}

TEST(Crossings, AreRefusedOutsideThePlaneAndWhenTheyAreTooMany) {
  for (const Index dimension : {1, 3, 4}) {
    const Error error = refusal([&] { crossings(Polyline(Points(dimension, 5), false)); });
    EXPECT_EQ(error.status(), Status::shape);
  }
  Points comb(2, 6000);  // long strokes up and down, then across all of them, again and again
  for (Index k = 0; k < comb.count(); ++k) {
    const bool up = k < 3000;
    comb.matrix()(k, up ? 0 : 1) = static_cast<double>(k % 3000);
    comb.matrix()(k, up ? 1 : 0) = k % 2 == 0 ? -5 : 3005;
  }
  EXPECT_EQ(refusal([&] { crossings(Polyline(comb, false)); }).status(), Status::limit);
}

}  // namespace
