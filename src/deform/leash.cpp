#include "deform/leash.h"

#include <cmath>
#include <limits>
#include <string>

namespace ifsm::core {

Leash::Leash(const std::vector<Shares>& shares, const std::map<Index, Vector>& held) {
  for (const Shares& row : shares)
    for (const auto& [value, share] : row)
      if (!held.contains(value)) column_.try_emplace(value, static_cast<Index>(column_.size()));
  const auto points = static_cast<Index>(shares.size());
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(points, static_cast<Index>(column_.size()));
  for (std::size_t k = 0; k < shares.size(); ++k)
    for (const auto& [value, share] : shares[k])
      if (const auto at = column_.find(value); at != column_.end()) rows(static_cast<Index>(k), at->second) = share;
  solver_.setThreshold(1e-10);  // of the largest pivot: nearer to each other, points are led by rounding
  if (rows.cols() > 0) solver_.compute(rows);
  const Index led = rows.cols() > 0 ? solver_.rank() : 0;
  if (led == points) return;
  throw Error(
      Status::singular, "parameters",
      "What is free to move at this level can lead " + std::to_string(led) + " of the " + std::to_string(points) +
          " points as they are told: the others are too near to them, or hang on pins, or are ends that no detail "
          "moves. Name points once, let pins go, take a finer level, or lead by handles.")
      .with(static_cast<double>(points))
      .needs(led);
}

std::map<Index, Vector> Leash::changes(const Eigen::MatrixXd& ways) const {
  const Eigen::MatrixXd solved = solver_.solve(ways);
  std::map<Index, Vector> all;
  for (const auto& [value, column] : column_) all.emplace(value, solved.row(column).transpose());
  return all;
}

std::vector<Index> Leash::values() const {
  std::vector<Index> all;
  for (const auto& [value, column] : column_) all.push_back(value);
  return all;
}

bool find_ways(const std::function<Eigen::MatrixXd(const Eigen::MatrixXd& ways)>& left, Index points, Index dimension,
               double close) {
  constexpr int most_steps = 200;
  using Flat = Eigen::VectorXd;
  const auto left_by = [&](const Flat& ways) { return Flat(left(ways.reshaped(points, dimension)).reshaped()); };
  Flat ways = Flat::Zero(points * dimension), now = left_by(ways);
  Eigen::MatrixXd inverse = Eigen::MatrixXd::Identity(ways.size(), ways.size());
  const auto is_close = [&] { return now.cwiseAbs().maxCoeff() <= close; };
  for (int step = 0; step < most_steps && now.allFinite() && !is_close(); ++step) {
    const Flat way = inverse * now;
    ways += way;
    const Flat next = left_by(ways), gone = inverse * (now - next);
    const double part = way.dot(gone);
    if (std::abs(part) > std::numeric_limits<double>::epsilon() * way.squaredNorm())
      inverse += (way - gone) * (way.transpose() * inverse) / part;
    now = next;
  }
  return now.allFinite() && is_close();
}

}  // namespace ifsm::core
