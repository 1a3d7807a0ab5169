#include "measure/texture.h"

#include <algorithm>
#include <cmath>

#include "linalg/trend.h"

namespace ifsm::core {
namespace {

// Sums over the segments of a scale.
struct Moments {
  Eigen::MatrixXd along, across;
  Index segments = 0;

  double trace(Index dimension) const { return along.trace() + static_cast<double>(dimension - 1) * across.trace(); }
};

// Segments of maps · step places. The finest scale, step 1, is learnt from where all places are known.
Moments moments(const Points& places, const std::vector<char>& known, int maps, Index step) {
  const Index d = places.dimension(), inner = maps - 1, length = step * maps;
  Moments sum{Eigen::MatrixXd::Zero(inner, inner), Eigen::MatrixXd::Zero(inner, inner)};
  for (Index first = 0; first + length < places.count(); first += length) {
    const auto within = known.begin() + first;
    if (step == 1 && std::count(within, within + length, char{0}) > 0) continue;
    const Direction a = places.matrix().row(first), way = places.matrix().row(first + length) - a;
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 7, 4> off(inner, d);  // never allocates
    for (Index i = 0; i < inner; ++i)
      off.row(i) = places.matrix().row(first + (i + 1) * step) - a -
                   (static_cast<double>(i + 1) / static_cast<double>(maps)) * way;
    sum.segments += 1;
    const Direction direction = direction_of(way);
    const Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 7, 1> forward = off * direction.transpose();
    sum.along += forward * forward.transpose();
    if (d == 1) continue;
    off -= forward * direction;  // what is left goes sideways
    sum.across += off * off.transpose() / static_cast<double>(d - 1);
  }
  return sum;
}

}  // namespace

Direction direction_of(const Direction& way) {
  const double length = way.stableNorm();
  return length > 0 && way.size() > 1 ? Direction(way / length) : Direction(Direction::Unit(way.size(), 0));
}

Texture learn(const Points& places, const std::vector<char>& known, int maps, int levels, int scales) {
  const Index inner = maps - 1;
  Texture texture{Eigen::MatrixXd::Zero(inner, inner), Eigen::MatrixXd::Zero(inner, inner), 1.0 / maps, 0};
  std::vector<double> scale, mean_square;
  Index step = 1;
  for (int above = 1; above <= std::min(scales, levels); ++above, step *= maps) {
    const Moments found = moments(places, known, maps, step);
    const double trace = found.trace(places.dimension()), segments = static_cast<double>(found.segments);
    if (!(trace > 0)) continue;
    texture.along += found.along / trace;
    texture.across += found.across / trace;
    scale.push_back(-above);
    mean_square.push_back(std::log(trace / segments));
  }
  if (scale.empty()) return texture;
  texture.along /= static_cast<double>(scale.size());
  texture.across /= static_cast<double>(scale.size());
  double slope = std::log(texture.decay), at_next = mean_square.front() - slope * scale.front();
  if (scale.size() >= 3) {
    const Trend line = trend(scale, mean_square);
    slope = std::min(line.slope, 0.0);  // finer displacements are never larger
    at_next = line.intercept;
  }
  texture.decay = std::exp(slope);
  texture.next = std::exp(at_next);
  return texture;
}

}  // namespace ifsm::core
