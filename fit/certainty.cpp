#include "fit/certainty.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "fit/curve_walk.h"

namespace ifsm::core {
namespace {

void require_freedom(const Certainty& certainty) {
  if (certainty.noise_known || certainty.freedom > 0) return;
  throw Error(Status::numerical, "fit",
              "The fit has as many parameters as samples, so nothing tells how large the noise is; give more samples, "
              "or their covariances.")
      .with(static_cast<double>(certainty.freedom));
}

void require_parameters(std::span<const double> parameters) {
  require_finite(parameters.data(), static_cast<Index>(parameters.size()), "parameters");
  for (std::size_t i = 0; i < parameters.size(); ++i)
    if (!(parameters[i] >= 0 && parameters[i] <= 1))
      throw Error(Status::range, "parameters",
                  "parameters[" + std::to_string(i) + "] is " + text_of(parameters[i]) + "; they run from 0 to 1.")
          .at(static_cast<Index>(i))
          .with(parameters[i]);
}

}  // namespace

Eigen::MatrixXd control_covariance(const Certainty& certainty, std::size_t curve) {
  require_freedom(certainty);
  const CurveCertainty& own = certainty.curves[curve];
  if (!own.determined)
    throw Error(Status::numerical, "fit",
                "The samples do not determine all control points, so their covariance is not bounded; give more "
                "samples or constraints, or use fewer control points.");
  return own.spread + own.follow * certainty.filter * own.follow.transpose();
}

Index covariance_size(const Certainty& certainty) {
  const int n = certainty.shape.control_points(), rows = certainty.shape.rows();
  return static_cast<Index>(certainty.part == Part::maps ? n : rows - n) * rows;
}

Eigen::MatrixXd filter_covariance(const Certainty& certainty) {
  require_freedom(certainty);
  const int n = certainty.shape.control_points(), rows = certainty.shape.rows();
  const int first = certainty.part == Part::maps ? 0 : n;
  const auto entries = free_entries(certainty.shape, certainty.part);
  Eigen::MatrixXd lift = Eigen::MatrixXd::Zero(covariance_size(certainty), static_cast<Index>(entries.size()));
  for (std::size_t p = 0; p < entries.size(); ++p) {
    const FreeEntry& entry = entries[p];
    lift((entry.row - first) * rows + entry.column, static_cast<Index>(p)) = 1;
    if (entry.opposite >= 0) lift(entry.opposite * rows + entry.column, static_cast<Index>(p)) = -1;
  }
  return lift * certainty.filter * lift.transpose();
}

Lanes curve_covariance(const Certainty& certainty, std::size_t curve, std::span<const double> parameters,
                       const Watch& watch) {
  require_freedom(certainty);
  require_parameters(parameters);
  const CurveCertainty& own = certainty.curves[curve];
  const int n = certainty.shape.control_points(), count = free_count(certainty.shape, Part::maps);
  const Index d = own.control.cols();
  std::vector<std::size_t> order(parameters.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return parameters[i]; });
  std::vector<double> sorted;
  for (const std::size_t i : order) sorted.push_back(parameters[i]);
  const std::vector<Position> positions = positions_of(certainty.shape, certainty.levels, sorted);

  Lanes covariances(static_cast<Index>(parameters.size()) * d, d);
  Eigen::MatrixXd by_control(d, n * d), by_filter(d, count);
  CurveWalk(certainty.shape, certainty.levels, certainty.matrix, watch)
      .tangents(positions, own.control, [&](Index k, const double* basis, const double* tangent) {
        for (int i = 0; i < n; ++i) by_control.middleCols(i * d, d) = basis[i] * Eigen::MatrixXd::Identity(d, d);
        by_filter = by_control * own.follow + Eigen::Map<const Lanes>(tangent, d, count);
        covariances.middleRows(static_cast<Index>(order[static_cast<std::size_t>(k)]) * d, d) =
            by_control * own.spread * by_control.transpose() + by_filter * certainty.filter * by_filter.transpose();
      });
  return covariances;
}

}  // namespace ifsm::core
