// ifsm convert: a system in another format, or as a model.
#include <memory>
#include <optional>

#include "commands/command.h"
#include "commands/values.h"
#include "failure.h"
#include "files.h"
#include "systems.h"

namespace cli {
namespace {

struct ConvertArguments {
  std::string system;
  std::optional<std::string> name;
  std::string output;
  std::string format;
  std::optional<int> levels;
  Talk talk;
};

constexpr int usual_levels = 8;
const std::vector<std::string> formats{"json", "cbor", "ifs", "model"};

std::string format_of(const ConvertArguments& arguments) {
  std::string format = arguments.format;
  if (format.empty())
    for (const char* known : {"json", "cbor", "ifs"})
      if (arguments.output.ends_with(std::string(".") + known)) format = known;
  if (format.empty() && arguments.output.ends_with(".ifsm")) format = "model";
  if (format.empty())
    throw Failure(Exit::Usage,
                  "-o " + arguments.output + " ends in none of .json, .cbor, .ifs and .ifsm; add --format.");
  return format;
}

// Joined where the pieces are a chain, since its curve then stays in one piece whatever becomes of its details.
ifsm::Model model_of(const ifsm::System& system, int levels) {
  try {
    return system.model(ifsm::Topology::joined, levels);
  } catch (const ifsm::Error& error) {
    if (error.status != IFSM_ERROR_SHAPE && error.status != IFSM_ERROR_SINGULAR) throw;
  }
  return system.model(ifsm::Topology::square, levels);
}

std::vector<std::uint8_t> bytes_of(const ifsm::System& system, const std::string& format, const std::string& title,
                                   int levels) {
  if (format == "model") return model_of(system, levels).save(ifsm::Format::cbor);
  if (format == "ifs") return system.save(ifsm::Format::fractint, title);
  return system.save(format == "json" ? ifsm::Format::json : ifsm::Format::cbor);
}

std::string in_words(const Json& report) {
  return report["output"].get<std::string>() + ": " + counted(report["maps"], "map") + " of dimension " +
         report["dimension"].dump() + ", " + report["bytes"].dump() + " bytes\n";
}

void run(const ConvertArguments& arguments) {
  refuse_json_beside_result(arguments.talk, arguments.output);
  const std::string format = format_of(arguments);
  if (arguments.levels && format != "model")
    throw Failure(Exit::Usage, "--levels goes with a model, and " + arguments.output + " is none; leave it out.");
  if (format == "cbor" || format == "model") refuse_binary_on_terminal(arguments.output, ifsm::Format::cbor);
  check_writable(arguments.output);
  if (!names_system(arguments.system)) check_not_read(arguments.output, {arguments.system});
  const auto system = load_system(arguments.system, arguments.name);
  const std::string title = title_of_system(arguments.system, arguments.name);
  const auto bytes = bytes_of(system, format, title, arguments.levels.value_or(usual_levels));
  write_file(arguments.output, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  const auto report = [&] {
    const auto info = system.describe();
    return Json{{"system", title},   {"output", arguments.output}, {"format", format}, {"dimension", info.dimension},
                {"maps", info.maps}, {"bytes", bytes.size()}};
  };
  tell_report(arguments.talk, arguments.output, report, in_words);
}

}  // namespace

void add_convert(CLI::App& program, Session&) {
  auto* command = program.add_subcommand("convert", "Write a system in another format, or as a model");
  auto arguments = std::make_shared<ConvertArguments>();
  auto& a = *arguments;
  command
      ->add_option("system", a.system,
                   "A system's name, or a file: JSON, CBOR, Fractint's .ifs, flam3's .flame, or a model of one control "
                   "point more than dimensions; - is standard input")
      ->required();
  command
      ->add_option("-o,--output", a.output,
                   "What to write: .json, .cbor, .ifs, or a model, .ifsm; - is standard output")
      ->required();
  command->add_option("--name", a.name, "Which of a file of several");
  command->add_option("--levels", a.levels, "Of a model (default 8)")->transform(whole_number(0, 20));
  command->add_option("--format", a.format, "json, cbor, ifs or model (default: as the name ends)")
      ->check(one_of(formats));
  add_talk(*command, a.talk);
  command->footer(
      "Examples:\n"
      "  ifsm convert fern -o fern.json\n"
      "  ifsm convert fractint.ifs --name dragon -o dragon.json\n"
      "  ifsm convert koch -o koch.ifsm\n");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace cli
