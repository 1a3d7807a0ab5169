#include "commands/usage.h"

#include "failure.h"

namespace cli {
namespace {

auto commands_in(const CLI::App& program) {
  return program.get_subcommands([](const CLI::App*) { return true; });
}

std::string names_of_commands(const CLI::App& program) {
  std::string all;
  for (const auto* command : commands_in(program)) all += (all.empty() ? "" : ", ") + command->get_name();
  return all;
}

const CLI::App* command_of(const CLI::App& program) {
  const auto parsed = program.get_subcommands();
  return parsed.empty() ? nullptr : parsed.front();
}

bool contains(const std::string& text, const char* part) { return text.find(part) != text.npos; }

// The option that a message of the parser begins with.
std::string first_word(const std::string& text) { return text.substr(0, text.find_first_of(": ")); }

std::string surplus(const CLI::App& program, const CLI::App& command) {
  const auto left = program.remaining(true);
  const auto word = left.empty() ? std::string() : left.front();
  const bool option = word.size() > 1 && word.front() == '-';
  return option ? command.get_name() + " has no option " + word
                : command.get_name() + " does not expect '" + word + "'";
}

// "--details excludes --levels"
std::string contradiction(const std::string& told) {
  return first_word(told) + " and " + told.substr(told.rfind(' ') + 1) + " do not go together";
}

std::string mismatch(const std::string& told) {
  if (contains(told, "missing")) return first_word(told) + " needs a value";
  return contains(told, "At Most") ? first_word(told) + " is given more than once" : told;
}

// "Could not convert: --closed = maybe"
std::string unconverted(const std::string& told) {
  const auto name = told.find(": "), value = told.find(" = ");
  if (name == told.npos || value == told.npos || value < name) return told;
  return told.substr(name + 2, value - name - 2) + ": '" + told.substr(value + 3) + "' is no value for it";
}

std::string fault(const CLI::App& program, const CLI::App& command, const CLI::ParseError& error) {
  const std::string told = error.what();
  if (dynamic_cast<const CLI::ExtrasError*>(&error)) return surplus(program, command);
  if (dynamic_cast<const CLI::RequiredError*>(&error)) return command.get_name() + " needs " + first_word(told);
  if (dynamic_cast<const CLI::ExcludesError*>(&error)) return contradiction(told);
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error)) return mismatch(told);
  if (dynamic_cast<const CLI::ConversionError*>(&error)) return unconverted(told);
  return told;
}

}  // namespace

void check_command(const CLI::App& program, int argc, const char* const* argv) {
  const std::string first = argc > 1 ? argv[1] : "";
  const auto way_out = names_of_commands(program) + "; ifsm --help tells what they do.";
  if (argc < 2) throw Failure(Exit::Usage, "a command is missing: " + way_out);
  for (const auto* command : commands_in(program))
    if (command->get_name() == first) return;
  if (program.get_option_no_throw(first)) return;
  throw Failure(Exit::Usage, "'" + first + "' is none of the commands " + way_out);
}

std::string sentence_of(const CLI::App& program, const CLI::ParseError& error) {
  const auto* command = command_of(program);
  if (!command) return std::string(error.what()) + "; ifsm --help tells the commands.";
  return fault(program, *command, error) + "; ifsm " + command->get_name() + " --help tells its options.";
}

}  // namespace cli
