#include "rings.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include <ifsm.hpp>

#include "csv.h"
#include "projection.h"
#include "report.h"

namespace cli {
namespace {

constexpr std::size_t most_notes = 5;  // more are counted

struct Box {
  double low[2], high[2];
};

struct Ring {
  std::string place;
  std::string polygon, shape;  // where those are that it belongs to; a Polygon is its own shape
  std::vector<double> points;  // x y x y …, seen from above
  Box box;

  std::size_t count() const { return points.size() / 2; }
};

using Pair = std::pair<std::size_t, std::size_t>;  // of rings, the smaller number first

// "…coordinates[0]" of "…coordinates[0][2]"; "…coordinates" stays.
std::string without_index(const std::string& place) {
  return place.ends_with(']') ? place.substr(0, place.rfind('[')) : place;
}

std::vector<double> seen_from_above(const GeoCurve& curve) {
  std::vector<double> points;
  const auto d = static_cast<std::size_t>(curve.dimension);
  for (std::size_t i = 0; i < curve.points.size(); i += d)
    points.insert(points.end(), {curve.points[i], curve.points[i + 1]});
  return points;
}

Box box_of(const std::vector<double>& points) {
  Box box{{points[0], points[1]}, {points[0], points[1]}};
  for (std::size_t i = 0; i < points.size(); ++i) {
    box.low[i % 2] = std::min(box.low[i % 2], points[i]);
    box.high[i % 2] = std::max(box.high[i % 2], points[i]);
  }
  return box;
}

bool is_within(const Box& box, const Box& other) {
  return box.low[0] >= other.low[0] && box.low[1] >= other.low[1] && box.high[0] <= other.high[0] &&
         box.high[1] <= other.high[1];
}

bool are_apart(const Box& box, const Box& other) {
  return box.high[0] < other.low[0] || box.high[1] < other.low[1] || other.high[0] < box.low[0] ||
         other.high[1] < box.low[1];
}

// Each in one piece, and those of a shape by the same whole turns.
std::vector<Ring> rings_of(const std::vector<GeoCurve>& curves, bool degrees) {
  std::vector<Ring> rings;
  std::map<std::string, double> middles;
  for (const GeoCurve& curve : curves) {
    if (!curve.ring) continue;
    const std::string polygon = without_index(curve.place);
    Ring ring{curve.place, polygon, without_index(polygon), seen_from_above(curve), {}};
    if (degrees) {
      unwrap(ring.points, 2);
      const Box box = box_of(ring.points);
      const double middle = (box.low[0] + box.high[0]) / 2;
      const double turns = std::round((middles.try_emplace(ring.shape, middle).first->second - middle) / 360);
      for (std::size_t i = 0; i < ring.points.size(); i += 2) ring.points[i] += 360 * turns;
    }
    ring.box = box_of(ring.points);
    rings.push_back(std::move(ring));
  }
  return rings;
}

// Where rings meet, themselves and each other. All are laid out in one line, so that the tree of one question finds
// them; the steps from ring to ring are passed over.
class Meetings {
 public:
  explicit Meetings(const std::vector<Ring>& rings) {
    std::vector<double> line;
    for (const Ring& ring : rings) {
      starts_.push_back(line.size() / 2);
      line.insert(line.end(), ring.points.begin(), ring.points.end());
      line.insert(line.end(), {ring.points[0], ring.points[1]});
    }
    if (line.empty()) return;
    const std::size_t used = line.size() / 2;
    // 2^k + 1 points: then the places of a model are its samples, and parameters count them.
    const std::size_t steps = std::bit_ceil(used);
    for (std::size_t k = used; k <= steps; ++k) line.insert(line.end(), {line[2 * used - 2], line[2 * used - 1]});
    const auto straight = ifsm::Filter::named("casteljau", ifsm::Topology::joined, 2, 2);
    try {
      for (const auto& crossing : ifsm::Model(straight, ifsm::Curve(line, 2)).crossings())
        take(crossing, static_cast<double>(steps), rings);
    } catch (const ifsm::Error&) {  // too far from unit size, say: the fit tells it better
    }
  }

  struct OfOne {
    std::size_t count = 0;
    double x = 0, y = 0;  // of the first
  };
  OfOne own(std::size_t ring) const {
    const auto found = own_.find(ring);
    return found == own_.end() ? OfOne{} : found->second;
  }
  bool meet(Pair rings) const { return met_.contains(rings); }
  // Through each other's edges.
  bool cross(Pair rings) const { return crossed_.contains(rings); }

 private:
  struct Foot {
    std::size_t ring;
    bool joint;  // on a step to the next ring
    bool inner;  // of an edge
  };
  Foot foot(double parameter, double steps, const std::vector<Ring>& rings) const {
    constexpr double at_a_point = 1e-6;  // of an edge; a model's places are rounded
    const double position = parameter * steps, within = position - std::floor(position);
    const auto edge = static_cast<std::size_t>(position);
    const auto ring = static_cast<std::size_t>(std::ranges::upper_bound(starts_, edge) - starts_.begin()) - 1;
    return {ring, edge - starts_[ring] >= rings[ring].count(), within > at_a_point && within < 1 - at_a_point};
  }

  void take(const ifsm::Crossing& crossing, double steps, const std::vector<Ring>& rings) {
    const Foot a = foot(crossing.first_p, steps, rings), b = foot(crossing.first_q, steps, rings);
    if (a.joint || b.joint) return;
    if (a.ring == b.ring) {
      if (OfOne& own = own_[a.ring]; ++own.count == 1) own.x = crossing.x, own.y = crossing.y;
      return;
    }
    const Pair pair = std::minmax(a.ring, b.ring);
    met_.insert(pair);
    if (a.inner && b.inner) crossed_.insert(pair);
  }

  std::vector<std::size_t> starts_;
  std::map<std::size_t, OfOne> own_;
  std::set<Pair> met_, crossed_;
};

// Even-odd: how often a ray to the right meets the ring.
bool is_inside(const double* point, const Ring& ring) {
  const double x = point[0], y = point[1];
  bool inside = false;
  const auto& p = ring.points;
  for (std::size_t i = 0, before = p.size() - 2; i < p.size(); before = i, i += 2)
    if ((p[before + 1] > y) != (p[i + 1] > y) &&
        x < p[before] + (y - p[before + 1]) / (p[i + 1] - p[before + 1]) * (p[i] - p[before]))
      inside = !inside;
  return inside;
}

// On an edge, as far as rounding tells.
bool is_on(const double* point, const Ring& ring) {
  constexpr double rounding = 1e-12;  // of the edge's length
  const auto& p = ring.points;
  for (std::size_t i = 0, before = p.size() - 2; i < p.size(); before = i, i += 2) {
    const double x = p[i] - p[before], y = p[i + 1] - p[before + 1];
    const double to_x = point[0] - p[before], to_y = point[1] - p[before + 1];
    const double square = x * x + y * y, along = x * to_x + y * to_y;
    if (along >= -rounding * square && along <= (1 + rounding) * square &&
        std::abs(x * to_y - y * to_x) <= rounding * square)
      return true;
  }
  return false;
}

// Its points and the middles of its edges.
std::vector<double> probes(const Ring& ring) {
  std::vector<double> all;
  const auto& p = ring.points;
  for (std::size_t i = 0, before = p.size() - 2; i < p.size(); before = i, i += 2)
    all.insert(all.end(), {p[i], p[i + 1], (p[before] + p[i]) / 2, (p[before + 1] + p[i + 1]) / 2});
  return all;
}

enum class Side { Outside, Across, Inside };

// Where a ring lies with respect to another one; touching does not count, and a ring along the whole of the other is
// across it. Where they do not meet, any point tells.
Side side_of(const Ring& ring, const Ring& other, bool meet, bool cross) {
  if (cross) return Side::Across;
  if (!meet)
    return is_within(ring.box, other.box) && is_inside(ring.points.data(), other) ? Side::Inside : Side::Outside;
  bool inside = false, outside = false;
  const std::vector<double> all = probes(ring);
  for (std::size_t i = 0; i < all.size() && !(inside && outside); i += 2)
    if (!is_on(&all[i], other)) (is_inside(&all[i], other) ? inside : outside) = true;
  return inside == outside ? Side::Across : inside ? Side::Inside : Side::Outside;
}

class Notes {
 public:
  explicit Notes(std::string source) : source_(std::move(source)) {}

  void say(const Ring& ring, const std::string& what) {
    if (++count_ <= most_notes) all_.push_back(source_ + ", " + ring.place + ": " + what + "; it is read as it is.");
  }
  std::vector<std::string> all() && {
    if (count_ > most_notes)
      all_.push_back(source_ + ": " + counted(count_ - most_notes, "more fault") + " of rings like these.");
    return std::move(all_);
  }

 private:
  std::string source_;
  std::vector<std::string> all_;
  std::size_t count_ = 0;
};

class Judge {
 public:
  Judge(const std::vector<Ring>& rings, Notes& notes) : rings_(rings), meetings_(rings), notes_(notes) {}

  void look_at_each() {
    for (std::size_t k = 0; k < rings_.size(); ++k) {
      const auto [shell, is_shell] = shells_.try_emplace(rings_[k].polygon, k);
      look_at(k);
      if (is_shell) continue;
      auto& others = holes_[rings_[k].polygon];
      look_at_hole(k, shell->second, others);
      others.push_back(k);
    }
    std::map<std::string, std::vector<std::size_t>> shapes;  // their shells so far
    for (std::size_t k = 0; k < rings_.size(); ++k) {
      if (shells_[rings_[k].polygon] != k) continue;
      auto& others = shapes[rings_[k].shape];
      look_at_shell(k, others);
      others.push_back(k);
    }
  }

 private:
  Side side(std::size_t ring, std::size_t other) const {
    const Pair pair = std::minmax(ring, other);
    return side_of(rings_[ring], rings_[other], meetings_.meet(pair), meetings_.cross(pair));
  }
  bool overlap(std::size_t ring, std::size_t other) const {
    if (are_apart(rings_[ring].box, rings_[other].box)) return false;
    return side(ring, other) != Side::Outside || side(other, ring) != Side::Outside;
  }

  void look_at(std::size_t ring) {
    const auto own = meetings_.own(ring);
    if (own.count > 0)
      notes_.say(rings_[ring], "this ring meets itself in " + counted(own.count, "place") + ", first at " +
                                   rounded(own.x) + ", " + rounded(own.y));
  }

  void look_at_hole(std::size_t hole, std::size_t shell, const std::vector<std::size_t>& others) {
    const Side to_shell = side(hole, shell);
    if (to_shell == Side::Outside) notes_.say(rings_[hole], "this hole lies outside its polygon");
    if (to_shell == Side::Across || (to_shell == Side::Inside && side(shell, hole) == Side::Across))
      notes_.say(rings_[hole], "this hole does not lie within its polygon, or only in part");
    if (std::ranges::any_of(others, [&](std::size_t other) { return overlap(hole, other); }))
      notes_.say(rings_[hole], "this hole and another one of its polygon overlap");
  }

  // An island in a lake is no fault.
  void look_at_shell(std::size_t shell, const std::vector<std::size_t>& others) {
    const auto faulty = [&](std::size_t other) {
      return overlap(shell, other) && !is_in_a_hole(shell, other) && !is_in_a_hole(other, shell);
    };
    if (std::ranges::any_of(others, faulty))
      notes_.say(rings_[shell], "this polygon and another one of its MultiPolygon overlap");
  }

  bool is_in_a_hole(std::size_t ring, std::size_t shell) const {
    const auto holes = holes_.find(rings_[shell].polygon);
    return holes != holes_.end() &&
           std::ranges::any_of(holes->second, [&](std::size_t hole) { return side(ring, hole) == Side::Inside; });
  }

  const std::vector<Ring>& rings_;
  Meetings meetings_;
  Notes& notes_;
  std::map<std::string, std::size_t> shells_;              // of polygons
  std::map<std::string, std::vector<std::size_t>> holes_;  // of polygons
};

}  // namespace

std::vector<std::string> notes_on_rings(const std::vector<GeoCurve>& curves, const std::string& source, bool degrees) {
  const std::vector<Ring> rings = rings_of(curves, degrees);
  Notes notes(source);
  Judge(rings, notes).look_at_each();
  return std::move(notes).all();
}

}  // namespace cli
