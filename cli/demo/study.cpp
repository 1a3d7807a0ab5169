#include "demo/study.h"

#include <utility>

#include "failure.h"
#include "models.h"
#include "report.h"

namespace demo {
namespace {

constexpr const char* start_name = "coast";

// Free numbers of a joined R: every entry but the fixed end columns and the columns' sums.
std::int64_t free_numbers(const ifsm_filter_info& filter) {
  const std::int64_t n = filter.control_points, maps = filter.maps;
  return ((n - 1) * maps - 1) * (n - 1) * maps;
}

Sketch measured(const cli::Samples& samples, const ifsm::Model& sketch, std::int64_t vectors, std::int64_t of_filter) {
  auto points = sketch.samples();
  const auto apart = cli::distance(samples.points, points, samples.dimension);
  return {std::move(points), apart, vectors * samples.dimension + of_filter};
}

ifsm::Fit fitted(const cli::Samples& samples, const ifsm::Filter& start, std::int64_t budget,
                 const Progress& progress) {
  ifsm::FitOptions options;
  options.start = &start;
  options.budgets = {budget};
  options.progress = progress;
  return ifsm::fit_sparse({samples.curve()}, options);
}

}  // namespace

Plan plan(const std::string& path) {
  cli::Reading ring;
  ring.closed = true;
  Plan plan{cli::read_curves(path, ring).all.front(), {}, 0};
  if (plan.samples.dimension != 2)
    throw cli::Failure(cli::Exit::Input, path + " has points of dimension " + std::to_string(plan.samples.dimension) +
                                             "; the demo draws a coast of two columns.");
  const auto info = ifsm::Model(cli::start_filter(start_name, 0, 0), plan.samples.curve()).describe();
  for (std::int64_t budget = 8; budget <= 512 && budget <= info.control_points + info.details; budget *= 2) {
    plan.budgets.push_back(budget);
    if (budget <= 128) plan.shown_budget = budget;
  }
  if (plan.budgets.empty())
    throw cli::Failure(cli::Exit::Input, path + " has " + cli::counted(std::size_t(info.samples), "point") +
                                             ", too few for a sketch of 8 control points and details.");
  return plan;
}

Study study(Plan plan, const Progress& progress) {
  const auto& budgets = plan.budgets;
  Study study{std::move(plan.samples), plan.shown_budget, {}, 0, {}};
  const auto start = cli::start_filter(start_name, 0, 0);
  const ifsm::Model exact(start, study.samples.curve());
  study.numbers_of_filter = free_numbers(start.describe());
  for (std::size_t i = 0; i < budgets.size(); ++i) {
    const auto share = [&, i](double fraction, const std::string&) {
      return progress((double(i) + fraction) / double(budgets.size()), "K = " + std::to_string(budgets[i]));
    };
    const auto fit = fitted(study.samples, start, budgets[i], share);
    const auto details = fit.describe_budget(0, 0).details;
    const auto vectors = budgets[i] - (study.samples.closed ? 1 : 0);  // closed: the last control point is the first
    const auto from_start = exact.keep(ifsm::most_significant(details).resolved(ifsm::Resolve::choice));
    study.rows.push_back({budgets[i], details, measured(study.samples, from_start, vectors, 0),
                          measured(study.samples, fit.sketch(0, 0), vectors, study.numbers_of_filter)});
    if (budgets[i] == study.shown_budget) study.model = fit.model(0);
  }
  return study;
}

std::string table_of(const Study& study) {
  std::vector<std::vector<std::string>> rows;
  for (const auto& [budget, details, start, fitted] : study.rows)
    rows.push_back({std::to_string(budget), std::to_string(details), cli::rounded(start.distance.rms),
                    cli::rounded(fitted.distance.rms), cli::rounded(start.distance.max),
                    cli::rounded(fitted.distance.max), std::to_string(start.numbers), std::to_string(fitted.numbers)});
  return std::to_string(study.model.describe().samples) +
         " samples told by K vectors, control points and details together: distances in km\n\n" +
         cli::aligned(
             {"K", "details", "start RMS", "fitted RMS", "start max", "fitted max", "start numbers", "fitted numbers"},
             rows) +
         "\nstart: " + start_name +
         " as it is; fitted: the same after a fit at this K. The choice of details is bettered and\n"
         "their values are solved under both filters. numbers: K vectors, but for the control point that closes the\n"
         "ring, and the fitted filter's own " +
         std::to_string(study.numbers_of_filter) +
         "; which details were kept costs both sides the same and is\nnot counted.\n";
}

}  // namespace demo
