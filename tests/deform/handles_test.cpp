#include "deform/handles.h"

#include <algorithm>

#include "../curve/support.h"

using namespace ifsm::core;
using namespace ifsm::core::testing;

namespace {

std::vector<Shape> shapes() {
  std::vector<Shape> all;
  for (const int n : {2, 3, 5})
    for (const int maps : {2, 3}) {
      all.emplace_back(Topology::joined, n, maps);
      for (const int stride : {1, n - 1, n}) all.emplace_back(Topology::square, n, maps, stride);
    }
  all.emplace_back(Topology::square, 1, 2);
  return all;
}

// Every point of every polygon is a seat of the place that it reads, and no handle has another.
TEST(Handles, HaveTheSeatsThatReadThem) {
  for (const Shape& shape : shapes())
    for (const bool closed : {false, true})
      for (int level = 0; level <= 3; ++level) {
        const Handles handles(shape, closed, level);
        ASSERT_EQ(handles.count(), shape.places(level, closed));
        // Places, told by their own numbers.
        Points numbers(1, handles.count());
        for (Index k = 0; k < handles.count(); ++k) numbers.plane(0)[static_cast<std::size_t>(k)] = double(k);
        const Points line = read(shape, closed, numbers, level);
        std::vector<std::vector<Seat>> wanted(static_cast<std::size_t>(handles.count()));
        for (Index node = 0; node < shape.nodes(level); ++node)
          for (int c = 0; c < shape.control_points(); ++c) {
            const auto value = static_cast<std::size_t>(node * shape.polygon_step() + c);
            const auto handle = static_cast<Index>(line.plane(0)[value]);
            wanted[static_cast<std::size_t>(handle)].push_back({node, c});
            EXPECT_EQ(handles.handle({node, c}), handle) << shape << " node " << node << " point " << c;
          }
        for (Index k = 0; k < handles.count(); ++k)
          EXPECT_EQ(handles.seats(k), wanted[static_cast<std::size_t>(k)])
              << shape << (closed ? " closed" : "") << " level " << level << " handle " << k;
      }
}

TEST(Handles, AreHeldByTheFinestNodeAboveAllTheirSeats) {
  for (const Shape& shape : shapes())
    for (const bool closed : {false, true})
      for (int level = 1; level <= 3; ++level) {
        const Handles handles(shape, closed, level);
        for (Index k = 0; k < handles.count(); ++k) {
          const auto holder = handles.holder(k);
          ASSERT_LT(holder.level, level);
          const auto holds = [&](int at, Index node) {
            const Index below = shape.nodes(level - at);
            return std::ranges::all_of(handles.seats(k), [&](const Seat& s) { return s.node / below == node; });
          };
          EXPECT_TRUE(holds(holder.level, holder.node));
          for (Index finer = 0; holder.level + 1 < level && finer < shape.nodes(holder.level + 1); ++finer)
            EXPECT_FALSE(holds(holder.level + 1, finer)) << shape << " level " << level << " handle " << k;
        }
      }
}

TEST(Handles, OfARunOfNodesAreThoseWithASeatThere) {
  for (const Shape& shape : shapes())
    for (const bool closed : {false, true})
      for (int level = 0; level <= 3; ++level) {
        const Handles handles(shape, closed, level);
        for (Index first = 0; first < shape.nodes(level); ++first)
          for (Index last = first; last < shape.nodes(level); ++last) {
            const auto run = handles.held_by(first, last);
            for (Index k = 0; k < handles.count(); ++k) {
              const bool in_run = (k - run.first + handles.count()) % handles.count() < run.count;
              const bool seated = std::ranges::any_of(handles.seats(k),
                                                      [&](const Seat& s) { return s.node >= first && s.node <= last; });
              ASSERT_TRUE(in_run || !seated) << shape << " nodes " << first << "-" << last << " handle " << k;
              if (shape.joined() || shape.stride() <= shape.control_points()) {
                ASSERT_EQ(in_run, seated) << shape << " nodes " << first << "-" << last << " handle " << k;
              }
            }
          }
      }
}

}  // namespace
