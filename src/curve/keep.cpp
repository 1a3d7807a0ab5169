#include "curve/keep.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <utility>

#include "curve/significance.h"

namespace ifsm::core {
namespace {

std::vector<double> all_significances(const Model& model) {
  std::vector<double> all;
  all.reserve(static_cast<std::size_t>(model.details_total()));
  const auto g = gains(model.filter(), model.levels());
  for (int level = 0; level < model.levels(); ++level) {
    const Eigen::VectorXd values = significance(model, level, g[static_cast<std::size_t>(level)]);
    all.insert(all.end(), values.begin(), values.end());
  }
  return all;
}

}  // namespace

Kept first_levels(const Model& model, Index levels) {
  const auto count = in_range(levels, 0, model.levels(), "count");
  Kept kept(static_cast<std::size_t>(model.details_total()), char{0});
  const Index end = model.shape().first_node(static_cast<int>(count)) * model.shape().details_per_node();
  std::fill(kept.begin(), kept.begin() + end, char{1});
  return kept;
}

Kept most_significant(const Model& model, Index count) {
  in_range(count, 0, model.details_total(), "count");
  return largest(all_significances(model), count);
}

Kept above(const Model& model, double threshold) {
  Kept kept;
  for (const double value : all_significances(model)) kept.push_back(value > threshold ? 1 : 0);
  return kept;
}

namespace {

// The count-th largest value, count > 0, in the memory of a few times as many.
double least_of_largest(const std::vector<double>& values, Index count) {
  constexpr Index fewest = 1024;
  std::vector<double> candidates;
  candidates.reserve(static_cast<std::size_t>(std::max(2 * count, fewest)));
  double least = -std::numeric_limits<double>::infinity();
  const auto drop_others = [&] {
    std::nth_element(candidates.begin(), candidates.begin() + count - 1, candidates.end(), std::greater<>{});
    candidates.resize(static_cast<std::size_t>(count));
    least = candidates.back();
  };
  for (const double value : values) {
    if (static_cast<Index>(candidates.size()) >= count && !(value > least)) continue;
    if (candidates.size() == candidates.capacity()) drop_others();
    candidates.push_back(value);
  }
  drop_others();
  return least;
}

}  // namespace

Kept largest(const std::vector<double>& values, Index count) {
  Kept kept(values.size(), char{0});
  if (count == 0) return kept;
  const double least = least_of_largest(values, count);
  Index ties = count;
  for (const double value : values) ties -= value > least ? 1 : 0;
  for (std::size_t i = 0; i < values.size(); ++i)
    kept[i] = values[i] > least || (values[i] == least && ties-- > 0) ? 1 : 0;
  return kept;
}

std::vector<PointsPtr> zero_details(const Model& model) {
  std::vector<PointsPtr> zeros;
  for (const PointsPtr& level : model.parts().details)
    zeros.push_back(std::make_shared<Points>(level->dimension(), level->count()));
  return zeros;
}

ModelPtr keep(const Model& model, const Kept& kept) { return keep(model, kept, {}); }

ModelPtr keep(const Model& model, const Kept& kept, const std::vector<PointsPtr>& zeros) {
  ModelParts parts = model.parts();
  auto flag = kept.begin();
  for (int level = 0; level < model.levels(); ++level) {
    const auto end = flag + model.details(level).count();
    if (!zeros.empty() && std::find(flag, end, char{1}) == end) {
      parts.details[static_cast<std::size_t>(level)] = zeros[static_cast<std::size_t>(level)];
      flag = end;
      continue;
    }
    auto details = std::make_shared<Points>(model.details(level));
    for (Index i = 0; i < details->count(); ++i)
      if (!*flag++) details->matrix().row(i).setZero();
    parts.details[static_cast<std::size_t>(level)] = std::move(details);
  }
  return std::make_shared<Model>(std::move(parts));
}

}  // namespace ifsm::core
