#include "curve/significance.h"

namespace ifsm::core {
namespace {

Eigen::MatrixXd leaf_gram(const Shape& shape) {
  const int n = shape.control_points();
  Eigen::MatrixXd gram = Eigen::MatrixXd::Identity(n, n);
  if (shape.joined()) {
    gram(n - 1, n - 1) = 0;
    return gram;
  }
  return gram * (static_cast<double>(shape.stride()) / n);
}

}  // namespace

std::vector<Eigen::VectorXd> gains(const Filter& filter, int levels) {
  const Shape& shape = filter.shape();
  std::vector<Eigen::VectorXd> gains(static_cast<std::size_t>(levels));
  Eigen::MatrixXd gram = leaf_gram(shape);
  for (int level = levels - 1; level >= 0; --level) {
    Eigen::VectorXd squares = Eigen::VectorXd::Zero(shape.details_per_node());
    Eigen::MatrixXd coarser = Eigen::MatrixXd::Zero(gram.rows(), gram.cols());
    for (int i = 0; i < shape.maps(); ++i) {
      const RowMatrix t = filter.map(i), u = filter.detail_map(i);
      squares += (u * gram * u.transpose()).diagonal();
      coarser += t * gram * t.transpose();
    }
    gains[static_cast<std::size_t>(level)] = squares.cwiseMax(0).cwiseSqrt();
    gram = std::move(coarser);
  }
  return gains;
}

Eigen::VectorXd significance(const Model& model, int level) {
  in_range(level, 0, model.levels() - 1, "level");
  return significance(model, level, gains(model.filter(), model.levels())[static_cast<std::size_t>(level)]);
}

Eigen::VectorXd significance(const Model& model, int level, const Eigen::VectorXd& gains_of_level) {
  Eigen::VectorXd values = model.details(level).matrix().rowwise().stableNorm();
  for (Index i = 0; i < values.size(); ++i) values(i) *= gains_of_level(i % gains_of_level.size());
  return values;
}

}  // namespace ifsm::core
