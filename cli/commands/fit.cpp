// ifsm fit: samples in, model out.
#include <unistd.h>

#include <memory>
#include <optional>

#include "commands/command.h"
#include "curves.h"
#include "failure.h"
#include "files.h"
#include "progress.h"
#include "report.h"

namespace cli {
namespace {

struct FitArguments {
  std::string input;
  std::string output;
  std::vector<std::string> columns;
  bool closed = false;
  std::vector<std::int64_t> budgets;
  std::string control_points;
  std::string maps;
  std::string filter;
  std::string stage = "sparse";
  std::optional<int> levels;
  std::string format;
  int iterations = 0;  // 0: the library's default, here and below
  int rounds = 0;
  std::optional<int> polish;
  int threads = 0;
  bool no_fit = false;
  Talk talk;
};

constexpr int chosen_by_library = -1;
constexpr int no_polish = -1;
constexpr int no_levels = -1;

int shape_number(const std::string& text) {
  if (text.empty()) return 0;
  return text == "auto" ? chosen_by_library : std::stoi(text);
}

CLI::Validator number_or_auto(int low, int high) {
  const auto range = std::to_string(low) + " to " + std::to_string(high) + ", or auto";
  return CLI::Validator(
      [=](std::string& text) {
        int value = 0;
        const bool fine = text == "auto" || (CLI::detail::lexical_cast(text, value) && value >= low && value <= high);
        return fine ? std::string() : "'" + text + "' is not " + range;
      },
      range);
}

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

ifsm::Format format_of(const FitArguments& arguments) {
  if (!arguments.format.empty()) return arguments.format == "json" ? ifsm::Format::json : ifsm::Format::cbor;
  return ends_with(arguments.output, ".json") ? ifsm::Format::json : ifsm::Format::cbor;
}

// What can be known to fail is said before the computation, not after it.
void check_arguments(const FitArguments& arguments) {
  const bool automatic = arguments.control_points == "auto" || arguments.maps == "auto";
  if (automatic && arguments.no_fit)
    throw Failure(Exit::Usage, "auto chooses by fitting; with --no-fit give numbers to --control-points and --maps.");
  const bool of_sparse = automatic || !arguments.budgets.empty() || arguments.rounds != 0 || arguments.polish;
  if (of_sparse && arguments.stage != "sparse")
    throw Failure(Exit::Usage,
                  "--budget, --rounds, --polish and the shape auto are for --stage sparse; leave them out, "
                  "or fit that stage.");
  if (arguments.levels && arguments.stage != "filter")
    throw Failure(Exit::Usage, "--levels is for --stage filter: the levels whose details its filter is to tell well.");
  if (automatic && !arguments.filter.empty())
    throw Failure(Exit::Usage, "auto chooses the shape, --filter has one already; give only one of them.");
  refuse_json_beside_result(arguments.talk, arguments.output);
  if (arguments.output == "-" && format_of(arguments) == ifsm::Format::cbor && isatty(STDOUT_FILENO))
    throw Failure(Exit::Usage, "CBOR is not for a terminal; add --format json, or name a file with -o.");
  check_writable(arguments.output);
}

ifsm::Filter start_filter(const FitArguments& arguments, const std::string& name) {
  return named_filter(name, shape_number(arguments.control_points), shape_number(arguments.maps));
}

void check_joined(const ifsm::Filter& filter, const std::string& name) {
  if (filter.describe().topology != IFSM_TOPOLOGY_JOINED)
    throw Failure(Exit::Usage, "--filter: '" + name +
                                   "' is a square filter, and a fit starts from a joined one; use "
                                   "casteljau, or add --no-fit to use the filter as it is.");
}

ifsm::Model exact_model(const FitArguments& arguments, const Samples& samples) {
  return {start_filter(arguments, arguments.filter.empty() ? "casteljau" : arguments.filter), samples.curve()};
}

// What the options of all stages have.
template <class Options>
Options common_options(const FitArguments& arguments, const ifsm::Filter& start, const ifsm::Cancel& token,
                       Progress& progress) {
  Options options;
  options.threads = arguments.threads;
  options.start = arguments.filter.empty() ? nullptr : &start;
  options.control_points = shape_number(arguments.control_points);
  options.maps = shape_number(arguments.maps);
  options.iterations = arguments.iterations;
  options.cancel = &token;
  options.progress = [&progress](double fraction, const std::string& stage) {
    progress.update(fraction, stage);
    return false;
  };
  return options;
}

ifsm::Fit fitted_stage(const FitArguments& arguments, const ifsm::Curve& curve, const ifsm::Filter& start,
                       const ifsm::Cancel& token, Progress& progress) {
  if (arguments.stage == "curve")
    return ifsm::fit_curve({curve}, common_options<ifsm::FitCurveOptions>(arguments, start, token, progress));
  if (arguments.stage == "filter") {
    auto options = common_options<ifsm::FitFilterOptions>(arguments, start, token, progress);
    if (arguments.levels) options.kept_levels = *arguments.levels > 0 ? *arguments.levels : no_levels;
    return ifsm::fit_filter({curve}, options);
  }
  auto options = common_options<ifsm::FitOptions>(arguments, start, token, progress);
  options.budgets = arguments.budgets;
  options.rounds = arguments.rounds;
  if (arguments.polish) options.polish = *arguments.polish > 0 ? *arguments.polish : no_polish;
  return ifsm::fit_sparse({curve}, options);
}

ifsm::Fit fitted(const FitArguments& arguments, const Samples& samples, Session& session) {
  ifsm::Filter start;
  if (!arguments.filter.empty()) {
    start = start_filter(arguments, arguments.filter);
    check_joined(start, arguments.filter);
  }
  const Interrupt::Cancellable job(session.interrupt);
  Progress progress("fit", Progress::style_of_terminal(arguments.talk.quiet));
  auto fit = fitted_stage(arguments, samples.curve(), start, job.token(), progress);
  job.confirm();
  return fit;
}

// ---- the report

const char* reason_name(std::int32_t reason) {
  switch (reason) {
    case IFSM_FIT_CONVERGED: return "converged";
    case IFSM_FIT_ITERATIONS: return "all iterations used";
    case IFSM_FIT_START_BEST: return "nothing better than the start";
  }
  return "unknown";
}

Json fit_report(const ifsm::Fit& fit) {
  const auto report = fit.describe();
  Json json{{"reason", reason_name(report.reason)},
            {"iterations", report.iterations},
            {"start_cost", report.start_cost},
            {"final_cost", report.final_cost},
            {"start_condition", report.start_condition},
            {"final_condition", report.final_condition},
            {"budgets", Json::array()}};
  for (std::int64_t i = 0; i < report.budgets; ++i) {
    const auto row = fit.describe_budget(0, i);
    json["budgets"].push_back({{"budget", row.budget},
                               {"details", row.details},
                               {"start_rms", row.start_rms},
                               {"start_max", row.start_max},
                               {"rms", row.rms},
                               {"max", row.max}});
  }
  return json;
}

Json model_report(const FitArguments& arguments, const ifsm::Model& model, std::size_t bytes) {
  const auto info = model.describe();
  return {{"input", input_name(arguments.input)},
          {"output", arguments.output},
          {"format", format_of(arguments) == ifsm::Format::json ? "json" : "cbor"},
          {"bytes", bytes},
          {"samples", info.samples},
          {"dimension", info.dimension},
          {"closed", info.closed == 1},
          {"levels", info.levels},
          {"control_points", info.control_points},
          {"maps", info.maps},
          {"details", info.details}};
}

std::string in_words(const Json& report) {
  const auto number = [](const Json& value) { return std::to_string(value.get<std::int64_t>()); };
  std::string text = report["input"].get<std::string>() + ": " + number(report["samples"]) + " samples, dimension " +
                     number(report["dimension"]) + (report["closed"] ? ", closed\n" : ", open\n") +
                     report["output"].get<std::string>() + ": " + number(report["levels"]) +
                     " levels, n = " + number(report["control_points"]) + ", N = " + number(report["maps"]) + ", " +
                     number(report["bytes"]) + " bytes of " + report["format"].get<std::string>() + "\n";
  if (!report.contains("fit")) return text;
  const auto& fit = report["fit"];
  text += number(fit["iterations"]) + " iterations (" + fit["reason"].get<std::string>() + "), condition of R " +
          rounded(fit["start_condition"]) + " -> " + rounded(fit["final_condition"]) + "\n\n";
  std::vector<std::vector<std::string>> rows;
  for (const auto& row : fit["budgets"])
    rows.push_back({number(row["budget"]), number(row["details"]), rounded(row["start_rms"]), rounded(row["rms"]),
                    rounded(row["start_max"]), rounded(row["max"])});
  return text + aligned({"budget", "details", "start RMS", "fitted RMS", "start max", "fitted max"}, rows);
}

void run(const FitArguments& arguments, Session& session) {
  check_arguments(arguments);
  const auto samples = read_samples(arguments.input, arguments.columns, arguments.closed);
  if (!arguments.talk.quiet)
    for (const auto& text : samples.notes) note(text);

  ifsm::Model model;
  Json json_of_fit;
  if (arguments.no_fit) {
    model = exact_model(arguments, samples);
  } else {
    const auto fit = fitted(arguments, samples, session);
    model = fit.model(0);
    json_of_fit = fit_report(fit);
  }
  const auto bytes = save_model(model, format_of(arguments), arguments.output);

  if (arguments.output == "-") return;
  auto report = model_report(arguments, model, bytes);
  if (!json_of_fit.is_null()) report["fit"] = json_of_fit;
  if (arguments.talk.json)
    print(report);
  else if (!arguments.talk.quiet)
    print(in_words(report));
}

}  // namespace

void add_fit(CLI::App& program, Session& session) {
  auto* command = program.add_subcommand("fit", "Fit a model to the ordered points of a table");
  auto arguments = std::make_shared<FitArguments>();
  auto& a = *arguments;
  command->add_option("table", a.input, "Points, one a line, 1 to 4 numbers each; - is standard input")->required();
  command->add_option("-o,--output", a.output, "Model to write; - is standard output")->required();
  command->add_option("--columns", a.columns, "Columns to read, by header or number from 1, e.g. x,y")
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_flag("--closed", a.closed, "The curve is a ring: the last point joins the first");
  auto* budget = command
                     ->add_option("--budget", a.budgets,
                                  "Sizes of sketches to be good at, control points and details together, e.g. 32,128 "
                                  "(default 128)")
                     ->delimiter(',')
                     ->allow_extra_args(false)
                     ->check(CLI::PositiveNumber);
  command->add_option("--control-points", a.control_points, "Points of a control polygon, n (default 5)")
      ->check(number_or_auto(1, 16));
  command->add_option("--maps", a.maps, "Pieces that a polygon is cut into, N (default 2)")
      ->check(number_or_auto(2, 8));
  auto* stage = command
                    ->add_option("--stage", a.stage,
                                 "What to fit: sparse, the whole filter, so that few details tell the curve (default); "
                                 "curve, control points and T alone; filter, U alone")
                    ->check(CLI::IsMember({"sparse", "curve", "filter"}));
  auto* levels = command
                     ->add_option("--levels", a.levels,
                                  "Stage filter: levels whose details are to tell the curve (default 3); 0 for none")
                     ->check(CLI::Range(0, 40));
  command->add_option("--filter", a.filter, "Where to start (default casteljau); an unknown name lists the known ones");
  command->add_option("--format", a.format, "json or cbor (default: json when the name ends in .json, else cbor)")
      ->check(CLI::IsMember({"json", "cbor"}));
  auto* iterations = command->add_option("--iterations", a.iterations, "At most so many a round (default 40)")
                         ->check(CLI::Range(1, 1000));
  auto* rounds = command->add_option("--rounds", a.rounds, "How often the scale of sparsity is estimated (default 2)")
                     ->check(CLI::Range(1, 100));
  auto* polish = command->add_option("--polish", a.polish, "Rounds on the sketches' own error (default 8); 0 for none")
                     ->check(CLI::Range(0, 100));
  command->add_option("--threads", a.threads, "Threads to use (default: one a core); results do not depend on it")
      ->check(CLI::Range(1, 1024));
  command->add_flag("--no-fit", a.no_fit, "The exact model under the filter as it is")
      ->excludes(budget)
      ->excludes(iterations)
      ->excludes(rounds)
      ->excludes(polish)
      ->excludes(stage)
      ->excludes(levels);
  add_talk(*command, a.talk);
  command->footer(
      "Examples:\n"
      "  ifsm fit coast.csv --closed --budget 32,128 -o coast.ifsm\n"
      "  ifsm fit track.csv --columns lon,lat --control-points auto -o track.json\n"
      "  ifsm fit profile.csv --stage curve --control-points 4 -o profile.ifsm\n"
      "  ifsm fit profile.csv --no-fit --filter casteljau --control-points 4 -o profile.ifsm\n");
  command->callback([arguments, &session] { run(*arguments, session); });
}

}  // namespace cli
