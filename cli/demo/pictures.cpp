#include "demo/pictures.h"

#include <algorithm>
#include <cmath>

#include "figures/errors.h"
#include "figures/lines.h"
#include "figures/panels.h"
#include "figures/scalogram.h"
#include "plot/figure.h"
#include "report.h"

namespace demo {
namespace {

using namespace plot;
namespace colours = plot::palette;

const Stroke truth{mix(colours::muted, colours::ink, 0.2), 1.2, {}};
const Stroke fitted_stroke{colours::blue, 2.2, {}};
const Stroke start_stroke{colours::orange, 2.2, {}};

std::vector<Point> polyline(const std::vector<double>& points, bool closed) {
  return figures::line_of(points, 2, closed);
}

std::vector<Point> coast(const Study& study) { return polyline(study.samples.points, study.samples.closed); }

// Kilometres along the coast up to each sample, and the whole length.
std::vector<double> kilometres(const Study& study) {
  return figures::lengths(study.samples.points, study.samples.dimension, study.samples.closed);
}

std::string km(double value) { return cli::rounded(value, 3) + " km"; }

// A map of the coast, ready for a sketch to be laid over it.
Panel map_of(const Study& study) {
  Panel panel;
  panel.equal_aspect = true;
  panel.unit_of_length = "km";
  panel.area(coast(study), colours::land);
  panel.line(coast(study), truth);
  return panel;
}

// One range for all maps of a picture, so that they show the same piece of the plane at the same scale.
void share_ranges(std::vector<Panel>& panels, const std::vector<std::vector<Point>>& drawn) {
  Range x{1e300, -1e300}, y = x;
  for (const auto& line : drawn)
    for (const auto& point : line) {
      x = {std::min(x.low, point.x), std::max(x.high, point.x)};
      y = {std::min(y.low, point.y), std::max(y.high, point.y)};
    }
  const auto air = [](Range range) {
    const double extent = range.high - range.low;
    return Range{range.low - 0.03 * extent, range.high + 0.03 * extent};
  };
  for (auto& panel : panels) panel.x.range = air(x), panel.y.range = air(y);
}

// ---- the scalogram

struct Milestone {
  double kilometres;
  Point place;
  std::string name;
};

std::vector<Milestone> milestones(const Study& study) {
  const auto line = coast(study);
  const auto along = kilometres(study);
  std::vector<double> xs, ys;
  for (const auto& point : line) xs.push_back(point.x), ys.push_back(point.y);
  std::vector<Milestone> stones;
  for (const auto& tick : Scale(Scale::Kind::Linear, 0, along.back()).ticks(9))
    stones.push_back({tick.value,
                      {figures::interpolated(along, xs, tick.value), figures::interpolated(along, ys, tick.value)},
                      tick.label});
  return stones;
}

Panel milestone_map(const Study& study, const std::vector<Milestone>& stones) {
  Panel panel = map_of(study);
  panel.title = "Kilometres along the coast";
  std::vector<Point> places;
  Point middle;
  for (const auto& stone : stones) {
    places.push_back(stone.place);
    middle = {middle.x + stone.place.x / double(stones.size()), middle.y + stone.place.y / double(stones.size())};
  }
  panel.dots(places, 6, colours::orange);
  for (const auto& stone : stones) {
    const double dx = stone.place.x - middle.x, dy = stone.place.y - middle.y, reach = std::hypot(dx, dy);
    panel.name(stone.place, stone.name, {46 * dx / reach, -28 * dy / reach});
  }
  std::vector<Panel> one{panel};
  auto roomy = coast(study);
  for (auto& point : roomy) point = {middle.x + 1.15 * (point.x - middle.x), middle.y + 1.15 * (point.y - middle.y)};
  share_ranges(one, {roomy});
  return one.front();
}

Panel scalogram_panel(const Study& study, const std::vector<Milestone>& stones) {
  Panel panel = figures::scalogram_panel(study.model, figures::node_effects(study.model), " in km");
  panel.title = "What the details of each node do to the curve";
  panel.x.label = "position along the coast in km";
  for (const auto& stone : stones) panel.x.ticks.push_back({stone.kilometres, stone.name});
  return panel;
}

// ---- errors

figures::ErrorLine error_line(const Study& study, Sketch Row::*side, bool in_numbers) {
  const bool fitted = side == &Row::fitted;
  // The start is drawn wider, below: where both agree, both can be seen.
  figures::ErrorLine line{{}, {}, fitted ? "fitted" : "start", fitted ? colours::blue : colours::orange, !fitted};
  for (const auto& row : study.rows) {
    const auto& sketch = row.*side;
    line.at.push_back(double(in_numbers ? sketch.numbers : row.budget));
    line.apart.push_back(sketch.distance);
  }
  return line;
}

Panel error_panel(const Study& study, bool in_numbers) {
  Panel panel = figures::error_panel(
      {error_line(study, &Row::start, in_numbers), error_line(study, &Row::fitted, in_numbers)}, 0);
  panel.x.kind = Scale::Kind::Logarithmic;
  panel.y.label = "distance from the coast in km";
  panel.x.label = in_numbers ? "numbers stored" : "K: control points and details";
  panel.title = in_numbers ? "Counted in numbers stored, the filter's included" : "Counted in vectors";
  if (!in_numbers)
    for (const auto& row : study.rows) panel.x.ticks.push_back({double(row.budget), std::to_string(row.budget)});
  return panel;
}

}  // namespace

std::string coast_picture(const Study& study) {
  const auto info = study.model.describe();
  const bool ring = info.closed == 1;
  Panel panel = figures::polygon_panel(study.model).panel;
  panel.title.clear();
  panel.x.label = "east in km";
  panel.y.label = "north in km";
  Figure figure;
  figure.height = 1250;
  figure.title = "The coast and the polygon it grows from";
  figure.note = "The model: " + std::to_string(info.control_points) + " control points" +
                (ring ? " (the last is the first again)" : "") + ", one small matrix, and " +
                std::to_string(info.details) + " details on " + std::to_string(info.levels) +
                " levels. With all details it gives the samples back.";
  figure.panels = {panel};
  return figure.bytes(Format::Png);
}

std::string levels_picture(const Study& study) {
  const auto info = study.model.describe();
  Figure figure;
  figure.width = 2000;
  figure.height = 1500;
  figure.columns = 3;
  figure.title = "Level by level: the details of the first levels, and none of the finer ones";
  figure.note = "Grey: the coast. Blue: synthesis by the filter fitted at K = " + std::to_string(study.shown_budget) +
                ", the finer details zero, the control points and the other details solved for that.";
  std::vector<std::vector<Point>> drawn{coast(study)};
  for (int shown = 0; shown < 9; ++shown) {
    const int levels = std::min(shown, info.levels);
    const auto sketch = study.model.keep(ifsm::first_levels(levels).resolved());
    const auto apart = cli::distance(study.samples.points, sketch.samples(), info.dimension);
    drawn.push_back(polyline(sketch.points(info.levels), false));
    Panel panel = map_of(study);
    panel.line(drawn.back(), fitted_stroke);
    panel.title = std::to_string(levels) + (levels == 1 ? " level, " : " levels, ") +
                  std::to_string(sketch.describe().details_kept) + " details: RMS " + km(apart.rms);
    figure.panels.push_back(panel);
    if (levels == info.levels) break;
  }
  share_ranges(figure.panels, drawn);
  return figure.bytes(Format::Png);
}

std::string details_picture(const Study& study) {
  Figure figure;
  figure.width = 2000;
  figure.height = 1250;
  figure.columns = 3;
  figure.title = "The same number of vectors under two filters";
  figure.note =
      "K: control points and details together, chosen and solved alike in both rows. Grey: the coast. Upper row: the "
      "starting filter (coast, trained on other coasts). Lower row: the filter fitted to this coast at this K, which "
      "costs " +
      std::to_string(study.numbers_of_filter) + " numbers of its own.";
  std::vector<std::vector<Point>> drawn{coast(study)};
  const auto add = [&](Sketch Row::*side, const Stroke& stroke, const std::string& name) {
    for (const auto& row : study.rows) {
      if (study.rows.size() > 1 && row.budget != 16 && row.budget != 64 && row.budget != 256) continue;
      const auto& sketch = row.*side;
      drawn.push_back(polyline(sketch.points, study.samples.closed));
      Panel panel = map_of(study);
      panel.line(drawn.back(), stroke);
      panel.title = name + ", K = " + std::to_string(row.budget) + ": RMS " + km(sketch.distance.rms);
      figure.panels.push_back(panel);
    }
  };
  add(&Row::start, start_stroke, "start");
  figure.columns = static_cast<int>(figure.panels.size());  // a row each
  add(&Row::fitted, fitted_stroke, "fitted");
  share_ranges(figure.panels, drawn);
  return figure.bytes(Format::Png);
}

std::string scalogram_picture(const Study& study) {
  const auto stones = milestones(study);
  Figure figure;
  figure.width = 2000;
  figure.height = 1000;
  figure.columns = 2;
  figure.shares = {1, 1.4};
  figure.title = "Scalogram: where along the coast, and at which scale, the details are";
  figure.note =
      "Each cell is a node of the fitted model: as wide as its piece of the coast, coloured by its details together. "
      "Smaller changes than the scale shows have its darkest colour.";
  figure.panels = {milestone_map(study, stones), scalogram_panel(study, stones)};
  return figure.bytes(Format::Png);
}

std::string errors_picture(const Study& study) {
  Figure figure;
  figure.width = 2000;
  figure.height = 1050;
  figure.columns = 2;
  figure.title = "Error by budget, starting filter and fitted filter";
  figure.note =
      "Distances between samples and sketch; each fit is made for its own K, and details are chosen and solved alike "
      "under both filters. Numbers stored: two for each vector, and for the fitted filter its own " +
      std::to_string(study.numbers_of_filter) + ".";
  figure.panels = {error_panel(study, false), error_panel(study, true)};
  return figure.bytes(Format::Png);
}

}  // namespace demo
