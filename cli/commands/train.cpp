// ifsm train: curves of one kind in, one filter for them out.
#include <cmath>
#include <memory>
#include <utility>

#include "commands/command.h"
#include "commands/values.h"
#include "curves.h"
#include "failure.h"
#include "files.h"
#include "models.h"
#include "progress.h"
#include "report.h"

namespace cli {
namespace {

struct TrainArguments {
  std::vector<std::string> inputs;
  std::string output;
  Reading reading;
  std::vector<std::int64_t> budgets;
  int control_points = 0;  // 0: the library's default, here and below
  int maps = 0;
  std::string filter;
  int hold_out = 0;
  int rounds = 0;
  int iterations = 0;
  double condition = 0;
  int threads = 0;
  Talk talk;
};

Curves read_family(const TrainArguments& arguments) {
  Curves family;
  for (const auto& path : arguments.inputs) {
    Curves read = read_curves(path, arguments.reading);
    family.notes.insert(family.notes.end(), read.notes.begin(), read.notes.end());
    for (Samples& samples : read.all) {
      family.all.push_back(std::move(samples));
      if (family.all.back().dimension == family.all.front().dimension) continue;
      throw Failure(Exit::Input, input_name(path) + " has points of dimension " +
                                     std::to_string(family.all.back().dimension) + " and " +
                                     input_name(arguments.inputs.front()) + " of " +
                                     std::to_string(family.all.front().dimension) +
                                     "; a family has one dimension: choose columns with --columns.");
    }
  }
  return family;
}

std::vector<ifsm::Curve> curves_of(const Curves& family) {
  std::vector<ifsm::Curve> curves;
  for (const Samples& samples : family.all) curves.push_back(samples.curve());
  return curves;
}

ifsm::Trained trained(const TrainArguments& arguments, const Curves& family, Session& session) {
  ifsm::Filter start;
  if (!arguments.filter.empty()) {
    start = start_filter(arguments.filter, arguments.control_points, arguments.maps);
    require_joined(start, arguments.filter);
  }
  const Interrupt::Cancellable job(session.interrupt);
  Progress progress("train", Progress::style_of_terminal(arguments.talk.quiet));
  ifsm::TrainOptions options;
  options.threads = arguments.threads;
  options.start = arguments.filter.empty() ? nullptr : &start;
  options.control_points = arguments.control_points;
  options.maps = arguments.maps;
  options.budgets = arguments.budgets;
  options.hold_out = arguments.hold_out;
  options.rounds = arguments.rounds;
  options.iterations = arguments.iterations;
  options.condition = arguments.condition;
  options.cancel = &job.token();
  options.progress = [&progress](double fraction, const std::string& stage) {
    progress.update(fraction, stage);
    return false;
  };
  try {
    auto result = ifsm::train(curves_of(family), options);
    job.confirm();
    return result;
  } catch (const ifsm::Error& error) {
    refuse_shape(error);
    throw;
  }
}

// A filter travels in a model that holds nothing else: a straight control polygon, no details.
ifsm::Model carrier(const ifsm::Filter& filter) {
  const int n = filter.describe().control_points;
  std::vector<double> line;
  for (int k = 0; k < n; ++k) line.push_back(static_cast<double>(k) / (n - 1));
  return ifsm::Model::from_polygon(filter, ifsm::Curve(line, 1), 0);
}

const char* reason_name(std::int32_t reason) {
  switch (reason) {
    case IFSM_TRAIN_CONVERGED: return "converged";
    case IFSM_TRAIN_ROUNDS: return "all rounds used";
    case IFSM_TRAIN_START_BEST: return "nothing better than the start";
  }
  return "unknown";
}

Json report_of(const TrainArguments& arguments, const ifsm::Trained& result) {
  const auto& report = result.report;
  const auto info = result.filter.describe();
  Json json{{"output", arguments.output},
            {"control_points", info.control_points},
            {"maps", info.maps},
            {"condition", info.condition},
            {"reason", reason_name(report.reason)},
            {"trained", report.trained},
            {"held_out", report.held_out},
            {"sketches", report.sketches},
            {"rounds", report.rounds},
            {"iterations", report.iterations},
            {"ratio", report.ratio}};
  if (report.held_out > 0) json["held_out_ratio"] = report.held_out_ratio;
  return json;
}

std::string in_words(const Json& report) {
  const auto number = [&](const char* key) { return std::to_string(report[key].get<std::int64_t>()); };
  std::string text = report["output"].get<std::string>() + ": n = " + number("control_points") +
                     ", N = " + number("maps") + ", condition " + rounded(report["condition"]) + "\n" +
                     counted(report["rounds"], "round") + ", " + counted(report["iterations"], "iteration") + " (" +
                     report["reason"].get<std::string>() + ")\n" +
                     "RMS of sketches, trained over start: " + rounded(report["ratio"]) + " on " +
                     counted(report["trained"], "curve") + ", " + number("sketches") +
                     (report["sketches"] == 1 ? " sketch" : " sketches");
  if (report.contains("held_out_ratio"))
    text += "; " + rounded(report["held_out_ratio"]) + " on " + counted(report["held_out"], "curve") + " held out";
  return text + "\n";
}

void run(const TrainArguments& arguments, Session& session) {
  refuse_json_beside_result(arguments.talk, arguments.output);
  check_writable(arguments.output);
  auto read = arguments.inputs;
  read.push_back(file_of_filter(arguments.filter));
  check_not_read(arguments.output, read);
  const Curves family = read_family(arguments);
  tell_notes(family.notes, arguments.talk);
  const auto result = trained(arguments, family, session);
  const auto bytes = carrier(result.filter).save(ifsm::Format::json);
  write_file(arguments.output, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  tell_report(
      arguments.talk, arguments.output, [&] { return report_of(arguments, result); }, in_words);
}

}  // namespace

void add_train(CLI::App& program, Session& session) {
  auto* command = program.add_subcommand("train", "Train one filter on curves of one kind");
  auto arguments = std::make_shared<TrainArguments>();
  auto& a = *arguments;
  command->add_option("curves", a.inputs, "Tables of points, or GeoJSON: curves of one kind")->required();
  command->add_option("-o,--output", a.output, "Filter to write, for --filter; - is standard output")->required();
  add_reading(*command, a.reading);
  command
      ->add_option("--budget", a.budgets,
                   "Sizes of sketches to be good at, control points and details together (default 16,32,64 … up to an "
                   "eighth of a curve's samples)")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->transform(whole_number(1));
  command->add_option("--control-points", a.control_points, "Points of a control polygon, n (default 5)")
      ->transform(whole_number(2, 16));
  command->add_option("--maps", a.maps, "Pieces that a polygon is cut into, N (default 2)")
      ->transform(whole_number(2, 8));
  command->add_option("--filter", a.filter, "Where to start: a name (default casteljau), or a file with a filter");
  command->add_option("--hold-out", a.hold_out, "Do not train on every so-manyth curve, judge by it (default none)")
      ->transform(whole_number(2, 1 << 30));
  command->add_option("--rounds", a.rounds, "At most so many (default 12)")->transform(whole_number(1, 1000));
  command->add_option("--iterations", a.iterations, "At most so many a round (default 10)")
      ->transform(whole_number(1, 1000));
  command
      ->add_option("--condition", a.condition,
                   "Condition number of R, at most (default 30), or twice the start's where that is more")
      ->check(number_above_zero());
  command->add_option("--threads", a.threads, "Threads to use (default: one a core); results do not depend on it")
      ->transform(whole_number(1, 1024));
  add_talk(*command, a.talk);
  command->footer(
      "Examples:\n"
      "  ifsm train ridges/*.csv --hold-out 5 -o ridges.json\n"
      "  ifsm fit ridge.csv --filter ridges.json -o ridge.ifsm\n");
  command->callback([arguments, &session] { run(*arguments, session); });
}

}  // namespace cli
