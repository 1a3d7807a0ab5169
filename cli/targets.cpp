#include "targets.h"

#include <algorithm>
#include <filesystem>
#include <map>

#include "failure.h"
#include "report.h"

namespace cli {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t longest_name = 60;  // bytes of a curve's name in a file's; systems allow 255 in all

std::string with_zeros(std::size_t number, std::size_t digits) {
  const auto text = std::to_string(number);
  return std::string(digits > text.size() ? digits - text.size() : 0, '0') + text;
}

// One of %d, %03d, %s, %% at the start of a text: how long it is (0 when it is none), and what it stands for.
struct Directive {
  std::size_t length = 0;
  std::string value = {};
};

Directive directive(const std::string& text, std::size_t number, const std::string& name) {
  const auto at = [&](std::size_t i) { return i < text.size() ? text[i] : '\0'; };
  if (at(0) != '%') return {};
  if (at(1) == 'd') return {2, std::to_string(number)};
  if (at(1) == '0' && at(2) >= '1' && at(2) <= '9' && at(3) == 'd')
    return {4, with_zeros(number, static_cast<std::size_t>(at(2) - '0'))};
  if (at(1) == 's') return {2, name.empty() ? std::to_string(number) : name};
  if (at(1) == '%') return {2, "%"};
  return {};
}

struct Expanded {
  std::string text;
  bool told_apart = false;  // a number or a name stands in it
};

Expanded expanded(const std::string& pattern, std::size_t number, const std::string& name) {
  Expanded result;
  for (std::size_t i = 0; i < pattern.size();) {
    const auto [length, value] = directive(pattern.substr(i, 4), number, name);
    result.text += length > 0 ? value : pattern.substr(i, 1);
    result.told_apart |= length > 0 && value != "%";
    i += length > 0 ? length : 1;
  }
  return result;
}

std::vector<std::string> in_folder(const fs::path& folder, const std::string& stem, const std::string& extension,
                                   const std::vector<std::string>& names) {
  if (names.size() == 1) return {(folder / (stem + extension)).string()};
  const auto digits = std::to_string(names.size()).size();
  std::vector<std::string> paths;
  for (std::size_t i = 0; i < names.size(); ++i) {
    auto file = stem + "-" + with_zeros(i + 1, digits);
    if (const auto name = file_name_of(names[i]); !name.empty()) file.append("-").append(name);
    paths.push_back((folder / file.append(extension)).string());
  }
  return paths;
}

void check_all_different(const std::vector<std::string>& paths, const std::string& output) {
  std::map<std::string, std::size_t> owners;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const auto [owner, fresh] = owners.emplace(paths[i], i);
    if (fresh) continue;
    throw Failure(Exit::Usage, "-o " + output + ": curves " + std::to_string(owner->second + 1) + " and " +
                                   std::to_string(i + 1) + " would both go to " + paths[i] +
                                   "; add %d, which stands for a curve's number.");
  }
}

}  // namespace

bool is_folder(const std::string& output) {
  std::error_code ignored;
  return (!output.empty() && output.back() == '/') || fs::is_directory(output, ignored);
}

std::string file_name_of(const std::string& name) {
  std::string result;
  for (const char c : name) {
    const bool letter = (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c & 0x80) != 0;
    if (letter)
      result += c;
    else if (!result.empty() && result.back() != '_')
      result += '_';
  }
  auto end = std::min(longest_name, result.size());
  while (end > 0 && end < result.size() && continues_character(result[end])) --end;
  result.resize(end);
  while (!result.empty() && result.back() == '_') result.pop_back();
  return result;
}

Targets target_paths(const std::string& output, const std::string& stem, const std::string& extension,
                     const std::vector<std::string>& names) {
  if (is_folder(output)) return {in_folder(output, stem, extension, names), true};
  Targets targets;
  for (std::size_t i = 0; i < names.size(); ++i) {
    auto [path, told_apart] = expanded(output, i + 1, file_name_of(names[i]));
    targets.paths.push_back(std::move(path));
    targets.made_up |= told_apart;
  }
  if (names.size() > 1 && !targets.made_up)
    throw Failure(Exit::Usage, "-o " + output + " names one file for " + counted(names.size(), "curve") +
                                   ", and each becomes a model of its own; put %d into the name (" + stem + "-%d" +
                                   extension + "), or name a folder that exists.");
  check_all_different(targets.paths, output);
  return targets;
}

}  // namespace cli
