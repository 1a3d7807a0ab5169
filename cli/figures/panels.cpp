#include "figures/panels.h"

#include <algorithm>
#include <cmath>

#include "figures/errors.h"
#include "figures/lines.h"
#include "figures/scalogram.h"

namespace figures {
namespace {

using cli::Json;
using plot::Scale;
namespace colours = plot::palette;

const plot::Stroke curve_stroke{colours::ink, 1.4, {}};
const plot::Stroke faint_stroke{plot::mix(colours::muted, colours::ink, 0.2), 1.2, {}};
constexpr std::size_t few = 60;       // points that are seen one by one
constexpr double rounding = 1e-12;    // of the diagonal: what a model promises its samples to
constexpr std::int64_t along = 4096;  // steps of a curve that has no samples of its own

Json json_of(const std::vector<double>& points, int dimension) {
  Json rows = Json::array();
  const auto d = static_cast<std::ptrdiff_t>(dimension);
  for (auto first = points.begin(); first != points.end(); first += d)
    rows.push_back(std::vector<double>(first, first + d));
  return rows;
}

Json json_of(const std::vector<SketchError>& errors, const std::string& size) {
  Json rows = Json::array();
  for (const auto& [number, details, apart] : errors)
    rows.push_back({{size, number}, {"details", details}, {"rms", apart.rms}, {"max", apart.max}});
  return rows;
}

ErrorLine line_of(const std::vector<SketchError>& errors) {
  ErrorLine line{{}, {}, "", colours::blue};
  for (const auto& error : errors)
    line.at.push_back(static_cast<double>(error.size)), line.apart.push_back(error.apart);
  return line;
}

// The finest curve as a line, and the panel with its axes.
std::vector<plot::Point> finest(const ifsm::Model& model, const ifsm_model_info& info) {
  return figures::line_of(model.points(info.levels), info.dimension, false);
}

}  // namespace

Shown samples_panel(const std::vector<cli::Samples>& curves) {
  const int dimension = curves.front().dimension;
  Shown shown{plane_panel(dimension), Json::array()};
  std::size_t count = 0;
  for (const auto& samples : curves) count += samples.points.size() / static_cast<std::size_t>(dimension);
  for (const auto& samples : curves) {
    const auto line = figures::line_of(samples.points, dimension, samples.closed);
    add_inside(shown.panel, line, dimension, samples.closed);
    shown.panel.line(line, curve_stroke);
    if (count <= few) shown.panel.dots(line, 4.5, colours::blue);
    shown.numbers.push_back(
        {{"name", samples.name}, {"closed", samples.closed}, {"points", json_of(samples.points, dimension)}});
  }
  shown.panel.title =
      (curves.size() > 1 ? cli::counted(curves.size(), "curve") + ", " : "") + cli::counted(count, "sample");
  return shown;
}

Shown curve_panel(const ifsm::Model& model) {
  const auto info = model.describe();
  Shown shown{plane_panel(info.dimension), {{"points", json_of(model.points(info.levels), info.dimension)}}};
  const auto line = finest(model, info);
  add_inside(shown.panel, line, info.dimension, info.closed == 1);
  shown.panel.line(line, curve_stroke);
  shown.panel.title = "The curve, " + cli::counted(static_cast<std::size_t>(info.details_kept), "detail");
  return shown;
}

Shown polygon_panel(const ifsm::Model& model) {
  const auto info = model.describe();
  const auto points = model.control_points();
  Shown shown{plane_panel(info.dimension), {{"points", json_of(points, info.dimension)}}};
  const auto curve = finest(model, info), polygon = figures::line_of(points, info.dimension, false);
  add_inside(shown.panel, curve, info.dimension, info.closed == 1);
  shown.panel.line(curve, curve_stroke, "curve");
  shown.panel.line(polygon, {colours::blue, 2.5, {12, 7}}, "control polygon");
  shown.panel.dots(polygon, 8, colours::blue);
  const bool last_repeats = info.closed == 1 && polygon.size() > 1 &&
                            points.front() == points[points.size() - static_cast<std::size_t>(info.dimension)];
  for (std::size_t i = 0; i + (last_repeats ? 1 : 0) < polygon.size(); ++i)
    shown.panel.name(polygon[i], "p" + std::to_string(i), {24, -22});
  shown.panel.title = "Control polygon, " + cli::counted(polygon.size(), "point");
  return shown;
}

Shown attractor_panel(const ifsm::Model& model) {
  const auto info = model.describe();
  const auto bare = model.keep(ifsm::first_levels(0));
  std::vector<double> parameters;
  for (std::int64_t k = 0; k <= along; ++k) parameters.push_back(static_cast<double>(k) / static_cast<double>(along));
  if (info.closed == 1) parameters.pop_back();  // it is the first again
  const auto points = bare.evaluate(parameters, ifsm::Follow::limit);
  Shown shown{plane_panel(info.dimension), {{"points", json_of(points, info.dimension)}}};
  const auto curve = finest(model, info);
  shown.panel.line(curve, faint_stroke, "curve");
  shown.panel.line(figures::line_of(points, info.dimension, info.closed == 1), {colours::orange, 2.2, {}},
                   "without details");
  shown.panel.title = "Attractor: the control polygon's limit";
  return shown;
}

Shown levels_panel(const ifsm::Model& model, const ifsm::Cancel& cancel) {
  const auto errors = errors_by_level(model, cancel);
  Shown shown{error_panel({line_of(errors)}, rounding * model.describe().diagonal), json_of(errors, "levels")};
  shown.panel.title = "Error by level";
  shown.panel.x.label = "levels of details kept";
  shown.panel.y.label = "distance from the curve";
  shown.panel.x.range = plot::Range{-0.3, std::max<double>(model.describe().levels, 1) - 0.7};
  for (int level = 0; level < std::max(model.describe().levels, 1); ++level)
    shown.panel.x.ticks.push_back({static_cast<double>(level), std::to_string(level)});
  return shown;
}

Shown budgets_panel(const ifsm::Model& model, const ifsm::Cancel& cancel) {
  const auto errors = errors_by_budget(model, cancel);
  Shown shown{error_panel({line_of(errors)}, rounding * model.describe().diagonal), json_of(errors, "budget")};
  shown.panel.title = "Error by K, best sketches";
  shown.panel.x.kind = Scale::Kind::Logarithmic;
  shown.panel.x.label = "K: control points and details";
  shown.panel.y.label = "distance from the curve";
  for (const auto& error : errors)
    shown.panel.x.ticks.push_back({static_cast<double>(error.size), std::to_string(error.size)});
  if (errors.empty()) shown.panel.words = "The curve has too few details for a sketch of 8 vectors.";
  return shown;
}

Shown scalogram_of(const ifsm::Model& model) {
  const auto effects = node_effects(model);
  Shown shown{scalogram_panel(model, effects, ""), effects};
  shown.panel.title = "Scalogram: details by place and scale";
  return shown;
}

Shown residuals_panel(const std::vector<double>& curve, const std::vector<double>& other, int dimension, bool closed,
                      const std::string& title) {
  const auto at = lengths(curve, dimension, closed);
  const auto d = static_cast<std::size_t>(dimension);
  std::vector<plot::Point> line;
  std::vector<double> distances;
  for (std::size_t k = 0; k * d < curve.size(); ++k) {
    double apart = 0;
    for (std::size_t i = k * d; i < (k + 1) * d; ++i) apart = std::hypot(apart, curve[i] - other[i]);
    distances.push_back(apart);
    line.push_back({at[k], distances.back()});
  }
  const auto apart = cli::distance(curve, other, dimension);
  Shown shown{{}, {{"rms", apart.rms}, {"max", apart.max}, {"distances", distances}}};
  shown.panel.line(line, {colours::blue, 1.4, {}});
  shown.panel.line({{0, apart.rms}, {at.back(), apart.rms}}, {colours::orange, 2, {12, 7}},
                   "RMS " + cli::rounded(apart.rms));
  shown.panel.title = title;
  shown.panel.x.label = position_label(dimension);
  shown.panel.y.label = "distance";
  shown.panel.y.range = plot::Range{0, apart.max > 0 ? 1.05 * apart.max : 1};
  return shown;
}

}  // namespace figures
