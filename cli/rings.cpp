#include "rings.h"

#include <algorithm>
#include <map>
#include <utility>

#include <ifsm.hpp>

#include "csv.h"
#include "projection.h"
#include "report.h"

namespace cli {
namespace {

constexpr std::size_t most_notes = 5;  // of a kind; more are counted

// The first two coordinates.
std::vector<double> seen_from_above(const GeoCurve& curve) {
  std::vector<double> points;
  const auto d = static_cast<std::size_t>(curve.dimension);
  for (std::size_t i = 0; i < curve.points.size(); i += d)
    points.insert(points.end(), {curve.points[i], curve.points[i + 1]});
  return points;
}

std::vector<ifsm::Crossing> crossings_of(const std::vector<double>& points) {
  const auto straight = ifsm::Filter::named("casteljau", ifsm::Topology::joined, 2, 2);
  try {
    return ifsm::Model(straight, ifsm::Curve(points, 2, true)).crossings();
  } catch (const ifsm::Error&) {
    return {};  // too far from unit size, say: the fit tells it better
  }
}

// Even-odd: how often a ray to the right meets the ring.
bool is_inside(double x, double y, const std::vector<double>& ring) {
  bool inside = false;
  for (std::size_t i = 0, before = ring.size() - 2; i < ring.size(); before = i, i += 2) {
    const double x0 = ring[before], y0 = ring[before + 1], x1 = ring[i], y1 = ring[i + 1];
    if ((y0 > y) != (y1 > y) && x < x0 + (y - y0) / (y1 - y0) * (x1 - x0)) inside = !inside;
  }
  return inside;
}

bool are_apart(const std::vector<double>& ring, const std::vector<double>& other, std::size_t axis) {
  const auto ends = [axis](const std::vector<double>& points) {
    double low = points[axis], high = low;
    for (std::size_t i = axis; i < points.size(); i += 2)
      low = std::min(low, points[i]), high = std::max(high, points[i]);
    return std::pair(low, high);
  };
  const auto [low, high] = ends(ring);
  const auto [other_low, other_high] = ends(other);
  return high < other_low || other_high < low;
}

// By one of its points that is no point of the other ring; holes may touch.
bool is_within(const std::vector<double>& ring, const std::vector<double>& other) {
  if (are_apart(ring, other, 0) || are_apart(ring, other, 1)) return false;
  for (std::size_t i = 0; i < ring.size(); i += 2) {
    bool shared = false;
    for (std::size_t k = 0; k < other.size() && !shared; k += 2)
      shared = other[k] == ring[i] && other[k + 1] == ring[i + 1];
    if (!shared) return is_inside(ring[i], ring[i + 1], other);
  }
  return true;
}

class Notes {
 public:
  explicit Notes(std::string source) : source_(std::move(source)) {}

  void say(const std::string& place, const std::string& what) {
    if (++count_ <= most_notes) all_.push_back(source_ + ", " + place + ": " + what + "; it is read as it is.");
  }
  std::vector<std::string> all() && {
    if (count_ > most_notes)
      all_.push_back(source_ + ": " + counted(count_ - most_notes, "more ring") + " with such faults.");
    return std::move(all_);
  }

 private:
  std::string source_;
  std::vector<std::string> all_;
  std::size_t count_ = 0;
};

// "…coordinates[0]" of "…coordinates[0][2]": the polygon that a ring is of.
std::string polygon_of(const std::string& place) { return place.substr(0, place.rfind('[')); }

}  // namespace

std::vector<std::string> notes_on_rings(const std::vector<GeoCurve>& curves, const std::string& source, bool degrees) {
  Notes notes(source);
  std::map<std::string, std::vector<std::vector<double>>> polygons;  // their rings so far, the shell first
  for (const GeoCurve& curve : curves) {
    if (!curve.ring) continue;
    auto points = seen_from_above(curve);
    if (degrees) unwrap(points, 2);
    if (const auto crossings = crossings_of(points); !crossings.empty())
      notes.say(curve.place, "this ring meets itself in " + counted(crossings.size(), "place") + ", first at " +
                                 rounded(crossings[0].x) + ", " + rounded(crossings[0].y));
    auto& rings = polygons[polygon_of(curve.place)];
    if (!rings.empty() && !is_within(points, rings[0])) notes.say(curve.place, "this hole lies outside its polygon");
    for (std::size_t k = 1; k < rings.size(); ++k)
      if (is_within(points, rings[k]) || is_within(rings[k], points)) {
        notes.say(curve.place, "this hole and another one of its polygon overlap");
        break;
      }
    rings.push_back(std::move(points));
  }
  return std::move(notes).all();
}

}  // namespace cli
