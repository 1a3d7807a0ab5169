// ifsm refine: a model that goes on below its samples.
#include <limits>
#include <memory>

#include "commands/command.h"
#include "commands/values.h"
#include "failure.h"
#include "files.h"
#include "models.h"
#include "report.h"

namespace cli {
namespace {

struct RefineArguments {
  std::string model;
  std::string output;
  std::string format;
  double roughness = 1;
  ifsm::RefineOptions options;
  Talk talk;
};

std::string in_words(const Json& report) {
  return report["output"].get<std::string>() + ": " + counted(report["levels"], "level") + ", " +
         report["places"].dump() + " places, length " + rounded(report["length"]) +
         " (before: " + rounded(report["length_before"]) + ")\n";
}

ifsm::Model refined(const ifsm::Model& model, const ifsm::RefineOptions& options) {
  try {
    return model.refine(options);
  } catch (const ifsm::Error& error) {
    if (error.status != IFSM_ERROR_LIMIT) throw;
    throw Failure(Exit::Usage, std::string("--levels: ") + error.what());
  }
}

void run(const RefineArguments& arguments) {
  constexpr double none = -1;
  refuse_json_beside_result(arguments.talk, arguments.output);
  check_model_output(arguments.output, arguments.format);
  check_not_read(arguments.output, {arguments.model});
  const auto model = load_model(arguments.model);
  auto options = arguments.options;
  options.roughness = arguments.roughness == 0 ? none : arguments.roughness;
  const auto finer = refined(model, options);
  const auto bytes = finer.save(format_of(arguments.output, arguments.format));
  write_file(arguments.output, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  const auto report = [&] {
    const auto info = finer.describe();
    return Json{{"output", arguments.output},
                {"levels", info.levels},
                {"places", info.places},
                {"length", finer.length()},
                {"length_before", model.length()}};
  };
  tell_report(arguments.talk, arguments.output, report, in_words);
}

}  // namespace

void add_refine(CLI::App& program, Session&) {
  auto* command = program.add_subcommand("refine", "Go on below the samples, with random details like those above");
  auto arguments = std::make_shared<RefineArguments>();
  auto& a = *arguments;
  command->add_option("model", a.model, "A joined model written by ifsm fit; - is standard input")->required();
  command->add_option("-o,--output", a.output, "Model to write; - is standard output")->required();
  command->add_option("--levels", a.options.levels, "So many levels more; default 1")->transform(whole_number(1, 40));
  command->add_option("--seed", a.options.seed, "Another seed, other details")
      ->transform(whole_number(0, std::numeric_limits<std::uint64_t>::max()))
      ->capture_default_str();
  command->add_option("--roughness", a.roughness, "What new displacements are multiplied with; 0 for none")
      ->check(number_from_zero())
      ->capture_default_str();
  command->add_option("--learned", a.options.learned, "From how many of the finest scales to learn; default 4")
      ->transform(whole_number(1, 40));
  command->add_option("--format", a.format, "json or cbor; else json when the name ends in .json, and cbor")
      ->check(one_of({"json", "cbor"}));
  add_talk(*command, a.talk);
  command->footer(
      "Samples stay where they are, and at their parameters.\n\n"
      "Examples:\n"
      "  ifsm refine coast.ifsm --levels 3 --seed 7 -o finer.ifsm\n"
      "  ifsm refine coast.ifsm -o - | ifsm synth - -o finer.csv\n");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace cli
