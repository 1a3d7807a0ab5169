#include "figures/errors.h"

namespace figures {
namespace {

using plot::Point;
using plot::Scale;

SketchError error_of(const ifsm::Model& model, std::int64_t size, ifsm::Keep rule, ifsm::Resolve resolve,
                     const ifsm::Cancel& cancel) {
  const auto sketch = model.keep(rule.resolved(resolve).cancelled_by(cancel));
  const auto info = sketch.describe();
  return {size, info.details_kept, cli::distance(model.samples(), sketch.samples(), info.dimension)};
}

std::vector<Point> points_of(const ErrorLine& line, double cli::Distance::*measure, double least) {
  std::vector<Point> points;
  for (std::size_t i = 0; i < line.at.size(); ++i)
    if (line.apart[i].*measure > least) points.push_back({line.at[i], line.apart[i].*measure});
  return points;
}

}  // namespace

std::vector<SketchError> errors_by_level(const ifsm::Model& model, const ifsm::Cancel& cancel) {
  std::vector<SketchError> errors;
  for (int level = 0; level < model.describe().levels; ++level)
    errors.push_back(error_of(model, level, ifsm::first_levels(level), ifsm::Resolve::values, cancel));
  return errors;
}

std::vector<SketchError> errors_by_budget(const ifsm::Model& model, const ifsm::Cancel& cancel) {
  constexpr std::int64_t first = 8, last = 1024;  // larger ones are no sketches, and take long to choose
  const auto info = model.describe();
  std::vector<SketchError> errors;
  for (std::int64_t budget = first; budget <= last && budget - info.control_points < info.details_kept; budget *= 2)
    if (budget >= info.control_points)
      errors.push_back(
          error_of(model, budget, ifsm::most_significant(budget - info.control_points), ifsm::Resolve::choice, cancel));
  return errors;
}

plot::Panel error_panel(const std::vector<ErrorLine>& lines, double least) {
  plot::Panel panel;
  panel.y.kind = Scale::Kind::Logarithmic;
  bool any = false;
  for (const auto& line : lines) {
    const double width = line.wide ? 3.6 : 2.6, radius = line.wide ? 8 : 5.5;
    const auto start = line.name.empty() ? "" : line.name + ", ";
    const auto add = [&](double cli::Distance::*measure, std::vector<double> dashes, const std::string& label) {
      const auto points = points_of(line, measure, least);
      if (points.empty()) return;
      panel.line(points, {line.colour, width, std::move(dashes)}, label);
      panel.dots(points, radius, line.colour);
      any = true;
    };
    add(&cli::Distance::max, {12, 8}, start + "largest");
    add(&cli::Distance::rms, {}, start + "RMS");
  }
  if (!any) panel.words = "No sketch is farther off than rounding.";
  return panel;
}

}  // namespace figures
