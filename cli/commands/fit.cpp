// ifsm fit: samples in, models out.
#include <filesystem>
#include <memory>

#include "commands/command.h"
#include "commands/fit_report.h"
#include "commands/fitting.h"
#include "commands/values.h"
#include "failure.h"
#include "files.h"
#include "models.h"
#include "targets.h"

namespace cli {
namespace {

struct FitArguments {
  std::string input;
  Reading reading;
  FitSettings settings;
  std::string output;
  bool overwrite = false;
  std::string format;
  Talk talk;
};

ifsm::Format format_of(const FitArguments& arguments) { return cli::format_of(arguments.output, arguments.format); }

void check_tolerance(const FitSettings& settings) {
  const bool within = settings.within > 0;
  if (within && (settings.control_points == "auto" || settings.maps == "auto"))
    throw Failure(Exit::Usage, "auto chooses by the errors at budgets, --within has none; give only one of them.");
  if (within && settings.stage != "sparse")
    throw Failure(Exit::Usage, "--within is for --stage sparse; leave one of them out.");
  if (!settings.distance.empty() && !within)
    throw Failure(Exit::Usage, "--distance says what --within measures; add --within.");
  if (settings.sketch && settings.stage != "sparse")
    throw Failure(Exit::Usage, "--sketch is for --stage sparse; the other stages make sketches without details.");
  if (settings.no_fit && within != settings.sketch)
    throw Failure(Exit::Usage, "with --no-fit, --within and --sketch go together: the sketch that keeps the bound.");
}

// What can be known to fail is said before the computation, not after it.
void check_arguments(const FitArguments& arguments) {
  const auto& settings = arguments.settings;
  const bool automatic = settings.control_points == "auto" || settings.maps == "auto";
  if (automatic && settings.no_fit)
    throw Failure(Exit::Usage, "auto chooses by fitting; with --no-fit give numbers to --control-points and --maps.");
  if (automatic && !settings.filter.empty())
    throw Failure(Exit::Usage, "auto chooses the shape, --filter has one already; give only one of them.");
  const bool of_sparse = automatic || !settings.budgets.empty() || settings.rounds || settings.polish;
  if (of_sparse && settings.stage != "sparse")
    throw Failure(Exit::Usage,
                  "--budget, --rounds, --polish and the shape auto are for --stage sparse; leave them out, "
                  "or fit that stage.");
  if (settings.levels && settings.stage != "filter")
    throw Failure(Exit::Usage, "--levels is for --stage filter: the levels whose details its filter is to tell well.");
  check_tolerance(settings);
  refuse_json_beside_result(arguments.talk, arguments.output);
  refuse_binary_on_terminal(arguments.output, format_of(arguments));
}

Targets targets_of(const FitArguments& arguments, const std::vector<Samples>& curves) {
  const auto stem = arguments.input == "-" ? "curve" : std::filesystem::path(arguments.input).stem().string();
  std::vector<std::string> names;
  for (const auto& curve : curves) names.push_back(curve.name);
  return target_paths(arguments.output, stem, format_of(arguments) == ifsm::Format::json ? ".json" : ".ifsm", names);
}

Existing existing_of(const FitArguments& arguments, const Targets& targets) {
  return targets.made_up && !arguments.overwrite ? Existing::Refused : Existing::Replaced;
}

void check_targets(const FitArguments& arguments, const Targets& targets) {
  const auto filter = file_of_filter(arguments.settings.filter);
  for (const auto& path : targets.paths) {
    check_writable(path);
    check_not_read(path, {arguments.input, filter});
    check_absent(path, existing_of(arguments, targets));
  }
}

std::vector<File> files_of(const FitArguments& arguments, const Targets& targets,
                           const std::vector<FittedModel>& models) {
  std::vector<File> files;
  for (std::size_t i = 0; i < models.size(); ++i) {
    const auto bytes = models[i].model.save(format_of(arguments));
    files.push_back({targets.paths[i], {bytes.begin(), bytes.end()}});
  }
  return files;
}

Json report_of(const FitArguments& arguments, const Targets& targets, const std::vector<Samples>& curves,
               const std::vector<FittedModel>& models, const std::vector<File>& files) {
  Json report{{"input", input_name(arguments.input)}};
  Json all = Json::array();
  for (std::size_t i = 0; i < models.size(); ++i)
    all.push_back(report_of(curves[i], models[i], {files[i].path, format_of(arguments), files[i].bytes.size()}));
  if (targets.made_up)
    report["models"] = all;
  else
    report.update(all.front());
  return report;
}

void run(const FitArguments& arguments, Session& session) {
  check_arguments(arguments);
  const auto [curves, notes] = read_curves(arguments.input, arguments.reading);
  tell_notes(notes, arguments.talk);
  const auto targets = targets_of(arguments, curves);
  check_targets(arguments, targets);
  const auto models =
      fitted_models(curves, arguments.settings, input_name(arguments.input), arguments.talk.quiet, session.interrupt);
  const auto files = files_of(arguments, targets, models);
  write_files(files, existing_of(arguments, targets));
  const auto report = [&, &curves = curves] { return report_of(arguments, targets, curves, models, files); };
  tell_report(arguments.talk, arguments.output, report, in_words);
}

void add_settings(CLI::App& command, FitSettings& settings) {
  auto* budget = command
                     .add_option("--budget", settings.budgets,
                                 "Sizes of sketches to be good at, control points and details together, e.g. 32,128 "
                                 "(default 128)")
                     ->delimiter(',')
                     ->allow_extra_args(false)
                     ->transform(whole_number(1));
  command
      .add_option("--within", settings.within,
                  "Instead of budgets: fit to a tolerance, as few details as bring the sketch so near to the samples")
      ->check(number_above_zero())
      ->excludes(budget);
  command
      .add_option("--distance", settings.distance,
                  "What --within measures: rms (default), max, both between samples, or hausdorff, between the curves "
                  "as they are drawn")
      ->check(distance_name());
  command.add_flag(
      "--sketch", settings.sketch,
      "Write the sketch of the largest budget, or within the tolerance, not the exact model: a small file");
  command.add_option("--control-points", settings.control_points, "Points of a control polygon, n (default 5)")
      ->transform(whole_number_or_auto(1, 16));
  command.add_option("--maps", settings.maps, "Pieces that a polygon is cut into, N (default 2)")
      ->transform(whole_number_or_auto(2, 8));
  command.add_option("--filter", settings.filter,
                     "Where to start (default coast where it has the shape, else casteljau; stages curve and filter: "
                     "casteljau); an unknown name lists the known ones");
  auto* iterations = command.add_option("--iterations", settings.iterations, "At most so many a round (default 40)")
                         ->transform(whole_number(1, 1000));
  auto* rounds =
      command
          .add_option("--rounds", settings.rounds,
                      "Rounds of sparsity (default 2, or none from coast to 128 vectors and more); 0 for none")
          ->transform(whole_number(0, 100));
  auto* polish =
      command.add_option("--polish", settings.polish, "Rounds on the sketches' own error (default 8); 0 for none")
          ->transform(whole_number(0, 100));
  command
      .add_option("--threads", settings.threads, "Threads to use (default: one a core); results do not depend on it")
      ->transform(whole_number(1, 1024));
  auto* stage = command
                    .add_option("--stage", settings.stage,
                                "What to fit: sparse, the whole filter, so that few details tell the curve (default); "
                                "curve, control points and T alone; filter, U alone")
                    ->check(one_of({"sparse", "curve", "filter"}));
  auto* levels = command
                     .add_option("--levels", settings.levels,
                                 "Stage filter: levels whose details are to tell the curve (default 3); 0 for none")
                     ->transform(whole_number(0, 40));
  command.add_flag("--no-fit", settings.no_fit, "The exact model under the filter as it is")
      ->excludes(budget)
      ->excludes(iterations)
      ->excludes(rounds)
      ->excludes(polish)
      ->excludes(stage)
      ->excludes(levels);
}

}  // namespace

void add_fit(CLI::App& program, Session& session) {
  auto* command = program.add_subcommand("fit", "Fit models to the ordered points of curves");
  auto arguments = std::make_shared<FitArguments>();
  auto& a = *arguments;
  command
      ->add_option("curves", a.input,
                   "A table of points, one a line, 1 to 4 numbers each, or GeoJSON; - is standard input")
      ->required();
  command
      ->add_option("-o,--output", a.output,
                   "Model to write; - is standard output. Of several curves: a name with %d or %s, their number or "
                   "name, or a folder")
      ->required();
  command->add_flag("--overwrite", a.overwrite, "Replace files whose names were made up by %d, %s or for a folder");
  add_reading(*command, a.reading);
  add_settings(*command, a.settings);
  command->add_option("--format", a.format, "json or cbor (default: json when the name ends in .json, else cbor)")
      ->check(one_of({"json", "cbor"}));
  add_talk(*command, a.talk);
  command->footer(
      "Examples:\n"
      "  ifsm fit coast.csv --closed --budget 32,128 -o coast.ifsm\n"
      "  ifsm fit coast.csv --within 2.5 --distance hausdorff --sketch -o simple.ifsm\n"
      "  ifsm fit track.csv --columns lon,lat --control-points auto -o track.json\n"
      "  ifsm fit logger.csv --gaps split -o 'piece-%d.ifsm'\n"
      "  ifsm fit isles.geojson --project -o 'isle-%d.ifsm'\n"
      "  ifsm fit profile.csv --no-fit --filter casteljau --control-points 4 -o profile.ifsm\n");
  command->callback([arguments, &session] { run(*arguments, session); });
}

}  // namespace cli
