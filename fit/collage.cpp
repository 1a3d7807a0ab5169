#include "fit/collage.h"

#include <algorithm>

#include "curve/complement.h"
#include "fit/normal.h"
#include "linalg/spectrum.h"

namespace ifsm::core {
namespace {

constexpr int coarse_levels = 3;   // deeper polygons are many, small, and say more of noise than of shape
constexpr double firmness = 1e-3;  // how much the filter at hand counts against the polygons
constexpr int halvings = 6;        // of the way from it, until the start is given up

// The polygons of nodes, and those of their children, as sums of products.
struct Moments {
  Eigen::MatrixXd polygons;  // n × n
  Eigen::MatrixXd children;  // n × rows
};

Moments moments_of(std::span<const ModelPtr> models) {
  const Shape& shape = models.front()->shape();
  const int n = shape.control_points();
  Moments sum{Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, shape.rows())};
  for (const ModelPtr& model : models)
    for (int level = 0; level < std::min(model->levels(), coarse_levels); ++level) {
      const Points coarse = line(*model, level), fine = line(*model, level + 1);
      for (Index node = 0; node < shape.nodes(level); ++node) {
        const auto polygon = coarse.polygon(node * shape.polygon_step(), n);
        sum.polygons += polygon * polygon.transpose();
        sum.children += polygon * fine.polygon(node * shape.children_step(), shape.rows()).transpose();
      }
    }
  return sum;
}

}  // namespace

RowMatrix collage(std::span<const ModelPtr> models, const std::function<bool(const RowMatrix&)>& admits) {
  const Filter& filter = models.front()->filter();
  const Shape& shape = filter.shape();
  const int n = shape.control_points();
  const RowMatrix own = filter.matrix().topRows(n);
  const Moments moments = moments_of(models);
  // Columns move along vectors of sum zero: e_i - e_n-1.
  Eigen::MatrixXd along = Eigen::MatrixXd::Zero(n, n - 1);
  along.topRows(n - 1).setIdentity();
  along.row(n - 1).setConstant(-1);
  const double firm = firmness * std::max(moments.polygons.trace() / n, 1e-300);
  const Eigen::MatrixXd form = along.transpose() * (moments.polygons + firm * Eigen::MatrixXd::Identity(n, n)) * along;
  const Eigen::MatrixXd wanted = along.transpose() * (moments.children - moments.polygons * own);
  RowMatrix move = along * (inverse(form) * wanted);
  move.col(0).setZero();
  move.col(shape.rows() - 1).setZero();
  double way = 1;
  for (int half = 0; half <= halvings; ++half, way /= 2) {
    const RowMatrix maps = own + way * move;
    try {
      RowMatrix matrix = with_complement(shape, maps);
      if (admits(matrix)) return matrix;
    } catch (const Error&) {  // rows that depend on each other: come nearer
    }
  }
  return filter.matrix();
}

}  // namespace ifsm::core
