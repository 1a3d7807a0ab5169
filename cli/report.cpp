#include "report.h"

#include <algorithm>
#include <charconv>
#include <cstdio>

#include "files.h"

namespace cli {
namespace {

std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return !continues_character(c); }));
}

}  // namespace

std::string rounded(double value, int digits) {
  char text[64];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::general, digits).ptr;
  return {text, end};
}

std::string counted(std::size_t number, const std::string& noun) {
  return std::to_string(number) + " " + noun + (number == 1 ? "" : "s");
}

std::string counted(const Json& number, const std::string& noun) { return counted(number.get<std::size_t>(), noun); }

std::string printable(std::string_view text) {
  constexpr std::size_t most = 60;  // bytes
  std::string fit(text.substr(0, most));
  if (text.size() > most) {
    while (!fit.empty() && continues_character(text[fit.size()])) fit.pop_back();
    fit += "…";
  }
  std::replace_if(
      fit.begin(), fit.end(), [](char c) { return (c >= 0 && c < ' ') || c == '\x7F'; }, '?');
  return fit;
}

std::string valid_utf8(const std::string& text) {
  return Json::parse(Json(text).dump(-1, ' ', false, Json::error_handler_t::replace)).get<std::string>();
}

std::string aligned(const std::vector<std::string>& headings, const std::vector<std::vector<std::string>>& rows,
                    std::size_t left) {
  std::vector<std::size_t> widths;
  for (std::size_t i = 0; i < headings.size(); ++i) {
    widths.push_back(width(headings[i]));
    for (const auto& row : rows) widths[i] = std::max(widths[i], width(row[i]));
  }
  std::string text;
  const auto append = [&](const std::vector<std::string>& row) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string blanks(widths[i] - width(row[i]), ' ');
      text += "  " + (i < left ? row[i] + blanks : blanks + row[i]);
    }
    text += '\n';
  };
  append(headings);
  for (const auto& row : rows) append(row);
  return text;
}

// File names need not be UTF-8; what is not is replaced.
std::string text_of(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; }
std::string compact_text_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

void print(const std::string& text) { write_file("-", text); }
void print(const Json& json) { print(text_of(json)); }

void note(const std::string& text) { std::fprintf(stderr, "ifsm: %s\n", text.c_str()); }

}  // namespace cli
