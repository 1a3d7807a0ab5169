#include "gaps.h"

#include <algorithm>
#include <cmath>

namespace cli {
namespace {

std::ptrdiff_t offset(std::size_t index) { return static_cast<std::ptrdiff_t>(index); }

struct Run {
  std::size_t first = 0, last = 0;  // points first … last - 1
  std::size_t size() const { return last - first; }
};

// Points as rows that are known or not.
class Rows {
 public:
  Rows(const std::vector<double>& points, std::size_t dimension) : points_(points), dimension_(dimension) {}

  std::size_t count() const { return points_.size() / dimension_; }

  bool known(std::size_t row) const {
    const auto first = points_.begin() + offset(row * dimension_);
    return std::none_of(first, first + offset(dimension_), [](double value) { return std::isnan(value); });
  }

  // The longest stretches of rows that are known, or of those that are not.
  std::vector<Run> runs(bool of_known) const {
    std::vector<Run> runs;
    for (std::size_t row = 0; row < count(); ++row) {
      if (known(row) != of_known) continue;
      if (runs.empty() || runs.back().last != row) runs.push_back({row, row});
      runs.back().last = row + 1;
    }
    return runs;
  }

 private:
  const std::vector<double>& points_;
  std::size_t dimension_;
};

std::vector<double> part(const std::vector<double>& points, std::size_t dimension, const Run& run) {
  return {points.begin() + offset(run.first * dimension), points.begin() + offset(run.last * dimension)};
}

// Fills the rows of a gap from the row before to the row after, all counted round the ring.
void fill(std::vector<double>& points, std::size_t dimension, const Run& gap) {
  const std::size_t count = points.size() / dimension;
  const auto at = [&](std::size_t row, std::size_t i) -> double& { return points[row % count * dimension + i]; };
  const std::size_t before = gap.first + count - 1;
  for (std::size_t k = 0; k < gap.size(); ++k) {
    const double share = static_cast<double>(k + 1) / static_cast<double>(gap.size() + 1);
    for (std::size_t i = 0; i < dimension; ++i) at(gap.first + k, i) = std::lerp(at(before, i), at(gap.last, i), share);
  }
}

}  // namespace

Split split_at_gaps(const std::vector<double>& points, std::size_t dimension, bool closed) {
  const auto gaps = Rows(points, dimension).runs(false);
  if (gaps.empty()) return {{points}, closed, 0, 0};
  auto line = points;
  if (closed) {  // begins with a gap, with the one across the start if there is one
    const bool known_start = Rows(points, dimension).known(0);
    const auto first = (known_start ? gaps.front() : gaps.back()).first;
    if (known_start || gaps.back().last * dimension == points.size())
      std::rotate(line.begin(), line.begin() + offset(first * dimension), line.end());
  }
  const Rows rows(line, dimension);
  Split split;
  split.gaps = rows.runs(false).size();
  for (const auto& run : rows.runs(true)) {
    if (run.size() > 1)
      split.pieces.push_back(part(line, dimension, run));
    else
      ++split.singles;
  }
  return split;
}

Bridge bridge_gaps(std::vector<double> points, std::size_t dimension, bool closed) {
  const Rows rows(points, dimension);
  const auto known = rows.runs(true);
  if (known.empty()) return {{}, 1, 0, rows.count()};
  Bridge bridge;
  if (!closed) {
    const Run inner{known.front().first, known.back().last};
    bridge.cut_off = rows.count() - inner.size();
    points = part(points, dimension, inner);
  }
  auto gaps = Rows(points, dimension).runs(false);
  const bool across_the_start =
      closed && gaps.size() > 1 && gaps.front().first == 0 && gaps.back().last == rows.count();
  if (across_the_start) {  // one gap, not two
    gaps.back().last += gaps.front().size();
    gaps.erase(gaps.begin());
  }
  for (const auto& gap : gaps) {
    fill(points, dimension, gap);
    bridge.filled += gap.size();
  }
  bridge.gaps = gaps.size();
  bridge.points = std::move(points);
  return bridge;
}

}  // namespace cli
