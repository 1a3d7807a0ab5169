#include "curve/transform.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include "base/parallel.h"
#include "curve/kernel.h"

namespace ifsm::core {
namespace {

using Row = Eigen::Map<Eigen::RowVectorXd>;
using ConstRow = Eigen::Map<const Eigen::RowVectorXd>;

std::vector<int> columns(int first, int count) {
  std::vector<int> result(static_cast<std::size_t>(count));
  std::iota(result.begin(), result.end(), first);
  return result;
}

Index nodes_of(const Shape& shape, ConstLine coarse) {
  return (static_cast<Index>(coarse.size()) - (shape.joined() ? 1 : 0)) / shape.polygon_step();
}

// NaN is larger than anything.
double larger(double a, double b) { return std::isnan(a) || a > b ? a : b; }

Extent largest(const Extent& a, const Extent& b) {
  return {larger(a.polygons, b.polygons), larger(a.details, b.details)};
}

}  // namespace

namespace plain {

void synthesize_level(const Filter& filter, ConstLine coarse, ConstLine details, Line fine) {
  const Shape& shape = filter.shape();
  const int n = shape.control_points(), d = shape.details_per_node();
  for (Index node = 0; node < nodes_of(shape, coarse); ++node) {
    const ConstRow polygon(coarse.data() + node * shape.polygon_step(), n);
    const ConstRow detail(details.data() + node * d, d);
    Row children(fine.data() + node * shape.children_step(), shape.rows());
    children = polygon * filter.matrix().topRows(n) + detail * filter.matrix().bottomRows(d);
  }
}

void analyze_level(const Filter& filter, ConstLine fine, Line coarse, Line details) {
  const Shape& shape = filter.shape();
  const int n = shape.control_points(), d = shape.details_per_node();
  for (Index node = 0; node < nodes_of(shape, coarse); ++node) {
    const ConstRow children(fine.data() + node * shape.children_step(), shape.rows());
    Row(coarse.data() + node * shape.polygon_step(), n) = children * filter.inverse().leftCols(n);
    Row(details.data() + node * d, d) = children * filter.inverse().rightCols(d);
  }
}

}  // namespace plain

namespace {

// Joined children end where the next node's begin, so a node writes all but its last place; the line's last place is
// the polygon's last point. The same on the way up.
class Synthesis {
 public:
  explicit Synthesis(const Filter& filter)
      : shape_(filter.shape()), product_(filter.matrix(), columns(0, shape_.children_step())) {}

  void operator()(Index nodes, const double* coarse, const double* details, double* fine) const {
    product_(nodes, {coarse, shape_.control_points(), shape_.polygon_step()},
             {details, shape_.details_per_node(), shape_.details_per_node()}, fine, nullptr);
  }

 private:
  Shape shape_;
  kernel::Product product_;
};

class Analysis {
 public:
  Analysis(const Shape& shape, const RowMatrix& inverse, int details)
      : shape_(shape),
        product_(inverse, columns(0, shape_.polygon_step()), columns(shape_.control_points(), details)) {}

  void operator()(Index nodes, const double* fine, double* coarse, double* details) const {
    product_(nodes, {fine, shape_.rows(), shape_.children_step()}, {nullptr, 0, 0}, coarse, details);
  }

 private:
  Shape shape_;
  kernel::Product product_;
};

Analysis analysis_of(const Filter& filter) {
  return {filter.shape(), filter.inverse(), filter.shape().details_per_node()};
}

void end_alike(const Shape& shape, ConstLine from, Line to) {
  if (shape.joined()) to.back() = from.back();
}

// The lowest levels of a tree, cut into blocks of neighbouring subtrees whose lines stay in a core's cache. A block is
// some levels high only: the levels above have few nodes a block, and each call of the kernel costs as much as some.
struct Forest {
  static constexpr Index line_doubles = 1 << 14;  // of a block's finest line: it and its details stay in the cache
  static constexpr Index subtree_nodes = 32;  // below a root, about: what is left for the levels above is as much less

  Forest(const Shape& s, int all_levels) : shape(s), levels(all_levels), root(all_levels) {
    while (root > 0 && (root == levels || shape.nodes(levels - root + 1) <= subtree_nodes)) --root;
    together = std::max<Index>(1, line_doubles / (shape.line_length(levels - root) + 1));
  }

  struct Block {
    Index first, roots;  // nodes of level `root`
  };
  Index blocks() const { return (shape.nodes(root) + together - 1) / together; }
  Block block(Index b) const { return {b * together, std::min(together, shape.nodes(root) - b * together)}; }

  // Nodes of a level below a root.
  Index nodes_below(int level) const { return shape.nodes(level - root); }

  Shape shape;
  int levels;
  int root;
  Index together;
};

// The lines of a block between its roots and its finest line, two of them at a time: what one level leaves is what the
// next one reads. A line has at most half as many doubles as the one below it.
class Between {
 public:
  double* line(int levels_above_finest) { return levels_above_finest % 2 == 1 ? odd_.data() : even_.data(); }

 private:
  // Not initialised: levels write before they read.
  std::array<double, Forest::line_doubles / 2> odd_;
  std::array<double, Forest::line_doubles / 4> even_;
};

void synthesize_block(const Forest& forest, const Synthesis& synthesis, const Forest::Block& block, ConstLine coarse,
                      std::span<const ConstLine> details, Line fine) {
  const Shape& shape = forest.shape;
  Between between;
  const double* from = coarse.data() + block.first * shape.polygon_step();
  for (int level = forest.root; level < forest.levels; ++level) {
    const Index first = block.first * forest.nodes_below(level), nodes = block.roots * forest.nodes_below(level);
    const bool last = level + 1 == forest.levels;
    double* const to = last ? fine.data() + first * shape.children_step() : between.line(forest.levels - level - 1);
    synthesis(nodes, from, details[static_cast<std::size_t>(level)].data() + first * shape.details_per_node(), to);
    // In the finest line that place is the next block's to write.
    if (!last && shape.joined()) to[nodes * shape.children_step()] = from[nodes * shape.polygon_step()];
    from = to;
  }
}

Extent analyze_block(const Forest& forest, const Analysis& analysis, const Forest::Block& block, ConstLine fine,
                     Line coarse, std::span<const Line> details) {
  const Shape& shape = forest.shape;
  Between between;
  const double* from = fine.data() + block.first * forest.nodes_below(forest.levels) * shape.polygon_step();
  Extent extent{0, 0};
  for (int level = forest.levels - 1; level >= forest.root; --level) {
    const Index first = block.first * forest.nodes_below(level), nodes = block.roots * forest.nodes_below(level);
    const bool last = level == forest.root;
    double* const to = last ? coarse.data() + first * shape.polygon_step() : between.line(forest.levels - level);
    double* const own = details[static_cast<std::size_t>(level)].data() + first * shape.details_per_node();
    analysis(nodes, from, to, own);
    if (!last && shape.joined()) to[nodes * shape.polygon_step()] = from[nodes * shape.children_step()];
    extent = largest(extent, {kernel::largest(ConstLine(to, to + nodes * shape.polygon_step())),
                              kernel::largest(ConstLine(own, own + nodes * shape.details_per_node()))});
    from = to;
  }
  return extent;
}

}  // namespace

void synthesize_level(const Filter& filter, ConstLine coarse, ConstLine details, Line fine) {
  Synthesis{filter}(nodes_of(filter.shape(), coarse), coarse.data(), details.data(), fine.data());
  end_alike(filter.shape(), coarse, fine);
}

void analyze_level(const Filter& filter, ConstLine fine, Line coarse, Line details) {
  analysis_of(filter)(nodes_of(filter.shape(), coarse), fine.data(), coarse.data(), details.data());
  end_alike(filter.shape(), fine, coarse);
}

void coarsen_level(const Shape& shape, const RowMatrix& inverse, ConstLine fine, Line coarse) {
  Analysis{shape, inverse, 0}(nodes_of(shape, coarse), fine.data(), coarse.data(), nullptr);
  end_alike(shape, fine, coarse);
}

void synthesize(const Filter& filter, ConstLine polygon, std::span<const ConstLine> details, Line fine) {
  if (details.empty()) {
    std::ranges::copy(polygon, fine.begin());
    return;
  }
  const Shape& shape = filter.shape();
  const Forest forest(shape, static_cast<int>(details.size()));
  std::vector<double> coarse(static_cast<std::size_t>(shape.line_length(forest.root)));
  synthesize(filter, polygon, details.first(static_cast<std::size_t>(forest.root)), coarse);
  const Synthesis synthesis(filter);
  parallel_for(forest.blocks(), 0,
               [&](Index b) { synthesize_block(forest, synthesis, forest.block(b), coarse, details, fine); });
  end_alike(shape, coarse, fine);
}

Extent analyze(const Filter& filter, ConstLine fine, Line polygon, std::span<const Line> details) {
  if (details.empty()) {
    std::ranges::copy(fine, polygon.begin());
    return {kernel::largest(fine), 0};
  }
  const Shape& shape = filter.shape();
  const Forest forest(shape, static_cast<int>(details.size()));
  std::vector<double> coarse(static_cast<std::size_t>(shape.line_length(forest.root)));
  std::vector<Extent> extents(static_cast<std::size_t>(forest.blocks()));
  const Analysis analysis = analysis_of(filter);
  parallel_for(forest.blocks(), 0, [&](Index b) {
    extents[static_cast<std::size_t>(b)] = analyze_block(forest, analysis, forest.block(b), fine, coarse, details);
  });
  end_alike(shape, fine, coarse);
  Extent extent = analyze(filter, coarse, polygon, details.first(static_cast<std::size_t>(forest.root)));
  for (const Extent& other : extents) extent = largest(extent, other);
  return extent;
}

}  // namespace ifsm::core
