// Models of all kinds, for the tests of src/deform.
#pragma once

#include <string>
#include <vector>

#include "../curve/support.h"

namespace ifsm::core::testing {

struct Subject {
  FilterPtr filter;
  bool closed;
  Index dimension;
};

inline std::vector<Subject> subjects(Random& random) {
  std::vector<Subject> all;
  for (const bool closed : {false, true})
    for (const auto& [topology, n, maps, stride] : {std::tuple{Topology::joined, 2, 2, 0},
                                                    {Topology::joined, 3, 3, 0},
                                                    {Topology::joined, 5, 2, 0},
                                                    {Topology::square, 3, 2, 2},
                                                    {Topology::square, 4, 2, 1},
                                                    {Topology::square, 4, 3, 4}})
      for (const Index dimension : {1, 2, 3, 4})
        all.push_back({random_filter(Shape(topology, n, maps, stride), random, 0.05), closed, dimension});
  return all;
}

inline std::string name(const Model& m) {
  std::ostringstream out;
  out << m.shape() << (m.closed() ? " closed" : " open") << " d=" << m.dimension() << " levels=" << m.levels();
  return out.str();
}

inline ModelPtr rough(const Subject& s, Random& random, Index samples = 80) {
  return analyze(s.filter, random_curve(random, samples, s.dimension, Kind::walk), s.closed);
}

}  // namespace ifsm::core::testing
