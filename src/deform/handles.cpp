#include "deform/handles.h"

#include <algorithm>
#include <utility>

namespace ifsm::core {

Handles::Handles(const Shape& shape, bool closed, int level)
    : level_(level),
      maps_(shape.maps()),
      points_(shape.control_points()),
      step_(shape.joined() ? shape.polygon_step() : shape.stride()),
      nodes_(shape.nodes(level)),
      count_(shape.places(level, closed)) {}

std::vector<Seat> Handles::seats(Index handle) const {
  std::vector<Seat> seats;
  // Polygon q reads the places q step … q step + n - 1, counted on round a ring.
  const Index end = (nodes_ - 1) * step_ + points_;
  for (Index place = handle; place < end; place += count_) {
    const Index last = std::min(place / step_, nodes_ - 1);
    for (Index node = std::max<Index>(0, (place - points_ + step_) / step_); node <= last; ++node)
      if (place - node * step_ < points_) seats.push_back({node, static_cast<int>(place - node * step_)});
  }
  std::ranges::sort(seats, {}, [](const Seat& seat) { return std::pair(seat.node, seat.point); });
  return seats;
}

Handles::Holder Handles::holder(Index handle) const {
  const std::vector<Seat> all = seats(handle);
  Index first = all.front().node, last = all.back().node;
  int level = level_;
  while (level > 0 && (level == level_ || first != last)) first /= maps_, last /= maps_, --level;
  return {level, first};
}

Index Handles::handle(const Seat& seat) const { return (seat.node * step_ + seat.point) % count_; }

Handles::Run Handles::held_by(Index first, Index last) const {
  return {first * step_ % count_, std::min(count_, (last - first) * step_ + points_)};
}

}  // namespace ifsm::core
