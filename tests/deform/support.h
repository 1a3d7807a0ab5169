// Models of all kinds, for the tests of src/deform.
#pragma once

#include <string>
#include <vector>

#include "../curve/support.h"
#include "deform/deformer.h"

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

inline Points vectors(Random& random, Index count, Index dimension) {
  return points_from(Matrix::NullaryExpr(count, dimension, [&] { return normal(random); }));
}

inline Move move(int level, std::vector<Index> handles, Points by, Reach reach = Reach::nodes) {
  Move edit;
  edit.level = level;
  edit.handles = std::move(handles);
  edit.vectors = std::move(by);
  edit.reach = reach;
  return edit;
}

inline Points all(const Deformer& deformer) {
  const int finest = deformer.model().levels();
  return deformer.now().places(finest, 0, deformer.now().count(finest));
}

inline Drag drag(int level, std::vector<double> parameters, Points places, Lead lead) {
  Drag edit;
  edit.level = level;
  edit.parameters = std::move(parameters);
  edit.places = std::move(places);
  edit.lead = lead;
  return edit;
}

// Any edit, of any kind.
inline Edit any_edit(const Deformer& deformer, Random& random) {
  const Model& model = deformer.model();
  const auto levels = [&] {
    const int first = static_cast<int>(uniform(random, 0, model.levels() - 1));
    return Levels{first, static_cast<int>(uniform(random, first, model.levels() - 1)),
                  static_cast<int>(uniform(random, 0, 2))};
  };
  switch (uniform(random, 0, 5)) {
    case 5: {
      const double t = std::uniform_real_distribution<double>()(random);
      Points place = deformer.now().at({t});
      place.matrix() += 0.05 * vectors(random, 1, model.dimension()).matrix();
      return drag(static_cast<int>(uniform(random, 0, std::min(3, model.levels() - 1))), {t}, place, Lead::details);
    }
    case 0: return Restyle{levels(), 1 + 0.3 * normal(random), model.dimension() > 1 ? 0.2 : 0.0, -1};
    case 1: return Texture{levels(), nullptr, 0.7, 0, 5};
    case 2: return move(0, {uniform(random, 0, deformer.now().count(0) - 1)}, vectors(random, 1, model.dimension()));
    default: {
      const int level = static_cast<int>(uniform(random, 1, model.levels()));
      Move edit = move(level, {uniform(random, 0, deformer.now().count(level) - 1)},
                       vectors(random, 1, model.dimension()), uniform(random, 0, 1) ? Reach::nodes : Reach::curve);
      if (uniform(random, 0, 1)) {
        edit.falloff = Falloff::smooth;
        edit.radius = 2.5;
      }
      return edit;
    }
  }
}

}  // namespace ifsm::core::testing
