#include "curve/tree_solver.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "base/parallel.h"
#include "curve/kernel.h"
#include "curve/tree_scores.h"

namespace ifsm::core {
namespace {

constexpr Index nodes_together = 1024;      // of a level, in one chunk
constexpr Index places_together = 1 << 14;  // of the finest line

std::vector<int> columns(int first, int count) {
  std::vector<int> result(static_cast<std::size_t>(count));
  std::iota(result.begin(), result.end(), first);
  return result;
}

// Calls body(first, count) for chunks of a whole, which share the threads.
template <class Body>
void in_chunks(Index count, Index together, const Watch& watch, const Body& body) {
  parallel_for((count + together - 1) / together, 0, [&](Index chunk) {
    watch.poll();
    body(chunk * together, std::min(together, count - chunk * together));
  });
}

}  // namespace

TreeSolver::TreeSolver(const Shape& shape, int levels, bool closed, Eigen::VectorXd weight)
    : forms_(shape, levels, closed, std::move(weight)) {}

void TreeSolver::factor(const RowMatrix& filter, const Kept& kept, const Watch& watch) {
  forms_.factor(filter, kept, watch);
}

TreeSolver::Moments TreeSolver::moments(std::span<const double> data, const Watch& watch) const {
  const Shape& shape = forms_.shape();
  const Index n = shape.control_points(), d = shape.details_per_node(), rows = shape.rows();
  const int levels = forms_.levels(), maps = shape.maps();
  const Eigen::VectorXd& weight = forms_.weight();
  const Eigen::Map<const Eigen::VectorXd> wanted(data.data(), static_cast<Index>(data.size()));
  Moments result{Eigen::VectorXd(n), std::vector<double>(static_cast<std::size_t>(forms_.details()))};
  if (levels == 0) {
    result.control = weight.cwiseProduct(wanted);
    return result;
  }
  const kernel::Product product(forms_.filter().transpose(), columns(0, static_cast<int>(n)),
                                columns(static_cast<int>(n), static_cast<int>(d)));
  std::vector<double> below, now;  // of the polygons of a level
  for (int level = levels - 1; level >= 0; --level) {
    now.resize(static_cast<std::size_t>(n * shape.nodes(level)));
    double* const details = result.details.data() + shape.first_node(level) * d;
    in_chunks(shape.nodes(level), nodes_together, watch, [&](Index first, Index count) {
      std::vector<double> children(static_cast<std::size_t>(count * rows), 0.0);
      for (Index i = 0; i < count; ++i) {
        double* const own = children.data() + i * rows;
        if (level + 1 == levels) {
          const Index place = (first + i) * (rows - 1);
          for (Index r = 0; r + 1 < rows; ++r) own[r] = weight(place + r) * data[static_cast<std::size_t>(place + r)];
          continue;
        }
        for (int c = 0; c < maps; ++c)
          for (Index r = 0; r < n; ++r)
            own[first_column(shape, c) + r] += below[static_cast<std::size_t>(((first + i) * maps + c) * n + r)];
      }
      product(count, {children.data(), static_cast<int>(rows), static_cast<int>(rows)}, {nullptr, 0, 0},
              now.data() + first * n, details + first * d);
    });
    for (const Branch& branch : forms_.branches(level)) {
      Eigen::Map<Eigen::VectorXd> passed(now.data() + branch.node * n, n);
      for (std::size_t a = 0; a < branch.kept.size(); ++a)
        passed -= branch.gain.row(static_cast<Index>(a)).transpose() * details[branch.node * d + branch.kept[a]];
    }
    below.swap(now);
  }
  result.control = Eigen::Map<const Eigen::VectorXd>(below.data(), n);
  result.control(n - 1) += weight(weight.size() - 1) * data.back();
  return result;
}

Solution TreeSolver::solve(const Points& data, const Watch& watch) const {
  const Shape& shape = forms_.shape();
  const Index d = shape.details_per_node();
  Lanes top(shape.control_points(), data.dimension()), of_kept(forms_.kept_count(), data.dimension());
  for (Index lane = 0; lane < data.dimension(); ++lane) {
    const Moments moments = this->moments(data.plane(lane), watch);
    top.col(lane) = moments.control;
    for (int level = 0; level < forms_.levels(); ++level)
      for (const Branch& branch : forms_.branches(level))
        for (std::size_t a = 0; a < branch.kept.size(); ++a)
          of_kept(branch.first_value + static_cast<Index>(a), lane) =
              moments.details[static_cast<std::size_t>((shape.first_node(level) + branch.node) * d + branch.kept[a])];
  }
  Solution solution{forms_.root_inverse() * top, Lanes(forms_.kept_count(), data.dimension())};
  if (forms_.root_branch() >= 0) descend(forms_.root_branch(), solution.control, of_kept, solution);
  return solution;
}

void TreeSolver::descend(int index, const Lanes& polygon, const Lanes& moments, Solution& solution) const {
  const Shape& shape = forms_.shape();
  const int n = shape.control_points();
  const Branch& branch = forms_.branch(index);
  const auto count = static_cast<Index>(branch.kept.size());
  Lanes children(shape.rows(), polygon.cols());
  children.noalias() = forms_.filter().topRows(n).transpose() * polygon;
  if (count > 0) {
    const Lanes values = branch.inverse * moments.middleRows(branch.first_value, count) - branch.gain * polygon;
    solution.values.middleRows(branch.first_value, count) = values;
    for (Index a = 0; a < count; ++a)
      children.noalias() +=
          forms_.filter().row(n + branch.kept[static_cast<std::size_t>(a)]).transpose() * values.row(a);
  }
  for (int c = 0; c < shape.maps(); ++c)
    if (const int child = branch.children[static_cast<std::size_t>(c)]; child >= 0)
      descend(child, children.middleRows(first_column(shape, c), n), moments, solution);
}

void TreeSolver::synthesize(const Solution& solution, Index lane, std::span<double> line, const Watch& watch) const {
  const Shape& shape = forms_.shape();
  const int n = shape.control_points(), step = shape.polygon_step(), out = shape.children_step();
  const RowMatrix& filter = forms_.filter();
  const kernel::Product product(filter.topRows(n), columns(0, out));
  std::vector<double> coarse(static_cast<std::size_t>(n)), fine;
  for (int i = 0; i < n; ++i) coarse[static_cast<std::size_t>(i)] = solution.control(i, lane);
  if (forms_.levels() == 0) std::ranges::copy(coarse, line.begin());
  for (int level = 0; level < forms_.levels(); ++level) {
    const bool last = level + 1 == forms_.levels();
    if (!last) fine.resize(static_cast<std::size_t>(shape.line_length(level + 1)));
    double* const to = last ? line.data() : fine.data();
    in_chunks(shape.nodes(level), nodes_together, watch, [&](Index first, Index count) {
      product(count, {coarse.data() + first * step, n, step}, {nullptr, 0, 0}, to + first * out, nullptr);
    });
    to[shape.nodes(level) * out] = coarse.back();
    for (const Branch& branch : forms_.branches(level))
      for (std::size_t a = 0; a < branch.kept.size(); ++a)
        for (int c = 1; c < out; ++c)  // ends of polygons stay
          to[branch.node * out + c] +=
              filter(n + branch.kept[a], c) * solution.values(branch.first_value + static_cast<Index>(a), lane);
    coarse.swap(fine);
  }
}

Points TreeSolver::curve(const Solution& solution, const Watch& watch) const {
  Points curve(solution.control.cols(), forms_.shape().line_length(forms_.levels()));
  for (Index lane = 0; lane < curve.dimension(); ++lane) synthesize(solution, lane, curve.plane(lane), watch);
  return curve;
}

double TreeSolver::squared_error(const Points& data, const Solution& solution, const Watch& watch) const {
  const Index places = data.count();
  Eigen::VectorXd line(places), squares = Eigen::VectorXd::Zero(places);
  for (Index lane = 0; lane < data.dimension(); ++lane) {
    synthesize(solution, lane, {line.data(), static_cast<std::size_t>(places)}, watch);
    const auto wanted = data.matrix().col(lane);
    in_chunks(places, places_together, watch, [&](Index first, Index count) {
      squares.segment(first, count) += (wanted.segment(first, count) - line.segment(first, count)).cwiseAbs2();
    });
  }
  std::vector<double> sums(static_cast<std::size_t>((places + places_together - 1) / places_together));
  in_chunks(places, places_together, watch, [&](Index first, Index count) {
    sums[static_cast<std::size_t>(first / places_together)] =
        forms_.weight().segment(first, count).dot(squares.segment(first, count));
  });
  return std::accumulate(sums.begin(), sums.end(), 0.0);
}

std::vector<double> TreeSolver::scores(const Points& data, const Solution& solution, const Watch& watch) const {
  std::vector<std::vector<double>> of_details;
  for (Index lane = 0; lane < data.dimension(); ++lane)
    of_details.push_back(std::move(moments(data.plane(lane), watch).details));
  return scores_of(forms_, solution, of_details, watch);
}

}  // namespace ifsm::core
