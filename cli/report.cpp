#include "report.h"

#include <algorithm>
#include <charconv>
#include <cstdio>

#include "files.h"

namespace cli {

std::string rounded(double value, int digits) {
  char text[64];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::general, digits).ptr;
  return {text, end};
}

std::string aligned(const std::vector<std::string>& headings, const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths;
  for (std::size_t i = 0; i < headings.size(); ++i) {
    widths.push_back(headings[i].size());
    for (const auto& row : rows) widths[i] = std::max(widths[i], row[i].size());
  }
  std::string text;
  const auto append = [&](const std::vector<std::string>& row) {
    for (std::size_t i = 0; i < row.size(); ++i) text += std::string(2 + widths[i] - row[i].size(), ' ') + row[i];
    text += '\n';
  };
  append(headings);
  for (const auto& row : rows) append(row);
  return text;
}

void print(const std::string& text) { write_file("-", text); }
void print(const Json& json) { print(json.dump(2) + "\n"); }

void note(const std::string& text) { std::fprintf(stderr, "ifsm: %s\n", text.c_str()); }

}  // namespace cli
