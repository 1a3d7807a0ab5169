// ifsm measure: what can be asked of a curve as a whole.
#include <cmath>
#include <memory>

#include "commands/command.h"
#include "files.h"
#include "models.h"
#include "report.h"

namespace cli {
namespace {

struct MeasureArguments {
  std::string model;
  bool json = false;
};

// What `ask` answers; null where the question has no answer for such a curve (one that is a point, or not in the
// plane), or too long a one.
template <class Ask>
Json answer(const Ask& ask) {
  try {
    return ask();
  } catch (const ifsm::Error& error) {
    if (error.status != IFSM_ERROR_SHAPE && error.status != IFSM_ERROR_LIMIT) throw;
    return nullptr;
  }
}

Json dimension_of(const ifsm::Model& model, ifsm::Count method) {
  return answer([&] {
    const auto found = model.dimension(method);
    Json scales = Json::array();
    for (std::size_t i = 0; i < found.scales.size(); ++i)
      scales.push_back({{"scale", found.scales[i]}, {"count", found.counts[i]}});
    return Json{{"dimension", found.report.dimension},
                {"standard_error", found.report.standard_error},
                {"r_squared", found.report.r_squared},
                {"scales", scales}};
  });
}

Json roughness_of(const ifsm::Model& model) {
  const auto found = model.spectrum();
  Json levels = Json::array();
  for (std::size_t level = 0; level < found.rms.size(); ++level)
    levels.push_back({{"level", level}, {"scale", found.scales[level]}, {"rms", found.rms[level]}});
  return {{"hurst", found.report.hurst},  // JSON writes a NaN as null
          {"standard_error", found.report.standard_error},
          {"r_squared", found.report.r_squared},
          {"dimension", found.report.dimension},
          {"first", found.report.first},
          {"last", found.report.last},
          {"levels", levels}};
}

Json report_of(const std::string& name, const ifsm::Model& model) {
  const auto info = model.describe();
  return {{"model", name},
          {"dimension", info.dimension},
          {"closed", info.closed == 1},
          {"places", info.places},
          {"length", model.length()},
          {"diagonal", info.diagonal},
          {"self_intersections", answer([&] { return Json(model.crossings().size()); })},
          {"boxes", dimension_of(model, ifsm::Count::boxes)},
          {"divider", dimension_of(model, ifsm::Count::divider)},
          {"roughness", roughness_of(model)}};
}

std::string number(const Json& value) { return value.is_number_float() ? rounded(value.get<double>()) : value.dump(); }

std::string line(const std::string& name, const std::string& value) {
  return "  " + name + std::string(20 - name.size(), ' ') + value + "\n";
}

std::string dimension_in_words(const Json& found) {
  if (found.is_null()) return "-";
  return number(found["dimension"]) + " ± " + number(found["standard_error"]) + ", scales " +
         number(found["scales"].front()["scale"]) + " to " + number(found["scales"].back()["scale"]);
}

// A NaN has no JSON number.
std::string roughness_in_words(const Json& found) {
  if (!std::isfinite(found["hurst"].get<double>())) return "too few levels with details";
  return "H " + number(found["hurst"]) + " ± " + number(found["standard_error"]) + ", levels " +
         number(found["first"]) + " to " + number(found["last"]) + "; as a power law it implies dimension " +
         number(found["dimension"]);
}

std::string in_words(const Json& report) {
  std::vector<std::vector<std::string>> rows;
  for (const auto& level : report["roughness"]["levels"])
    rows.push_back({number(level["level"]), number(level["scale"]), number(level["rms"])});
  const Json& crossings = report["self_intersections"];
  return report["model"].get<std::string>() + "\n" +
         line("curve", std::string(report["closed"] ? "closed" : "open") + ", dimension " +
                           number(report["dimension"]) + ", " + number(report["places"]) + " places") +
         line("length", number(report["length"]) + ", " + "diagonal " + number(report["diagonal"])) +
         line("self-intersections", crossings.is_null() ? "-" : number(crossings)) +
         line("box dimension", dimension_in_words(report["boxes"])) +
         line("divider dimension", dimension_in_words(report["divider"])) +
         line("roughness", roughness_in_words(report["roughness"])) + "\n" + aligned({"level", "scale", "RMS"}, rows);
}

void run(const MeasureArguments& arguments) {
  const auto report = report_of(input_name(arguments.model), load_model(arguments.model));
  if (arguments.json)
    print(report);
  else
    print(in_words(report));
}

}  // namespace

void add_measure(CLI::App& program, Session&) {
  auto* command = program.add_subcommand("measure", "Tell length, self-intersections, dimensions and roughness");
  auto arguments = std::make_shared<MeasureArguments>();
  command->add_option("model", arguments->model, "A model written by ifsm fit; - is standard input")->required();
  command->add_flag("--json", arguments->json, "Report as JSON, with the counts at each scale");
  command->footer(
      "All is about the polyline through the model's finest places.\n\n"
      "Examples:\n"
      "  ifsm measure coast.ifsm\n"
      "  ifsm fit coast.csv --closed --no-fit -o - | ifsm measure - --json\n");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace cli
