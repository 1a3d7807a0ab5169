#include "figures/lines.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "curves.h"

namespace figures {

std::vector<plot::Point> line_of(const Points& points, int dimension, bool closed) {
  const auto d = static_cast<std::size_t>(dimension);
  const std::size_t count = points.size() / d;
  const auto steps = static_cast<double>(closed ? count : std::max<std::size_t>(count, 2) - 1);
  std::vector<plot::Point> line;
  for (std::size_t k = 0; k < count; ++k) {
    if (d > 1)
      line.push_back({points[k * d], points[k * d + 1]});
    else
      line.push_back({static_cast<double>(k) / steps, points[k]});
  }
  if (closed && !line.empty()) line.push_back(d > 1 ? line.front() : plot::Point{1, line.front().y});
  return line;
}

std::vector<double> lengths(const Points& points, int dimension, bool closed) {
  const auto d = static_cast<std::size_t>(dimension);
  const std::size_t count = points.size() / d;
  std::vector<double> along{0};
  for (std::size_t k = 1; k < count + (closed ? 1 : 0); ++k) {
    double square = 0;
    for (std::size_t i = 0; i < d; ++i) {
      const double step = points[k % count * d + i] - points[(k - 1) * d + i];
      square += step * step;
    }
    along.push_back(along.back() + std::sqrt(square));
  }
  if (d == 1 || !(along.back() > 0)) std::iota(along.begin(), along.end(), 0.0);
  return along;
}

std::string position_label(int dimension) {
  return dimension > 1 ? "position along the curve" : "steps from sample to sample";
}

double interpolated(const std::vector<double>& xs, const std::vector<double>& ys, double x) {
  const auto right = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(
      std::upper_bound(xs.begin(), xs.end(), x) - xs.begin(), 1, static_cast<std::ptrdiff_t>(xs.size()) - 1));
  const double step = xs[right] - xs[right - 1];
  const double share = step > 0 ? (x - xs[right - 1]) / step : 0;
  return ys[right - 1] + share * (ys[right] - ys[right - 1]);
}

plot::Panel plane_panel(int dimension) {
  const auto names = cli::coordinate_names(dimension);
  const std::string hidden = dimension > 2 ? " (first two of " + std::to_string(dimension) + " coordinates)" : "";
  plot::Panel panel;
  panel.equal_aspect = dimension > 1;
  panel.x.label = dimension > 1 ? names[0] + hidden : "parameter";
  panel.y.label = dimension > 1 ? names[1] : names[0];
  return panel;
}

void add_inside(plot::Panel& panel, const std::vector<plot::Point>& line, int dimension, bool closed) {
  if (closed && dimension > 1) panel.area(line, plot::palette::land);
}

}  // namespace figures
