#include "deform/falloff.h"

#include <algorithm>
#include <numeric>

namespace ifsm::core {
namespace {

double weight(Falloff falloff, double t) {
  if (t >= 1) return 0;
  return falloff == Falloff::linear ? 1 - t : (1 - t * t) * (1 - t * t);
}

// Where handles are along the ruler, and where a ring closes.
std::vector<double> positions(const Points& places, bool closed, Ruler ruler) {
  const Index count = places.count();
  std::vector<double> at(static_cast<std::size_t>(count) + 1);
  for (Index k = 0; k < count; ++k) {
    const bool edge = closed || k + 1 < count;
    const auto step = places.matrix().row((k + 1) % count) - places.matrix().row(k);
    at[static_cast<std::size_t>(k) + 1] = at[static_cast<std::size_t>(k)] + (ruler == Ruler::handles ? 1.0
                                                                             : edge                  ? step.norm()
                                                                                                     : 0.0);
  }
  return at;
}

}  // namespace

std::map<Index, Vector> spread_by_falloff(const std::map<Index, Vector>& moved, const Points& places, bool closed,
                                          Falloff falloff, Ruler ruler, double radius) {
  if (falloff == Falloff::none) return moved;
  const std::vector<double> at = positions(places, closed, ruler);
  const Index count = places.count();
  std::map<Index, Vector> sums;
  std::map<Index, double> weights;
  const auto follow = [&](Index handle, const Vector& by, double distance) {
    const double w = weight(falloff, distance / radius);
    if (!(w > 0)) return false;
    const auto [sum, fresh] = sums.try_emplace(handle, Vector::Zero(by.size()));
    sum->second += w * by;
    weights[handle] += w;
    return true;
  };
  for (const auto& [handle, by] : moved) {
    const double here = at[static_cast<std::size_t>(handle)], round = at.back();
    // Both ways as far as the radius reaches, and round a ring once at most.
    for (const Index way : {1, -1})
      for (Index step = way == 1 ? 0 : 1; step < (closed ? (count + way) / 2 + 1 : count); ++step) {
        Index other = handle + way * step;
        double distance = 0;
        if (closed) {
          const bool passes = other < 0 || other >= count;
          other = (other + count) % count;
          distance = std::abs(at[static_cast<std::size_t>(other)] - here);
          if (passes) distance = round - distance;
        } else {
          if (other < 0 || other >= count) break;
          distance = std::abs(at[static_cast<std::size_t>(other)] - here);
        }
        if (!follow(other, by, distance)) break;
      }
  }
  for (auto& [handle, sum] : sums) sum /= std::max(1.0, weights[handle]);
  for (const auto& [handle, by] : moved) sums[handle] = by;
  return sums;
}

}  // namespace ifsm::core
