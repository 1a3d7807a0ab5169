#include "curve/placement.h"

#include <cmath>

namespace ifsm::core {

Placement::Placement(Index samples, Index places, bool closed) : samples_(samples), places_(places), closed_(closed) {}

Index Placement::place(Index sample) const {
  // 2k(g-1) may pass 2^63: samples and places are at most 2^40 each.
  const auto wide = [](Index value) { return static_cast<__int128>(value); };
  if (closed_) return static_cast<Index>(wide(sample) * places_ / samples_);
  if (samples_ == 1) return 0;
  return static_cast<Index>((2 * wide(sample) * (places_ - 1) + samples_ - 1) / (2 * (wide(samples_) - 1)));
}

double Placement::parameter(Index sample) const {
  const Index last = closed_ ? places_ : places_ - 1;
  return last == 0 ? 0.0 : static_cast<double>(place(sample)) / static_cast<double>(last);
}

double Placement::position(double parameter) const {
  const auto last = static_cast<double>(closed_ ? places_ : places_ - 1);
  const double position = (closed_ ? parameter - std::floor(parameter) : parameter) * last;
  const double nearest = std::round(position);
  // place / last * last is off by at most one rounding of each of the two operations.
  const double found = std::abs(position - nearest) <= 2 * 2.220446049250313e-16 * last ? nearest : position;
  return closed_ && found >= last ? 0.0 : found;
}

Placement::Between Placement::between(double parameter) const {
  const double at = position(parameter), first = std::floor(at);
  const auto place = static_cast<Index>(first);
  return {place, (place + 1) % places_, at - first};
}

Points Placement::fill(const Points& samples) const {
  Points filled(samples.dimension(), places_);
  const Index gaps = closed_ ? samples_ : samples_ - 1;
  for (Index axis = 0; axis < samples.dimension(); ++axis) {
    const auto given = samples.plane(axis);
    const auto line = filled.plane(axis);
    line[static_cast<std::size_t>(place(0))] = given[0];
    for (Index k = 0; k < gaps; ++k) {
      const Index from = place(k), to = k + 1 < samples_ ? place(k + 1) : places_;
      const double a = given[static_cast<std::size_t>(k)], b = given[static_cast<std::size_t>((k + 1) % samples_)];
      for (Index p = from; p < to; ++p) {
        const double t = static_cast<double>(p - from) / static_cast<double>(to - from);
        line[static_cast<std::size_t>(p)] = t == 0 ? a : (1 - t) * a + t * b;
      }
      if (k + 1 < samples_) line[static_cast<std::size_t>(to)] = b;
    }
  }
  return filled;
}

Points Placement::pick(const Points& places) const {
  Points picked(places.dimension(), samples_);
  for (Index axis = 0; axis < places.dimension(); ++axis) {
    const auto line = places.plane(axis);
    const auto out = picked.plane(axis);
    for (Index k = 0; k < samples_; ++k) out[static_cast<std::size_t>(k)] = line[static_cast<std::size_t>(place(k))];
  }
  return picked;
}

}  // namespace ifsm::core
