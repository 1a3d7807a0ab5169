#include "curve/transform.h"

#include <numeric>
#include <vector>

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

// Joined children end where the next node's begin, so a node writes all but its last place; the line's last place is
// the polygon's last point. The same on the way up.
void synthesize_level(const Filter& filter, ConstLine coarse, ConstLine details, Line fine) {
  const Shape& shape = filter.shape();
  kernel::multiply(filter.matrix(), columns(0, shape.children_step()), nodes_of(shape, coarse),
                   {coarse.data(), shape.control_points(), shape.polygon_step()},
                   {details.data(), shape.details_per_node(), shape.details_per_node()},
                   {fine.data(), shape.children_step(), nullptr, 0});
  if (shape.joined()) fine.back() = coarse.back();
}

void analyze_level(const Filter& filter, ConstLine fine, Line coarse, Line details) {
  const Shape& shape = filter.shape();
  std::vector<int> chosen = columns(0, shape.polygon_step());
  const std::vector<int> added = columns(shape.control_points(), shape.details_per_node());
  chosen.insert(chosen.end(), added.begin(), added.end());
  kernel::multiply(filter.inverse(), chosen, nodes_of(shape, coarse),
                   {fine.data(), shape.rows(), shape.children_step()}, {nullptr, 0, 0},
                   {coarse.data(), shape.polygon_step(), details.data(), shape.details_per_node()});
  if (shape.joined()) coarse.back() = fine.back();
}

void coarsen_level(const Shape& shape, const RowMatrix& inverse, ConstLine fine, Line coarse) {
  kernel::multiply(inverse, columns(0, shape.polygon_step()), nodes_of(shape, coarse),
                   {fine.data(), shape.rows(), shape.children_step()}, {nullptr, 0, 0},
                   {coarse.data(), shape.polygon_step(), nullptr, 0});
  if (shape.joined()) coarse.back() = fine.back();
}

}  // namespace ifsm::core
