#include "thin.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace plot {
namespace {

std::vector<Point> without_neighbours(const std::vector<Point>& line, double tolerance) {
  std::vector<Point> kept{line.front()};
  for (std::size_t k = 1; k + 1 < line.size(); ++k)
    if (std::hypot(line[k].x - kept.back().x, line[k].y - kept.back().y) > tolerance) kept.push_back(line[k]);
  kept.push_back(line.back());
  return kept;
}

bool is_graph(const std::vector<Point>& line) {
  return std::is_sorted(line.begin(), line.end(), [](const Point& a, const Point& b) { return a.x < b.x; });
}

// Points first … last of one column.
void append_column(const std::vector<Point>& line, std::size_t first, std::size_t last, std::vector<Point>& kept) {
  const auto begin = line.begin() + static_cast<std::ptrdiff_t>(first);
  const auto end = line.begin() + static_cast<std::ptrdiff_t>(last) + 1;
  const auto [low, high] = std::minmax_element(begin, end, [](const Point& a, const Point& b) { return a.y < b.y; });
  std::array chosen{begin, low, high, end - 1};
  std::sort(chosen.begin(), chosen.end());
  const auto unique = std::unique(chosen.begin(), chosen.end());
  for (auto point = chosen.begin(); point != unique; ++point) kept.push_back(**point);
}

std::vector<Point> by_columns(const std::vector<Point>& line, double width) {
  std::vector<Point> kept;
  for (std::size_t first = 0; first < line.size();) {
    std::size_t last = first;
    while (last + 1 < line.size() && line[last + 1].x - line[first].x <= width) ++last;
    append_column(line, first, last, kept);
    first = last + 1;
  }
  return kept;
}

}  // namespace

std::vector<Point> thinned(const std::vector<Point>& line, double tolerance) {
  if (line.size() < 3) return line;
  const auto kept = without_neighbours(line, tolerance);
  return is_graph(kept) ? by_columns(kept, tolerance) : kept;
}

}  // namespace plot
