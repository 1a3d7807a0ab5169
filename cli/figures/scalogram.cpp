#include "figures/scalogram.h"

#include <algorithm>
#include <cmath>

#include "figures/lines.h"

namespace figures {
namespace {

using plot::Cell;
using plot::Scale;

constexpr std::size_t most_cells = 800;  // across: more than a page shows
constexpr double shades = 128;           // of the scale: more than an eye tells apart

std::vector<double> effects_of_level(const ifsm::Model& model, int level, const ifsm_model_info& info) {
  const auto values = model.significance(level);
  const auto per_node = static_cast<std::size_t>(info.details_per_node);
  std::vector<double> effects;
  for (std::size_t first = 0; first < values.size(); first += per_node) {
    double energy = 0;
    for (std::size_t i = first; i < first + per_node; ++i) energy += values[i] * values[i];
    effects.push_back(std::sqrt(energy / static_cast<double>(info.places)));
  }
  return effects;
}

// From the largest effect down over as many decades as a reader tells apart.
Scale scale_of(const std::vector<std::vector<double>>& effects) {
  constexpr double decades = 4;
  double largest = 0;
  for (const auto& row : effects)
    for (const double effect : row) largest = std::max(largest, effect);
  if (largest == 0) largest = 1;
  return {Scale::Kind::Logarithmic, largest / std::pow(10, decades), largest};
}

// Position along the curve over the parameter.
class Positions {
 public:
  explicit Positions(const ifsm::Model& model) : parameters_(model.parameters()) {
    const auto info = model.describe();
    const bool closed = info.closed == 1;
    along_ = lengths(model.samples(), info.dimension, closed);
    if (closed) parameters_.push_back(1);
  }
  double at(double parameter) const { return interpolated(parameters_, along_, parameter); }
  double whole() const { return along_.back(); }

 private:
  std::vector<double> parameters_, along_;
};

// Neighbours that no page tells apart share a cell, which shows the largest; so do neighbours of one colour.
void append_cells(const std::vector<double>& row, std::size_t level, const Positions& positions, const Scale& scale,
                  std::vector<Cell>& cells) {
  const std::size_t count = std::min(row.size(), most_cells);
  const auto y = -static_cast<double>(level);  // coarse levels at the top: minus level grows upwards
  double last_shade = 0;
  for (std::size_t cell = 0; cell < count; ++cell) {
    const std::size_t first = cell * row.size() / count, last = (cell + 1) * row.size() / count;
    const double effect = *std::max_element(row.begin() + static_cast<std::ptrdiff_t>(first),
                                            row.begin() + static_cast<std::ptrdiff_t>(last));
    const double shade = std::round(scale.share(std::max(effect, scale.low())) * shades) / shades;
    const auto place = [&](std::size_t node) {
      return positions.at(static_cast<double>(node) / static_cast<double>(row.size()));
    };
    if (cell > 0 && shade == last_shade)
      cells.back().x.high = place(last);
    else
      cells.push_back({{place(first), place(last)}, {y - 0.5, y + 0.5}, plot::viridis(shade)});
    last_shade = shade;
  }
}

}  // namespace

std::vector<std::vector<double>> node_effects(const ifsm::Model& model) {
  const auto info = model.describe();
  std::vector<std::vector<double>> effects;
  for (int level = 0; level < info.levels; ++level) effects.push_back(effects_of_level(model, level, info));
  return effects;
}

plot::Panel scalogram_panel(const ifsm::Model& model, const std::vector<std::vector<double>>& effects,
                            const std::string& unit) {
  const auto scale = scale_of(effects);
  const Positions positions(model);
  std::vector<Cell> cells;
  for (std::size_t level = 0; level < effects.size(); ++level)
    append_cells(effects[level], level, positions, scale, cells);
  plot::Panel panel;
  panel.cells(cells);
  panel.colour_bar(scale, "RMS change of the whole curve" + unit + " (log)");
  panel.x.label = position_label(model.describe().dimension) + unit;
  panel.y.label = "level (0: coarsest)";
  for (std::size_t level = 0; level < effects.size(); ++level)
    panel.y.ticks.push_back({-static_cast<double>(level), std::to_string(level)});
  panel.x.range = plot::Range{0, positions.whole()};
  panel.y.range = plot::Range{0.5 - static_cast<double>(effects.size()), 0.5};
  if (effects.empty()) panel.words = "The model has no levels, and so no details.", panel.y.range = plot::Range{0, 1};
  return panel;
}

}  // namespace figures
