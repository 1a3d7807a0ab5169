#include "fit/foot_points.h"

#include <algorithm>
#include <utility>

namespace ifsm::core {
namespace {

constexpr int steps = 2;          // by sample and sweep; the fit calls again
constexpr int halvings = 6;       // of a step that leads away, until it is given up
constexpr double most_way = 0.9;  // to a neighbour

class Foot {
 public:
  Foot(const Target& target, const Lanes& polyline, Index sample)
      : target_(target), polyline_(polyline), sample_(sample) {}

  double squared(double place) const { return target_.squared(sample_, error(place)); }

  // Where Gauss-Newton sees the nearest point, along the leg that `place` lies on.
  double step(double place) const {
    const Index leg = leg_of(place), d = target_.dimension;
    Eigen::VectorXd along = (polyline_.row(leg + 1) - polyline_.row(leg)).transpose();
    Eigen::VectorXd miss = error(place).transpose();
    if (target_.whitening.rows() > 0) {
      const Lanes whitening = target_.whitening.middleRows(sample_ * d, d);
      along = (whitening * along).eval();
      miss = (whitening * miss).eval();
    }
    const double square = along.squaredNorm();
    return square > 0 ? -along.dot(miss) / square : 0;
  }

 private:
  Index leg_of(double place) const { return std::clamp<Index>(static_cast<Index>(place), 0, polyline_.rows() - 2); }
  Eigen::RowVectorXd error(double place) const {
    const Index leg = leg_of(place);
    const double fraction = place - static_cast<double>(leg);
    return (1 - fraction) * polyline_.row(leg) + fraction * polyline_.row(leg + 1) - target_.samples.row(sample_);
  }

  const Target& target_;
  const Lanes& polyline_;
  Index sample_;
};

double nearest_place(const Foot& foot, double place, double low, double high) {
  double best = foot.squared(place);
  for (int round = 0; round < steps; ++round) {
    double step = foot.step(place);
    bool moved = false;
    for (int half = 0; half <= halvings && !moved; ++half, step /= 2) {
      const double next = std::clamp(place + step, low, high);
      const double squared = foot.squared(next);
      moved = squared < best;
      if (moved) place = next, best = squared;
    }
    if (!moved) break;
  }
  return place;
}

}  // namespace

std::vector<double> foot_points(const Target& target, const std::vector<double>& before, const Lanes& polyline,
                                const Watch& watch) {
  const auto legs = static_cast<double>(polyline.rows() - 1);
  std::vector<double> now = before;
  const std::size_t count = before.size(), last = count - (target.closed ? 0 : 1);
  const auto move = [&](std::size_t k) {
    if (k % 256 == 0) watch.poll();
    const double next = k + 1 < count ? now[k + 1] : 1.0;
    const double low = now[k] - most_way * (now[k] - now[k - 1]), high = now[k] + most_way * (next - now[k]);
    const Foot foot(target, polyline, static_cast<Index>(k));
    const double place = nearest_place(foot, now[k] * legs, low * legs, high * legs);
    if (place != now[k] * legs) now[k] = std::clamp(place / legs, low, high);
  };
  for (std::size_t k = 1; k < last; ++k) move(k);
  for (std::size_t k = last; k-- > 1;) move(k);
  return now;
}

}  // namespace ifsm::core
