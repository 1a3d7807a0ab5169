// ifsm info: what a model, or a system, holds.
#include <algorithm>
#include <memory>
#include <optional>

#include "commands/command.h"
#include "commands/info_system.h"
#include "curves.h"
#include "files.h"
#include "models.h"
#include "systems.h"

namespace cli {
namespace {

struct InfoArguments {
  std::string model;
  std::optional<std::string> name;
  bool json = false;
};

struct LevelSummary {
  std::int64_t details = 0;
  std::int64_t kept = 0;
  double energy = 0;   // the sum of squared significances
  double rms = 0;      // over all places
  double largest = 0;  // significance
};

LevelSummary summary(const ifsm::Model& model, int level, std::int64_t places) {
  LevelSummary sum;
  const auto values = model.significance(level);
  sum.rms = root_of_squares(values, static_cast<double>(places));
  for (const double value : values) {
    ++sum.details;
    sum.kept += value != 0;
    sum.energy += value * value;
    sum.largest = std::max(sum.largest, value);
  }
  return sum;
}

const char* contractive_name(std::int32_t contractive) {
  return contractive > 0 ? "proven" : contractive < 0 ? "refuted" : "undecided";
}

Json report_of(const std::string& name, const ifsm::Model& model) {
  const auto info = model.describe();
  const auto filter = model.filter().describe();
  Json levels = Json::array();
  for (int level = 0; level < info.levels; ++level) {
    const auto sum = summary(model, level, info.places);
    levels.push_back({{"level", level},
                      {"details", sum.details},
                      {"kept", sum.kept},
                      {"energy", sum.energy},
                      {"rms", sum.rms},
                      {"largest", sum.largest}});
  }
  return {{"model", name},
          {"dimension", info.dimension},
          {"closed", info.closed == 1},
          {"samples", info.samples},
          {"levels", info.levels},
          {"places", info.places},
          {"control_points", info.control_points},
          {"maps", info.maps},
          {"topology", info.topology == IFSM_TOPOLOGY_JOINED ? "joined" : "square"},
          {"details", info.details},
          {"details_kept", info.details_kept},
          {"diagonal", info.diagonal},
          {"largest_polygon", info.largest_polygon},
          {"condition", filter.condition},
          {"contractive", contractive_name(filter.contractive)},
          {"energy_by_level", levels}};
}

std::string line(const std::string& name, const std::string& value) {
  return "  " + name + std::string(18 - name.size(), ' ') + value + "\n";
}

std::string in_words(const Json& report) {
  const auto text = [](const Json& value) { return value.is_string() ? value.get<std::string>() : value.dump(); };
  const auto number = [](const Json& value) { return rounded(value.get<double>()); };
  // Shares of energy by RMS, which all have: energies of 1e200 and 1e-200 are no numbers.
  std::vector<double> effects;
  for (const auto& level : report["energy_by_level"]) effects.push_back(level["rms"].get<double>());
  const double whole = root_of_squares(effects, 1);
  std::vector<std::vector<std::string>> rows;
  for (const auto& level : report["energy_by_level"]) {
    const double part = whole > 0 ? level["rms"].get<double>() / whole : 0, share = part * part * 100;
    rows.push_back({text(level["level"]), text(level["details"]), text(level["kept"]), number(level["rms"]),
                    number(level["largest"]), rounded(share, 3) + " %"});
  }
  return text(report["model"]) + "\n" +
         line("curve", std::string(report["closed"] ? "closed" : "open") + ", dimension " + text(report["dimension"]) +
                           ", " + text(report["samples"]) + " samples") +
         line("diagonal", number(report["diagonal"]) + " (of the samples' bounding box)") +
         line("filter",
              text(report["topology"]) + ", n = " + text(report["control_points"]) + ", N = " + text(report["maps"])) +
         line("condition", number(report["condition"])) + line("contractive", text(report["contractive"])) +
         line("levels", text(report["levels"]) + ", " + text(report["places"]) + " places at the finest") +
         line("details", text(report["details_kept"]) + " of " + text(report["details"]) + " are not zero") +
         line("largest polygon", number(report["largest_polygon"]) + " diagonals") + "\n" +
         aligned({"level", "details", "kept", "RMS effect", "largest", "energy"}, rows);
}

void tell(const InfoArguments& arguments, const Json& report, std::string (*in_words)(const Json&)) {
  if (arguments.json)
    print(report);
  else
    print(in_words(report));
}

void tell_system(const InfoArguments& arguments, std::string_view bytes) {
  const std::string source = input_name(arguments.model);
  const auto names = names_in(bytes, source);
  if (names.size() > 1 && !arguments.name) return tell(arguments, report_of_file(source, names), file_in_words);
  const auto system = parse_system(bytes, source, arguments.name);
  tell(arguments, report_of_system(source, system), system_in_words);
}

void run(const InfoArguments& arguments) {
  if (names_system(arguments.model)) {
    const auto system = load_system(arguments.model, arguments.name);
    return tell(arguments, report_of_system(arguments.model, system), system_in_words);
  }
  const std::string bytes = read_file(arguments.model);
  if (looks_like_system(bytes, arguments.model)) return tell_system(arguments, bytes);
  const std::string source = input_name(arguments.model);
  tell(arguments, report_of(source, parse_model(bytes, source)), in_words);
}

}  // namespace

void add_info(CLI::App& program, Session&) {
  auto* command = program.add_subcommand("info", "Tell what a model holds, or a system");
  auto arguments = std::make_shared<InfoArguments>();
  command
      ->add_option("model", arguments->model,
                   "A model written by ifsm fit; or a system, by name or as a file; - is standard input")
      ->required();
  command->add_option("--name", arguments->name, "Which of a file of several systems");
  command->add_flag("--json", arguments->json, "Report as JSON");
  command->footer(
      "RMS effect: what the details of a level do to the curve, in the units of the samples.\n\n"
      "Examples:\n"
      "  ifsm info coast.ifsm\n"
      "  ifsm info coast.ifsm --json\n"
      "  ifsm info fern\n");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace cli
