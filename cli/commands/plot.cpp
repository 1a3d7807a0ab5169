// ifsm plot: pictures of a model, or of measured curves.
#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <optional>

#include "commands/command.h"
#include "commands/values.h"
#include "failure.h"
#include "figures/page.h"
#include "figures/panels.h"
#include "files.h"
#include "models.h"
#include "progress.h"

namespace cli {
namespace {

using figures::Shown;

struct PlotArguments {
  std::string input;
  std::string output;
  std::vector<std::string> show;
  std::string samples;
  Reading reading;
  std::optional<std::int64_t> details;
  figures::PageSize size;
  std::string title;
  std::string format;
  Talk talk;
};

constexpr int least_size = 100, most_size = 20000;  // pixels; cairo's images end at 32767
constexpr std::int64_t usual_details = 64;          // of the sketch whose residuals are shown

// What is drawn: a model, or curves alone.
struct Subject {
  std::optional<ifsm::Model> model;
  std::vector<Samples> curves;  // of the input, or of --samples-file
  std::string name;
};

using Draw = Shown (*)(const PlotArguments&, const Subject&, const ifsm::Cancel&);

Shown samples(const PlotArguments&, const Subject& subject, const ifsm::Cancel&) {
  if (!subject.curves.empty()) return figures::samples_panel(subject.curves);
  const auto info = subject.model->describe();
  return figures::samples_panel({{subject.model->samples(), info.dimension, info.closed == 1}});
}

void check_comparable(const Samples& given, const ifsm_model_info& info, const std::string& name) {
  const auto count = static_cast<std::int64_t>(given.points.size()) / given.dimension;
  if (given.dimension == info.dimension && count == info.samples) return;
  throw Failure(Exit::Input, name + " holds " + std::to_string(count) + " points of dimension " +
                                 std::to_string(given.dimension) + ", the model " + std::to_string(info.samples) +
                                 " of dimension " + std::to_string(info.dimension) +
                                 "; give the samples that the model was made from, read the same way.");
}

Shown residuals(const PlotArguments& arguments, const Subject& subject, const ifsm::Cancel& cancel) {
  const auto& model = *subject.model;
  const auto info = model.describe();
  const bool closed = info.closed == 1;
  if (!subject.curves.empty()) {
    const auto& given = subject.curves.front();
    check_comparable(given, info, input_name(arguments.samples));
    return figures::residuals_panel(given.points, model.samples(), info.dimension, closed, "Model against its samples");
  }
  const auto details = std::min(arguments.details.value_or(usual_details), info.details_kept);
  const auto sketch = model.keep(ifsm::most_significant(details).resolved(ifsm::Resolve::choice).cancelled_by(cancel));
  auto shown = figures::residuals_panel(
      model.samples(), sketch.samples(), info.dimension, closed,
      "Sketch of " + counted(static_cast<std::size_t>(details), "detail") + " against the model");
  shown.numbers["details"] = details;
  return shown;
}

struct Choice {
  const char* name;
  Draw draw;
  bool usual;  // in the overview of a model
};

const std::array choices{
    Choice{"samples", samples, false},
    Choice{"curve", [](auto&, auto& subject, auto&) { return figures::curve_panel(*subject.model); }, false},
    Choice{"polygon", [](auto&, auto& subject, auto&) { return figures::polygon_panel(*subject.model); }, true},
    Choice{"attractor", [](auto&, auto& subject, auto&) { return figures::attractor_panel(*subject.model); }, true},
    Choice{"scalogram", [](auto&, auto& subject, auto&) { return figures::scalogram_of(*subject.model); }, true},
    Choice{"levels", [](auto&, auto& subject, auto& token) { return figures::levels_panel(*subject.model, token); },
           true},
    Choice{"budgets", [](auto&, auto& subject, auto& token) { return figures::budgets_panel(*subject.model, token); },
           true},
    Choice{"residuals", residuals, true}};

const Choice* choice_of(const std::string& name) {
  const auto found = std::find_if(choices.begin(), choices.end(), [&](const Choice& c) { return c.name == name; });
  return found == choices.end() ? nullptr : &*found;
}

std::string names_of_choices() {
  std::string names;
  for (const auto& choice : choices) names += (names.empty() ? "" : ", ") + std::string(choice.name);
  return names;
}

plot::Format format_of(const PlotArguments& arguments) {
  const auto& path = arguments.output;
  const bool svg =
      arguments.format.empty() ? path.ends_with(".svg") || path.ends_with(".SVG") : arguments.format == "svg";
  const bool png =
      arguments.format.empty() ? path.ends_with(".png") || path.ends_with(".PNG") : arguments.format == "png";
  if (!svg && !png)
    throw Failure(Exit::Usage, "-o " + path + " ends in neither .svg nor .png; add --format svg or --format png.");
  return svg ? plot::Format::Svg : plot::Format::Png;
}

void check_arguments(const PlotArguments& arguments) {
  refuse_json_beside_result(arguments.talk, arguments.output);
  format_of(arguments);
  if (arguments.input == "-" && arguments.samples == "-")
    throw Failure(Exit::Usage, "the model and its samples cannot both come from standard input.");
  check_writable(arguments.output);
  check_not_read(arguments.output, {arguments.input, arguments.samples});
}

void check_one_dimension(const std::vector<Samples>& curves, const std::string& name) {
  for (const auto& curve : curves)
    if (curve.dimension != curves.front().dimension)
      throw Failure(Exit::Input, name + " holds curves of dimension " + std::to_string(curves.front().dimension) +
                                     " and " + std::to_string(curve.dimension) +
                                     ", which share no picture; --flat leaves altitudes out.");
}

// Several curves are seen on one plane, about the middle of them all.
Curves curves_on_one_plane(const std::string& bytes, const std::string& name, Reading reading) {
  if (!reading.project || reading.project->middle) return parse_curves(bytes, name, reading);
  auto in_degrees = reading;
  in_degrees.project.reset();
  const auto curves = parse_curves(bytes, name, in_degrees).all;
  check_one_dimension(curves, name);
  std::vector<double> all;
  for (const auto& curve : curves) all.insert(all.end(), curve.points.begin(), curve.points.end());
  if (curves.size() > 1 && curves.front().dimension > 1)
    reading.project->middle = middle_of(all, static_cast<std::size_t>(curves.front().dimension));
  return parse_curves(bytes, name, reading);
}

Subject read_subject(const PlotArguments& arguments) {
  const auto name = input_name(arguments.input);
  const auto bytes = read_file(arguments.input);
  Curves read;
  Subject subject{std::nullopt, {}, name};
  if (looks_like_model(bytes)) {
    subject.model = parse_model(bytes, name);
    if (!arguments.samples.empty()) read = read_curves(arguments.samples, arguments.reading);
  } else if (!arguments.samples.empty()) {
    throw Failure(Exit::Usage, "--samples-file goes with a model, and " + name + " holds curves; leave it out.");
  } else {
    read = curves_on_one_plane(bytes, name, arguments.reading);
  }
  if (read.all.size() > 1 && subject.model)
    throw Failure(Exit::Input, input_name(arguments.samples) + " holds " + counted(read.all.size(), "curve") +
                                   ", and the model was made from one; give that one.");
  tell_notes(read.notes, arguments.talk);
  subject.curves = std::move(read.all);
  return subject;
}

std::vector<std::string> panels_to_show(const PlotArguments& arguments, const Subject& subject) {
  if (!arguments.show.empty()) return arguments.show;
  if (!subject.model) return {"samples"};
  std::vector<std::string> usual;
  for (const auto& choice : choices)
    if (choice.usual) usual.emplace_back(choice.name);
  if (subject.model->filter().describe().contractive < 1) {
    usual.erase(std::find(usual.begin(), usual.end(), "attractor"));
    tell_notes({subject.name + ": the filter's maps are not proven to contract, so there is no attractor to show."},
               arguments.talk);
  }
  return usual;
}

struct Page {
  std::vector<plot::Panel> panels;
  Json numbers = Json::array();
};

Page drawn(const PlotArguments& arguments, const Subject& subject, Session& session) {
  const Interrupt::Cancellable job(session.interrupt);
  Progress progress("plot", Progress::style_of_terminal(arguments.talk.quiet));
  Page page;
  const auto names = panels_to_show(arguments, subject);
  for (const auto& name : names) {
    if (!subject.model && name != "samples")
      throw Failure(Exit::Usage, "--show " + name + " needs a model, and " + subject.name +
                                     " holds curves; make one with ifsm fit.");
    if (subject.model)
      progress.update(static_cast<double>(page.panels.size()) / static_cast<double>(names.size()), name);
    auto shown = choice_of(name)->draw(arguments, subject, job.token());
    page.panels.push_back(std::move(shown.panel));
    page.numbers.push_back({{"panel", name}, {"numbers", std::move(shown.numbers)}});
    job.confirm();
  }
  if (subject.model) progress.update(1, "done");
  return page;
}

std::string title_of(const PlotArguments& arguments) {
  if (!arguments.title.empty()) return arguments.title;
  return arguments.input == "-" ? "" : std::filesystem::path(arguments.input).filename().string();
}

std::string note_of(const Subject& subject) {
  if (!subject.model) return "";
  const auto info = subject.model->describe();
  const auto filter = subject.model->filter().describe();
  return std::string(info.closed == 1 ? "Closed, " : "Open, ") +
         counted(static_cast<std::size_t>(info.samples), "sample") + ", " +
         counted(static_cast<std::size_t>(info.levels), "level") + ", n = " + std::to_string(info.control_points) +
         ", N = " + std::to_string(info.maps) + ", " + std::to_string(info.details_kept) + " of " +
         std::to_string(info.details) + " details, condition of R " + rounded(filter.condition) + ".";
}

std::string in_words(const Json& report) {
  std::string names;
  for (const auto& panel : report["panels"]) names += (names.empty() ? "" : ", ") + panel["panel"].get<std::string>();
  return report["output"].get<std::string>() + ": " + names + "; " + report["width"].dump() + " x " +
         report["height"].dump() + " pixels, " + report["bytes"].dump() + " bytes of " +
         report["format"].get<std::string>() + "\n";
}

void run(const PlotArguments& arguments, Session& session) {
  check_arguments(arguments);
  const auto subject = read_subject(arguments);
  check_one_dimension(subject.curves, subject.name);
  auto page = drawn(arguments, subject, session);
  const auto figure =
      figures::page_of(std::move(page.panels), valid_utf8(title_of(arguments)), note_of(subject), arguments.size);
  const auto format = format_of(arguments);
  const auto bytes = figure.bytes(format);
  write_file(arguments.output, bytes);
  const auto report = [&]() -> Json {
    return {
        {"input", subject.name}, {"output", arguments.output}, {"format", format == plot::Format::Svg ? "svg" : "png"},
        {"width", figure.width}, {"height", figure.height},    {"bytes", bytes.size()},
        {"panels", page.numbers}};
  };
  tell_report(arguments.talk, arguments.output, report, in_words);
}

}  // namespace

void add_plot(CLI::App& program, Session& session) {
  auto* command = program.add_subcommand("plot", "Draw a model, or measured curves");
  auto arguments = std::make_shared<PlotArguments>();
  auto& a = *arguments;
  command->add_option("input", a.input, "A model, a table of points, or GeoJSON; - is standard input")->required();
  command->add_option("-o,--output", a.output, "Picture to write: .svg or .png; - is standard output")->required();
  command
      ->add_option("--show", a.show,
                   "Panels, in their order: " + names_of_choices() + " (default: those that tell most)")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check([](const std::string& name) {
        return choice_of(name) ? "" : "'" + name + "' is none of " + names_of_choices();
      });
  auto* file = command->add_option("--samples-file", a.samples, "Measured points for samples and residuals");
  command->add_option("--details", a.details, "Details of the sketch whose residuals are shown (default 64)")
      ->transform(whole_number(0))
      ->excludes(file);
  add_reading(*command, a.reading);
  command->add_option("--width", a.size.width, "Pixels (default: what suits the panels)")
      ->transform(whole_number(least_size, most_size));
  command->add_option("--height", a.size.height, "Pixels")->transform(whole_number(least_size, most_size));
  command->add_option("--title", a.title, "Words above the panels (default: the input's name)");
  command->add_option("--format", a.format, "svg or png (default: as the name ends)")->check(one_of({"svg", "png"}));
  add_talk(*command, a.talk);
  command->footer(
      "Examples:\n"
      "  ifsm plot coast.ifsm -o coast.svg\n"
      "  ifsm plot coast.ifsm --show polygon,scalogram --width 1600 -o coast.png\n"
      "  ifsm plot coast.ifsm --show residuals --samples-file coast.csv --closed -o residuals.svg\n"
      "  ifsm plot isles.geojson --project -o isles.svg\n");
  command->callback([arguments, &session] { run(*arguments, session); });
}

}  // namespace cli
