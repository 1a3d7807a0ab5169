#include "measure/distance.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "measure/nearest.h"

namespace ifsm::core {
namespace {

void require_like(const Model& model, const Model& other) {
  if (other.dimension() != model.dimension())
    throw Error(Status::shape, "other",
                "other is a curve of dimension " + std::to_string(other.dimension()) + ", the model one of dimension " +
                    std::to_string(model.dimension()) + "; compare curves of one dimension.");
}

void require_as_many_samples(const Model& model, const Model& other) {
  const Index own = model.placement().samples(), given = other.placement().samples();
  if (given != own)
    throw Error(Status::shape, "other",
                "other has " + std::to_string(given) + " samples, the model " + std::to_string(own) +
                    "; distances at samples need as many.")
        .with(static_cast<double>(given))
        .needs(own);
}

Eigen::VectorXd at_samples(const Model& model, const Model& other) {
  require_as_many_samples(model, other);
  const Eigen::MatrixXd apart = samples(model).matrix() - samples(other).matrix();
  Eigen::VectorXd lengths(apart.rows());
  for (Index k = 0; k < apart.rows(); ++k) lengths(k) = apart.row(k).stableNorm();
  return lengths;
}

double rms_of(const Eigen::VectorXd& lengths) {
  return lengths.stableNorm() / std::sqrt(static_cast<double>(lengths.size()));
}

double hausdorff(const Model& model, const Model& other) {
  const Points own = places(model), given = places(other);
  const auto there = nearest(Polyline(given, other.closed()), own).distances;
  const auto back = nearest(Polyline(own, model.closed()), given).distances;
  return std::max(std::ranges::max(there), std::ranges::max(back));
}

}  // namespace

Distances distances(const Model& model, const Model& other) {
  require_like(model, other);
  const Eigen::VectorXd lengths = at_samples(model, other);
  Index farthest = 0;
  const double largest = lengths.maxCoeff(&farthest);
  return {rms_of(lengths), largest, farthest, hausdorff(model, other)};
}

double distance(const Model& model, const Model& other, Distance which) {
  require_like(model, other);
  switch (which) {
    case Distance::rms: return rms_of(at_samples(model, other));
    case Distance::largest: return at_samples(model, other).maxCoeff();
    default: return hausdorff(model, other);
  }
}

}  // namespace ifsm::core
