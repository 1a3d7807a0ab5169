// ifsm synth: model in, points out; all of its details, or a sketch.
#include <limits>
#include <memory>
#include <optional>

#include "commands/command.h"
#include "commands/values.h"
#include "curves.h"
#include "failure.h"
#include "files.h"
#include "geojson.h"
#include "models.h"
#include "progress.h"
#include "projection.h"

namespace cli {
namespace {

constexpr int most_levels = std::numeric_limits<std::int32_t>::max();  // what a model has is known later

struct SynthArguments {
  std::string model;
  PointsOutput output;
  bool geojson = false;
  std::string unproject;  // "longitude,latitude"; empty: not asked for
  std::optional<int> keep_levels;
  std::optional<std::int64_t> keep_details;
  std::optional<double> threshold;
  std::optional<double> within;
  std::string distance;  // empty: RMS
  std::string resolve;   // empty: not asked for
  std::optional<std::int64_t> count;
  std::optional<int> level;
  Talk talk;
};

bool keeps_all(const SynthArguments& arguments) {
  return !arguments.keep_levels && !arguments.keep_details && !arguments.threshold && !arguments.within;
}

ifsm::Keep rule_of(const SynthArguments& arguments) {
  if (arguments.keep_levels) return ifsm::first_levels(*arguments.keep_levels);
  if (arguments.keep_details) return ifsm::most_significant(*arguments.keep_details);
  if (arguments.within) return ifsm::within(*arguments.within);
  return ifsm::above(*arguments.threshold);
}

// The fewest details that keep a bound are wanted, unless less is asked for.
ifsm::Resolve resolve_of(const SynthArguments& arguments) {
  if (arguments.resolve.empty()) return arguments.within ? ifsm::Resolve::choice : ifsm::Resolve::none;
  if (arguments.resolve == "none") return ifsm::Resolve::none;
  return arguments.resolve == "choice" ? ifsm::Resolve::choice : ifsm::Resolve::values;
}

void check_at_most(const char* option, std::int64_t asked, std::int64_t most, const char* of_what) {
  if (asked > most)
    throw Failure(Exit::Usage, std::string(option) + ": the model has " +
                                   counted(static_cast<std::size_t>(most), of_what) + "; give a number from 0 to " +
                                   std::to_string(most) + ".");
}

ifsm::Model sketch_of(const ifsm::Model& model, const SynthArguments& arguments, Session& session) {
  const auto info = model.describe();
  if (arguments.keep_levels) check_at_most("--levels", *arguments.keep_levels, info.levels, "level");
  if (arguments.keep_details) check_at_most("--details", *arguments.keep_details, info.details, "detail");
  const Interrupt::Cancellable job(session.interrupt);
  Progress progress("synth", Progress::style_of_terminal(arguments.talk.quiet));
  auto rule = rule_of(arguments).by(distance_of(arguments.distance)).resolved(resolve_of(arguments));
  rule.cancelled_by(job.token());
  if (arguments.within)  // the others have nothing to tell
    rule.telling([&](double fraction, const std::string& stage) {
      progress.update(fraction, stage);
      return false;
    });
  auto sketch = kept_within(model, rule);
  job.confirm();
  return sketch;
}

// Equally spaced in parameter: both ends of an open curve; once round a closed one.
std::vector<double> spaced(std::int64_t count, bool closed) {
  const auto steps = static_cast<double>(closed || count == 1 ? count : count - 1);
  std::vector<double> parameters;
  for (std::int64_t k = 0; k < count; ++k) parameters.push_back(static_cast<double>(k) / steps);
  return parameters;
}

// A bound on how curves are drawn is kept by all finest places together; samples alone may cut across.
bool is_drawn(const SynthArguments& arguments) {
  return arguments.within && distance_of(arguments.distance) == ifsm::Distance::hausdorff;
}

// All finest places, each once.
std::vector<double> drawn(const ifsm::Model& model) {
  const auto info = model.describe();
  auto points = model.points(info.levels);
  points.resize(static_cast<std::size_t>(info.places * info.dimension));
  return points;
}

std::vector<double> points_of(const ifsm::Model& model, const SynthArguments& arguments) {
  const auto info = model.describe();
  if (arguments.level && *arguments.level > info.levels)
    throw Failure(Exit::Usage, "--level: the model has the levels 0 to " + std::to_string(info.levels) + ".");
  if (arguments.level) return model.points(*arguments.level);
  if (arguments.count) return model.evaluate(spaced(*arguments.count, info.closed == 1));
  if (is_drawn(arguments)) return drawn(model);
  return model.samples();
}

Json report_of(const SynthArguments& arguments, const ifsm::Model& model, const ifsm::Model& sketch, std::size_t rows) {
  const auto info = sketch.describe();
  const auto apart = model.distance(sketch);
  return {{"model", input_name(arguments.model)},
          {"output", arguments.output.path},
          {"points", rows},
          {"dimension", info.dimension},
          {"details", info.details},
          {"details_kept", info.details_kept},
          {"rms", apart.rms},
          {"max", apart.largest},
          {"hausdorff", apart.hausdorff}};
}

std::string in_words(const Json& report) {
  return report["output"].get<std::string>() + ": " + counted(report["points"], "point") + "; " +
         report["details_kept"].dump() + " of " + counted(report["details"], "detail") + ", RMS " +
         rounded(report["rms"]) + ", at most " + rounded(report["max"]) + " and Hausdorff " +
         rounded(report["hausdorff"]) + " from the model\n";
}

constexpr double metres_in_a_kilometre = 1e3;

// What can be known to fail is said before the computation, not after it.
void check_arguments(const SynthArguments& arguments) {
  refuse_json_beside_result(arguments.talk, arguments.output.path);
  if (!arguments.unproject.empty()) typed_degrees("--unproject", arguments.unproject);
  if (!arguments.resolve.empty() && keeps_all(arguments))
    throw Failure(Exit::Usage, "--resolve solves anew what is kept; add --levels, --details, --threshold or --within.");
  if (!arguments.distance.empty() && resolve_of(arguments) == ifsm::Resolve::none && !arguments.within)
    throw Failure(Exit::Usage, "--distance is for --within, and for --resolve: what it measures, and makes small.");
  check_writable(arguments.output.path);
  check_not_read(arguments.output.path, {arguments.model});
}

void check_position(int dimension) {
  if (dimension != 2 && dimension != 3)
    throw Failure(Exit::Usage, "a position of GeoJSON has 2 or 3 coordinates, the points of this model " +
                                   std::to_string(dimension) + "; write a table instead.");
}

std::vector<double> in_degrees(std::vector<double> points, int dimension, const std::string& middle) {
  check_position(dimension);
  unproject(points, static_cast<std::size_t>(dimension), typed_degrees("--unproject", middle));
  for (std::size_t i = 2; dimension == 3 && i < points.size(); i += 3) points[i] *= metres_in_a_kilometre;
  return points;
}

void write_points(const SynthArguments& arguments, std::vector<double> points, const ifsm_model_info& info) {
  if (!arguments.unproject.empty()) points = in_degrees(std::move(points), info.dimension, arguments.unproject);
  if (!arguments.geojson)
    return arguments.output.write(
        {coordinate_names(info.dimension), static_cast<std::size_t>(info.dimension), std::move(points)});
  check_position(info.dimension);
  const Json properties{{"model", input_name(arguments.model)}, {"details", info.details_kept}};
  write_file(arguments.output.path, compact_text_of(geojson_of(points, info.dimension, info.closed == 1, properties)));
}

void run(const SynthArguments& arguments, Session& session) {
  check_arguments(arguments);
  const auto model = load_model(arguments.model);
  ifsm::Model reduced;
  if (!keeps_all(arguments)) reduced = sketch_of(model, arguments, session);
  const auto& sketch = keeps_all(arguments) ? model : reduced;

  auto points = points_of(sketch, arguments);
  const auto rows = points.size() / static_cast<std::size_t>(sketch.describe().dimension);
  write_points(arguments, std::move(points), sketch.describe());
  tell_report(
      arguments.talk, arguments.output.path, [&] { return report_of(arguments, model, sketch, rows); }, in_words);
}

}  // namespace

void add_synth(CLI::App& program, Session& session) {
  auto* command = program.add_subcommand("synth", "Write the points of a model, or of a sketch of it");
  auto arguments = std::make_shared<SynthArguments>();
  auto& a = *arguments;
  command->add_option("model", a.model, "A model written by ifsm fit; - is standard input")->required();
  add_points_output(*command, a.output);
  command->add_flag("--geojson", a.geojson, "Write GeoJSON instead of a table: a Polygon of a ring, else a LineString");
  command->add_option("--unproject", a.unproject,
                      "Turn kilometres back into degrees about LON,LAT, the middle that ifsm fit --project told");
  auto* levels = command->add_option("--levels", a.keep_levels, "Keep the details of the first so many levels only")
                     ->transform(whole_number(0, most_levels));
  auto* details = command->add_option("--details", a.keep_details, "Keep so many details, the most significant ones")
                      ->transform(whole_number(0))
                      ->excludes(levels);
  command->add_option("--threshold", a.threshold, "Keep the details whose significance is above this")
      ->check(number_from_zero())
      ->excludes(levels)
      ->excludes(details);
  command
      ->add_option("--within", a.within, "Keep as few details as bring the sketch so near to the curve, by --distance")
      ->check(number_above_zero())
      ->excludes(levels)
      ->excludes(details)
      ->excludes("--threshold");
  command
      ->add_option("--distance", a.distance,
                   "What is to be small: rms (default), max, both between samples, or hausdorff, between the curves as "
                   "they are drawn")
      ->check(distance_name());
  command
      ->add_flag(
          "--resolve{choice}", a.resolve,
          "Solve the kept details and control points anew, and better which details are kept (--within does so); "
          "--resolve=values leaves the choice as it is, none also the values")
      ->check(one_of({"none", "values", "choice"}));
  auto* count = command->add_option("--samples", a.count, "So many points, equally spaced in parameter")
                    ->transform(whole_number(1, std::numeric_limits<std::int32_t>::max()));
  command->add_option("--level", a.level, "The points of a level; 0 is the control polygon")
      ->transform(whole_number(0, most_levels))
      ->excludes(count);
  add_talk(*command, a.talk);
  command->footer(
      "Without options: the samples that the model was made from.\n\n"
      "Examples:\n"
      "  ifsm synth coast.ifsm -o points.csv\n"
      "  ifsm synth coast.ifsm --details 64 --resolve -o sketch.csv\n"
      "  ifsm synth coast.ifsm --within 2.5 --distance hausdorff -o simple.csv\n"
      "  ifsm synth coast.ifsm --level 0            (the control polygon)\n"
      "  ifsm synth isle.ifsm --geojson --unproject=-18.98,64.96 -o isle.geojson\n"
      "  ifsm synth coast.ifsm --levels 4 --samples 1000 --separator tab\n");
  command->callback([arguments, &session] { run(*arguments, session); });
}

}  // namespace cli
