#include "io/text_lines.h"

#include <cctype>
#include <charconv>
#include <cmath>

namespace ifsm::core {

Error at_line(Status status, std::int64_t line, const std::string& says) {
  return Error(status, "bytes", "Line " + std::to_string(line) + ": " + says).at(line);
}

std::string quoted(std::string_view text) {
  constexpr std::size_t longest = 40;
  std::string shown(text.substr(0, longest));
  for (char& c : shown)
    if (std::isprint(static_cast<unsigned char>(c)) == 0) c = '?';
  return '"' + shown + (text.size() > longest ? "…\"" : "\"");
}

bool is_space(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }

Status read_number(std::string_view word, double& value) {
  const std::string_view digits = word.starts_with('+') ? word.substr(1) : word;
  const char* const last = digits.data() + digits.size();
  const auto [end, problem] = std::from_chars(digits.data(), last, value);
  if (problem == std::errc::result_out_of_range) return Status::not_finite;
  if (problem != std::errc() || end != last) return Status::format;
  return std::isfinite(value) ? Status::ok : Status::not_finite;
}

Error no_number(Status status, std::string_view word, std::int64_t line, const std::string& expected) {
  if (status == Status::not_finite)
    return at_line(status, line, quoted(word) + " is no number that a double holds; give a finite one.");
  return at_line(status, line, quoted(word) + " is no number; " + expected);
}

}  // namespace ifsm::core
