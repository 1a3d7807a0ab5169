#include "curve/keep.h"

#include <algorithm>
#include <numeric>
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

Kept largest(const std::vector<double>& values, Index count) {
  std::vector<Index> order(values.size());
  std::iota(order.begin(), order.end(), Index{0});
  std::nth_element(order.begin(), order.begin() + count, order.end(), [&](Index a, Index b) {
    const double x = values[static_cast<std::size_t>(a)], y = values[static_cast<std::size_t>(b)];
    return x != y ? x > y : a < b;
  });
  Kept kept(values.size(), char{0});
  for (Index i = 0; i < count; ++i) kept[static_cast<std::size_t>(order[static_cast<std::size_t>(i)])] = 1;
  return kept;
}

ModelPtr keep(const Model& model, const Kept& kept) {
  ModelParts parts = model.parts();
  auto flag = kept.begin();
  for (int level = 0; level < model.levels(); ++level) {
    auto details = std::make_shared<Points>(model.details(level));
    for (Index i = 0; i < details->count(); ++i)
      if (!*flag++) details->matrix().row(i).setZero();
    parts.details[static_cast<std::size_t>(level)] = std::move(details);
  }
  return std::make_shared<Model>(std::move(parts));
}

}  // namespace ifsm::core
