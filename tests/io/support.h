// Models to write and files to damage.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <random>
#include <string>

#include "curve/keep.h"
#include "curve/named.h"
#include "curve/resolve.h"
#include "io/model_reader.h"
#include "io/model_writer.h"

namespace ifsm::core::test {

inline Bytes bytes_of(const std::string& text) { return {text.begin(), text.end()}; }
inline std::string text_of(const Bytes& bytes) { return {bytes.begin(), bytes.end()}; }

// What reading complains about; nothing when it does not.
inline std::optional<Error> complaint(const Bytes& bytes) {
  try {
    read_model(bytes);
  } catch (const Error& error) {
    return error;
  }
  return {};
}

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  int integer(int low, int high) { return std::uniform_int_distribution<int>(low, high)(engine_); }
  bool flag() { return integer(0, 1) == 1; }
  double number() { return std::normal_distribution<double>()(engine_); }

  // Any finite double, by its bits: denormal, negative zero, enormous.
  double any_number() {
    while (true) {
      const double value = integer(0, 7) == 0 ? -0.0 : std::bit_cast<double>(engine_());
      if (std::isfinite(value)) return value;
    }
  }

  template <class Make>
  Points points(Index dimension, Index count, const Make& make) {
    Points points(dimension, count);
    for (Index axis = 0; axis < dimension; ++axis)
      for (double& value : points.plane(axis)) value = make();
    return points;
  }

 private:
  std::mt19937_64 engine_;
};

// de Casteljau's filter, its interior columns moved by vectors of sum zero, its details scaled: entries of full length.
inline FilterPtr random_filter(Random& random) {
  const Topology topology = random.flag() ? Topology::joined : Topology::square;
  const int n = random.integer(2, 6), maps = random.integer(2, 4);
  const FilterPtr plain = named_filter("casteljau", topology, n, maps);
  RowMatrix matrix = plain->matrix();
  for (Index c = 1; c + 1 < matrix.cols(); ++c) {
    const double moved = random.number() / 64;
    matrix(0, c) += moved, matrix(1, c) -= moved;
  }
  matrix.bottomRows(plain->shape().details_per_node()) *= std::exp(random.number());
  const int stride = topology == Topology::joined ? 0 : random.integer(1, n);
  return std::make_shared<Filter>(Shape(topology, n, maps, stride), matrix);
}

inline ModelPtr random_model(Random& random) {
  const FilterPtr filter = random_filter(random);
  const bool closed = random.flag();
  const Index count = random.integer(2, 80);
  const Points samples = random.points(random.integer(1, 4), count, [&] { return 1e6 + random.number(); });
  const int needed = filter->shape().levels_for(count, closed);
  const ModelPtr model = analyze(filter, samples, closed, needed + random.integer(0, 1));
  if (random.flag()) return model;
  const Kept kept = most_significant(*model, std::min<Index>(random.integer(0, 12), model->details_total()));
  return random.flag() ? keep(*model, kept) : resolve(*model, kept, Watch());
}

// Details of any bits whatever, most of them zero or none.
inline ModelPtr wild_model(Random& random) {
  const FilterPtr filter = random_filter(random);
  const Shape& shape = filter->shape();
  ModelParts parts;
  parts.filter = filter;
  const Index dimension = random.integer(1, 4);
  const int levels = random.integer(0, 3);
  parts.samples = shape.places(levels, false);
  for (Index axis = 0; axis < dimension; ++axis) parts.center.push_back(random.any_number());
  parts.polygon = random.points(dimension, shape.control_points(), [&] { return random.any_number(); });
  parts.diagonal = std::abs(random.any_number());
  parts.largest_polygon = std::abs(random.any_number());
  for (int level = 0; level < levels; ++level) {
    const int zeros = random.integer(0, 16);
    parts.details.push_back(std::make_shared<Points>(random.points(dimension, shape.detail_count(level), [&] {
      return random.integer(0, 16) < zeros ? 0.0 : random.any_number();
    })));
  }
  return std::make_shared<Model>(std::move(parts));
}

inline bool same_bits(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }

inline bool same_bits(const Points& a, const Points& b) {
  if (a.dimension() != b.dimension() || a.count() != b.count()) return false;
  for (Index axis = 0; axis < a.dimension(); ++axis)
    for (Index i = 0; i < a.count(); ++i)
      if (!same_bits(a.matrix()(i, axis), b.matrix()(i, axis))) return false;
  return true;
}

inline bool same_bits(const RowMatrix& a, const RowMatrix& b) {
  return a.size() == b.size() &&
         std::equal(a.data(), a.data() + a.size(), b.data(), [](double x, double y) { return same_bits(x, y); });
}

inline bool same_bits(const Model& a, const Model& b) {
  const ModelParts &p = a.parts(), &q = b.parts();
  bool same = a.shape() == b.shape() && same_bits(a.filter().matrix(), b.filter().matrix()) && p.closed == q.closed &&
              p.samples == q.samples && p.center.size() == q.center.size() && same_bits(p.polygon, q.polygon) &&
              same_bits(p.diagonal, q.diagonal) && same_bits(p.largest_polygon, q.largest_polygon) &&
              a.levels() == b.levels();
  for (std::size_t axis = 0; same && axis < p.center.size(); ++axis) same = same_bits(p.center[axis], q.center[axis]);
  for (int level = 0; same && level < a.levels(); ++level) same = same_bits(a.details(level), b.details(level));
  return same;
}

}  // namespace ifsm::core::test
