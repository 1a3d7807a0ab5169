#include "commands/fitting.h"

#include <utility>

#include "commands/values.h"
#include "failure.h"
#include "models.h"
#include "progress.h"

namespace cli {
namespace {

constexpr int chosen_by_library = -1;
constexpr int no_polish = -1;
constexpr int no_rounds = -1;
constexpr int no_levels = -1;

int shape_number(const std::string& text) {
  if (text.empty()) return 0;
  return text == "auto" ? chosen_by_library : std::stoi(text);
}

ifsm::Filter filter_of(const FitSettings& settings) {
  return start_filter(settings.filter, shape_number(settings.control_points), shape_number(settings.maps));
}

// What the options of all stages have.
template <class Options>
Options common_options(const FitSettings& settings) {
  Options options;
  options.threads = settings.threads;
  options.control_points = shape_number(settings.control_points);
  options.maps = shape_number(settings.maps);
  options.iterations = settings.iterations;
  return options;
}

ifsm::FitOptions options_of_sparse(const FitSettings& settings) {
  auto options = common_options<ifsm::FitOptions>(settings);
  options.budgets = settings.budgets;
  if (settings.rounds) options.rounds = *settings.rounds > 0 ? *settings.rounds : no_rounds;
  if (settings.polish) options.polish = *settings.polish > 0 ? *settings.polish : no_polish;
  options.within = settings.within;
  options.distance = distance_of(settings.distance);
  return options;
}

ifsm::FitFilterOptions options_of_filter(const FitSettings& settings) {
  auto options = common_options<ifsm::FitFilterOptions>(settings);
  if (settings.levels) options.kept_levels = *settings.levels > 0 ? *settings.levels : no_levels;
  return options;
}

// Budgets that a curve of so many points can hold for sure; none is the library's own choice.
std::vector<std::int64_t> fitting_budgets(const std::vector<std::int64_t>& budgets, const Samples& samples) {
  const auto points = static_cast<std::int64_t>(samples.points.size()) / samples.dimension;
  std::vector<std::int64_t> fitting;
  for (const auto budget : budgets)
    if (budget <= points) fitting.push_back(budget);
  return fitting;
}

// What fails on one curve of several says which.
template <class Work>
auto naming(const std::string& curve, const Work& work) {
  try {
    return work();
  } catch (const ifsm::Cancelled&) {
    throw;
  } catch (const ifsm::Error& error) {
    refuse_shape(error);
    refuse_bound(error);
    refuse_budget(error);
    if (curve.empty()) throw;
    throw Failure(error.status == IFSM_ERROR_RANGE ? Exit::Usage : Exit::Computing, curve + ": " + error.what());
  }
}

class Fitting {
 public:
  Fitting(const std::vector<Samples>& curves, const FitSettings& settings, bool quiet)
      : curves_(curves), settings_(settings), progress_("fit", Progress::style_of_terminal(quiet)) {
    if (settings.no_fit || !settings.filter.empty()) filter_ = filter_of(settings);
    if (!settings.no_fit && !settings.filter.empty()) require_joined(filter_, settings.filter);
  }

  FittedModel model_of(std::size_t number, const ifsm::Cancel& token) {
    const auto& samples = curves_[number];
    if (settings_.no_fit) return unfitted(samples, number, token);
    auto fit = fit_of(samples, number, token);
    auto exact = fit.model(0);
    if (!settings_.sketch && settings_.within == 0) return {std::move(exact), std::nullopt, std::move(fit)};
    auto sketch = fit.sketch(0, fit.describe().budgets - 1);
    const auto apart = exact.distance(sketch);
    return {settings_.sketch ? std::move(sketch) : std::move(exact), apart, std::move(fit)};
  }

 private:
  FittedModel unfitted(const Samples& samples, std::size_t number, const ifsm::Cancel& token) {
    ifsm::Model exact(filter_, samples.curve());
    if (!settings_.sketch) return {std::move(exact), std::nullopt, std::nullopt};
    auto rule = ifsm::within(settings_.within, distance_of(settings_.distance)).resolved(ifsm::Resolve::choice);
    rule.cancelled_by(token).telling([this, number](double fraction, const std::string& stage) {
      tell(number, fraction, stage);
      return false;
    });
    auto sketch = kept_within(exact, rule);
    const auto apart = exact.distance(sketch);
    return {std::move(sketch), apart, std::nullopt};
  }

  ifsm::Fit fit_of(const Samples& samples, std::size_t number, const ifsm::Cancel& token) {
    const std::vector<ifsm::Curve> curve{samples.curve()};
    if (settings_.stage == "curve")
      return ifsm::fit_curve(curve, watched(common_options<ifsm::FitCurveOptions>(settings_), number, token));
    if (settings_.stage == "filter")
      return ifsm::fit_filter(curve, watched(options_of_filter(settings_), number, token));
    auto options = options_of_sparse(settings_);
    if (curves_.size() > 1) options.budgets = fitting_budgets(settings_.budgets, samples);
    return ifsm::fit_sparse(curve, watched(std::move(options), number, token));
  }

  template <class Options>
  Options watched(Options options, std::size_t number, const ifsm::Cancel& token) {
    options.start = settings_.filter.empty() ? nullptr : &filter_;
    options.cancel = &token;
    options.progress = [this, number](double fraction, const std::string& stage) {
      tell(number, fraction, stage);
      return false;
    };
    return options;
  }

  void tell(std::size_t number, double fraction, const std::string& stage) {
    const auto count = curves_.size();
    const auto which = count > 1 ? "curve " + std::to_string(number + 1) + " of " + std::to_string(count) + ", " : "";
    progress_.update((static_cast<double>(number) + fraction) / static_cast<double>(count), which + stage);
  }

  const std::vector<Samples>& curves_;
  const FitSettings& settings_;
  Progress progress_;
  ifsm::Filter filter_;
};

}  // namespace

std::vector<FittedModel> fitted_models(const std::vector<Samples>& curves, const FitSettings& settings,
                                       const std::string& source, bool quiet, Interrupt& interrupt) {
  const Interrupt::Cancellable job(interrupt);
  Fitting fitting(curves, settings, quiet);
  std::vector<FittedModel> models;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    std::string curve;
    if (curves.size() > 1) curve.append(source).append(", curve ").append(std::to_string(i + 1));
    if (!curve.empty() && !curves[i].place.empty()) curve.append(" (").append(curves[i].place).append(")");
    models.push_back(naming(curve, [&] { return fitting.model_of(i, job.token()); }));
    job.confirm();
  }
  return models;
}

}  // namespace cli
