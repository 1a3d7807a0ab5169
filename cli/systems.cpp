#include "systems.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "failure.h"
#include "files.h"
#include "models.h"

namespace cli {
namespace {

bool holds(std::string_view bytes, std::string_view part) { return bytes.find(part) != bytes.npos; }

std::string ending_of(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

// The library's advice in the program's words.
std::string in_options(std::string message) {
  constexpr std::string_view advice = "name one of ";
  if (const auto at = message.find(advice); at != message.npos)
    message.replace(at, advice.size(), "give --name one of ");
  return message;
}

}  // namespace

bool names_system(const std::string& source) {
  if (source.empty() || source == "-" || source.find_first_of("./") != std::string::npos) return false;
  std::error_code ignored;
  if (!std::filesystem::exists(source, ignored)) return true;
  try {
    static_cast<void>(ifsm::System::named(source));
    return true;
  } catch (const ifsm::Error&) {
    return false;
  }
}

ifsm::System load_system(const std::string& source, const std::optional<std::string>& name) {
  if (!names_system(source)) return parse_system(read_file(source), input_name(source), name);
  if (name)
    throw Failure(Exit::Usage, "--name goes with a file, and '" + source + "' is a system's own name; leave it out.");
  try {
    return ifsm::System::named(source);
  } catch (const ifsm::Error& error) {
    throw Failure(Exit::Usage, std::string(error.what()) + " A file of that name is not there.");
  }
}

ifsm::System parse_system(std::string_view bytes, const std::string& source, const std::optional<std::string>& name) {
  const std::vector<std::uint8_t> copy(bytes.begin(), bytes.end());
  try {
    if (holds(bytes, "ifsm-model")) return ifsm::System::from_model(ifsm::Model::load(copy));
    return name ? ifsm::System::load(copy, *name) : ifsm::System::load(copy);
  } catch (const ifsm::Error& error) {
    if (error.status == IFSM_ERROR_MEMORY || error.status == IFSM_ERROR_INTERNAL)
      throw Failure(Exit::Computing, source + ": " + error.what());
    const bool asked_wrongly = error.argument == "name" && name;
    throw Failure(asked_wrongly ? Exit::Usage : Exit::Input,
                  (asked_wrongly ? "--name: " : source + ": ") + in_options(error.what()));
  }
}

std::vector<std::string> names_in(std::string_view bytes, const std::string& source) {
  try {
    return ifsm::system_names({bytes.begin(), bytes.end()});
  } catch (const ifsm::Error& error) {
    throw Failure(Exit::Input, source + ": " + error.what());
  }
}

bool looks_like_system(std::string_view bytes, const std::string& source) {
  if (holds(bytes, "ifsm-model")) return false;
  if (holds(bytes, "ifsm-system") || ending_of(source) == ".ifs" || ending_of(source) == ".flame") return true;
  try {
    static_cast<void>(ifsm::system_names({bytes.begin(), bytes.end()}));
    return true;
  } catch (const ifsm::Error&) {
    return false;
  }
}

std::string title_of_system(const std::string& source, const std::optional<std::string>& name) {
  if (name) return *name;
  if (names_system(source) || source == "-") return source == "-" ? "system" : source;
  return std::filesystem::path(source).stem().string();
}

}  // namespace cli
