#include "measure/refine.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/cancel.h"
#include "base/parallel.h"
#include "base/random.h"
#include "linalg/spectrum.h"

namespace ifsm::core {
namespace {

// A row for each inner place of a segment: at most maps - 1 = 7, of at most four coordinates and one number more. They
// never allocate.
using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 7, 5>;
using Shares = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 7, 1>;

// Numbers of one segment: independent of all others, whatever the order.
Rows normal_matrix(Index rows, Index columns, std::uint64_t seed, std::uint32_t stream, Index segment) {
  Rows numbers(rows, columns);
  const Index pairs = (numbers.size() + 1) / 2;
  for (Index k = 0; k < pairs; ++k) {
    const auto two = normal_pair(seed, stream, static_cast<std::uint64_t>(segment * pairs + k));
    numbers(2 * k) = two[0];
    if (2 * k + 1 < numbers.size()) numbers(2 * k + 1) = two[1];
  }
  return numbers;
}

// Which places hold samples; a ring's first one again at the end.
std::vector<char> places_of_samples(const Model& model, Index count) {
  std::vector<char> known(static_cast<std::size_t>(count), char{0});
  const Placement& placement = model.placement();
  for (Index k = 0; k < placement.samples(); ++k) known[static_cast<std::size_t>(placement.place(k))] = 1;
  if (model.closed()) known.back() = 1;
  return known;
}

class Displacements {
 public:
  Displacements(const Texture& texture, const Refinement& asked)
      : asked_(asked),
        along_(square_root(texture.along).transpose()),
        across_(square_root(texture.across).transpose()) {}

  // Of the inner places of a segment that goes `way`; `size`: the root of their mean square, all together.
  Rows operator()(const Direction& way, double size, int level, Index segment) const {
    const double length = way.stableNorm();
    if (!(size > 0)) return Rows::Zero(along_.rows(), way.size());
    const Direction direction = direction_of(way);
    constexpr int attempts = 16;
    for (int attempt = 0;; ++attempt) {
      Rows off = asked_.roughness * size * drawn(direction, stream(level, attempt), segment);
      if (way.size() == 1 || in_order(off * direction.transpose() / length)) return off;
      if (attempt == attempts) return Rows::Zero(along_.rows(), way.size());
    }
  }

 private:
  static std::uint32_t stream(int level, int attempt) { return static_cast<std::uint32_t>(level + 64 * attempt); }

  Rows drawn(const Direction& direction, std::uint32_t stream, Index segment) const {
    const Index d = direction.size();
    // The first column goes along the segment. In the plane the second goes to its left, so that a curve that is turned
    // has the same texture, turned; in space d more make a vector of which what is across is taken.
    const Rows numbers = normal_matrix(along_.rows(), d > 2 ? d + 1 : d, asked_.seed, stream, segment);
    const Rows forward = along_ * numbers.col(0) * direction;
    if (d == 1) return forward;
    if (d == 2) return forward + across_ * numbers.col(1) * Eigen::RowVector2d(-direction(1), direction(0));
    const Rows any = across_ * numbers.rightCols(d);
    return forward + any - (any * direction.transpose()) * direction;
  }

  // Do the inner places, moved forward by these shares of the segment, still come one after the other between its ends?
  static bool in_order(const Shares& moved) {
    double last = 0;
    const auto maps = static_cast<double>(moved.size() + 1);
    for (Index i = 0; i < moved.size(); ++i) {
      const double here = static_cast<double>(i + 1) / maps + moved(i);
      if (!(here > last)) return false;
      last = here;
    }
    return last < 1;
  }

  const Refinement& asked_;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 7, 7> along_, across_;  // square roots
};

double root_mean_square(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value * value / static_cast<double>(values.size());
  return std::sqrt(sum);
}

// How large the displacements of a scale are, segment by segment, when their mean square is `expected`: in proportion
// to the segments' lengths, up to the root mean square of these. In one dimension a segment is a step of a profile,
// whose height tells nothing of its roughness: there all are alike.
class Sizes {
 public:
  // Segments that hold `step` places each.
  Sizes(const Points& places, Index step, double expected)
      : same_(places.dimension() == 1), all_(std::sqrt(expected)), most_(0), weight_(0) {
    std::vector<double> lengths;
    Polled polled;
    for (Index k = 0; k + step < places.count(); k += step) {
      polled.step();
      lengths.push_back((places.matrix().row(k + step) - places.matrix().row(k)).stableNorm());
    }
    most_ = root_mean_square(lengths);
    for (double& length : lengths) length = std::min(length, most_);
    weight_ = root_mean_square(lengths);
  }

  double of(const Direction& way) const {
    if (same_) return all_;
    return weight_ > 0 ? all_ * std::min(way.stableNorm(), most_) / weight_ : 0.0;
  }

 private:
  bool same_;
  double all_, most_, weight_;
};

// Places that were filled in where `maps` steps lie between two samples: a segment of the scale above.
void fill_gaps(Points& places, const std::vector<char>& known, const Texture& texture,
               const Displacements& displacements, int maps) {
  const Sizes sizes(places, maps, texture.next / texture.decay);
  Index last = 0;
  Polled polled;
  for (Index place = 1; place < places.count(); ++place) {
    polled.step();
    if (known[static_cast<std::size_t>(place)] == 0) continue;
    if (place - last == maps) {
      const Direction way = places.matrix().row(place) - places.matrix().row(last);
      places.matrix().middleRows(last + 1, maps - 1) += displacements(way, sizes.of(way), 0, last);
    }
    last = place;
  }
}

// One level more: every segment gets maps - 1 inner places.
Points subdivided(const Points& coarse, const Sizes& sizes, int level, const Displacements& displacements, int maps) {
  const Index segments = coarse.count() - 1;
  Points fine(coarse.dimension(), segments * maps + 1);
  fine.matrix().row(segments * maps) = coarse.matrix().row(segments);
  constexpr Index chunk = 1024;
  parallel_for((segments + chunk - 1) / chunk, 0, [&](Index part) {
    for (Index s = part * chunk; s < std::min((part + 1) * chunk, segments); ++s) {
      const Direction a = coarse.matrix().row(s), way = coarse.matrix().row(s + 1) - a;
      const Rows off = displacements(way, sizes.of(way), level, s);
      fine.matrix().row(s * maps) = a;
      for (Index i = 1; i < maps; ++i)
        fine.matrix().row(s * maps + i) =
            a + (static_cast<double>(i) / static_cast<double>(maps)) * way + off.row(i - 1);
    }
  });
  return fine;
}

void require_refinement(const Model& model, const Refinement& asked) {
  if (!model.shape().joined())
    throw Error(Status::shape, "model",
                "A square model's places do not lie among those of finer levels; make a joined model of its samples.");
  in_range(asked.levels, 1, 40, "levels");
  in_range(asked.learned, 1, 40, "learned");
  require_finite(asked.roughness, "roughness");
  if (!(asked.roughness >= 0))
    throw Error(Status::range, "roughness",
                "roughness is " + text_of(asked.roughness) + "; give a factor that is not negative.")
        .with(asked.roughness);
  model.shape().require_memory(model.shape().checked_levels(model.levels() + asked.levels), model.dimension());
}

}  // namespace

ModelPtr refine(const Model& model, const Refinement& asked) {
  require_refinement(model, asked);
  const int maps = model.shape().maps();
  // From the centre, in units of a power of two near the diagonal: squares neither overflow nor vanish, and samples
  // keep their bits.
  const double diagonal = model.parts().diagonal, unit = diagonal > 0 ? std::ldexp(1.0, std::ilogb(diagonal)) : 1.0;
  Points places = line(model, model.levels());
  places.matrix() /= unit;
  const std::vector<char> known = places_of_samples(model, places.count());
  const Texture texture = learn(places, known, maps, model.levels(), asked.learned);
  const Displacements displacements(texture, asked);
  fill_gaps(places, known, texture, displacements, maps);

  double expected = texture.next;
  for (int level = 1; level <= asked.levels; ++level, expected *= texture.decay)
    places = subdivided(places, Sizes(places, 1, expected), level, displacements, maps);
  if (model.closed()) {  // a ring is told without its first point again
    Points once(places.dimension(), places.count() - 1);
    once.matrix() = places.matrix().topRows(once.count());
    places = std::move(once);
  }
  places.matrix() *= unit;
  places = from_center(std::move(places), model.parts().center);
  return analyze(model.parts().filter, places, model.closed(), model.levels() + asked.levels);
}

}  // namespace ifsm::core
