#include "csv.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <system_error>

#include "failure.h"

namespace cli {
namespace {

constexpr std::string_view blanks = " \t";
constexpr char blank_separated = ' ';

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(blanks);
  if (first == text.npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::string quoted(std::string_view value) {
  constexpr std::size_t longest = 40;
  return "'" + std::string(value.substr(0, longest)) + (value.size() > longest ? "…'" : "'");
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const auto& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

// ---- lines

struct Line {
  std::size_t number;  // from 1
  std::string_view text;
};

// Takes the first line off `rest`; it may end in LF, CRLF or CR.
std::string_view take_line(std::string_view& rest) {
  const auto end = rest.find_first_of("\r\n");
  const auto line = rest.substr(0, end);
  if (end == rest.npos) {
    rest = {};
  } else {
    const bool crlf = rest.substr(end, 2) == "\r\n";
    rest.remove_prefix(end + (crlf ? 2 : 1));
  }
  return line;
}

// The lines that hold something: neither blank nor a comment.
std::vector<Line> content(std::string_view text) {
  std::vector<Line> lines;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const auto line = take_line(text);
    const auto inner = trimmed(line);
    if (!inner.empty() && inner.front() != '#') lines.push_back({number, line});
  }
  return lines;
}

// ---- cells

char separator_of(std::string_view line) {
  for (const char candidate : {';', '\t', ','})
    if (line.find(candidate) != line.npos) return candidate;
  return blank_separated;
}

// Splits off one cell in double quotes; a doubled quote inside stands for one.
std::string take_quoted(std::string_view& rest) {
  std::string cell;
  for (rest.remove_prefix(1); !rest.empty(); rest.remove_prefix(1)) {
    if (rest.front() == '"') {
      rest.remove_prefix(1);
      if (rest.empty() || rest.front() != '"') break;
    }
    cell += rest.front();
  }
  return cell;
}

std::vector<std::string> split(std::string_view line, char separator) {
  const bool by_blanks = separator == blank_separated;
  const std::string_view ends = by_blanks ? blanks : std::string_view(&separator, 1);
  std::vector<std::string> cells;
  for (auto rest = by_blanks ? trimmed(line) : line;;) {
    const bool in_quotes = !rest.empty() && rest.front() == '"';
    cells.emplace_back(in_quotes ? take_quoted(rest) : std::string(trimmed(rest.substr(0, rest.find_first_of(ends)))));
    const auto end = rest.find_first_of(ends);
    if (end == rest.npos) return cells;
    rest = rest.substr(end + 1);
    rest.remove_prefix(std::min(rest.size(), rest.find_first_not_of(by_blanks ? blanks : " ")));
  }
}

// ---- numbers

std::string_view without_plus(std::string_view cell) {
  return cell.size() > 1 && cell[0] == '+' && cell[1] != '-' ? cell.substr(1) : cell;
}

std::from_chars_result convert(std::string_view cell, double& value) {
  const auto text = without_plus(cell);
  return std::from_chars(text.data(), text.data() + text.size(), value);
}

bool is_number(std::string_view cell) {
  double value = 0;
  const auto result = convert(cell, value);
  return result.ec != std::errc::invalid_argument && result.ptr == cell.data() + cell.size();
}

// Meant as a number, well formed or not: a header's name does not start like this.
bool meant_as_number(const std::string& cell) {
  const auto start = cell.find_first_not_of("+-.,");
  return is_number(cell) || (start != cell.npos && is_digit(cell[start]));
}

bool has_decimal_comma(std::string_view cell) {
  const auto comma = cell.find(',');
  if (comma == cell.npos) return false;
  std::string with_point(cell);
  with_point[comma] = '.';
  return is_number(with_point);
}

std::string decimal_comma_advice(std::string_view cell) {
  return quoted(cell) +
         " has a decimal comma; numbers are written with a point here. Export the table with decimal points, or "
         "turn every , between digits into . when the columns are kept apart by ; or tabs";
}

bool is_gap(std::string_view cell) {
  double value = 0;
  convert(cell, value);
  return cell.empty() || (is_number(cell) && std::isnan(value));
}

std::string gap_diagnosis(std::string_view cell, const std::string& advice) {
  return (cell.empty() ? "is empty" : quoted(cell) + " is a gap") + "; " +
         (advice.empty() ? "" : advice + ", or else ") +
         "fill the cell in, remove the line, or leave the column out with --columns";
}

// What is wrong with a cell that is no gap, and what to do.
std::string diagnosis(std::string_view cell, char separator) {
  double value = 0;
  const auto result = convert(cell, value);
  if (is_number(cell) && result.ec == std::errc::result_out_of_range)
    return quoted(cell) + " is beyond the range of double precision; use another unit";
  if (is_number(cell)) return quoted(cell) + " is not finite; correct it, or remove the line";
  if (has_decimal_comma(cell)) return decimal_comma_advice(cell);
  if (separator == ',' && cell.find_first_of(blanks) != cell.npos)
    return quoted(cell) +
           " is two values: blanks between the columns and decimal commas in the numbers? Write the "
           "numbers with a point, and keep to one separator";
  return quoted(cell) + " is not a number; correct it, or choose other columns with --columns";
}

// ---- tables

class Reader {
 public:
  Reader(std::string_view text, const std::string& source, const TableRules& rules)
      : source_(source), rules_(rules), lines_(content(text)) {
    if (lines_.empty()) fail("holds no numbers: only blank lines or comments");
    separator_ = separator_of(lines_.front().text);
    const auto first = split(lines_.front().text, separator_);
    width_ = first.size();
    if (is_header(first)) names_ = first;
  }

  Table read() const {
    const auto taken = rules_.columns.empty() ? all_columns() : chosen(rules_.columns);
    Table table;
    table.columns = taken.size();
    if (!names_.empty())
      for (const auto column : taken) table.names.push_back(names_[column]);
    for (std::size_t i = names_.empty() ? 0 : 1; i < lines_.size(); ++i) append(lines_[i], taken, table.values);
    if (table.values.empty()) fail("holds a header but no numbers");
    return table;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw Failure(Exit::Input, source_ + " " + what + "."); }

  [[noreturn]] void fail_at(const Line& line, const std::string& what) const {
    throw Failure(Exit::Input, source_ + ", line " + std::to_string(line.number) + what + ".");
  }

  static bool is_header(const std::vector<std::string>& cells) {
    return std::none_of(cells.begin(), cells.end(), meant_as_number) &&
           std::any_of(cells.begin(), cells.end(), [](const auto& cell) { return !cell.empty(); });
  }

  std::vector<std::size_t> all_columns() const {
    std::vector<std::size_t> all(width_);
    std::iota(all.begin(), all.end(), std::size_t{0});
    return all;
  }

  std::vector<std::size_t> chosen(const std::vector<std::string>& selection) const {
    std::vector<std::size_t> columns;
    for (const auto& wanted : selection) columns.push_back(position(wanted));
    return columns;
  }

  std::size_t position(const std::string& wanted) const {
    const auto named = std::find(names_.begin(), names_.end(), wanted);
    if (named != names_.end()) return static_cast<std::size_t>(named - names_.begin());
    std::size_t number = 0;
    const auto result = std::from_chars(wanted.data(), wanted.data() + wanted.size(), number);
    const bool counted = result.ec == std::errc() && result.ptr == wanted.data() + wanted.size();
    if (counted && number >= 1 && number <= width_) return number - 1;
    const auto numbers = "the numbers 1 to " + std::to_string(width_);
    throw Failure(Exit::Usage, "--columns: " + source_ + " has no column " + quoted(wanted) + "; it has " +
                                   (names_.empty() ? "no header, so use " + numbers
                                                   : "the columns " + joined(names_) + ", or " + numbers) +
                                   ".");
  }

  void append(const Line& line, const std::vector<std::size_t>& taken, std::vector<double>& values) const {
    const auto cells = split(line.text, separator_);
    if (cells.size() != width_) fail_at(line, ragged(cells.size()));
    for (const auto column : taken) values.push_back(number(line, cells[column], column));
  }

  std::string ragged(std::size_t found) const {
    return ": " + std::to_string(found) + (found == 1 ? " value" : " values") + " where line " +
           std::to_string(lines_.front().number) + " has " + std::to_string(width_) +
           (separator_ == ',' && found == 2 * width_ ? " (decimal commas? write numbers with a point)" : "") +
           "; every line needs the same number of values, kept apart by the same separator";
  }

  double number(const Line& line, std::string_view cell, std::size_t column) const {
    double value = 0;
    const auto result = convert(cell, value);
    if (result.ec == std::errc() && result.ptr == cell.data() + cell.size() && std::isfinite(value)) return value;
    const bool gap = is_gap(cell);
    if (gap && rules_.gaps) return std::numeric_limits<double>::quiet_NaN();
    const auto name = names_.empty() || names_[column].empty() ? "" : " (" + names_[column] + ")";
    fail_at(line, ", column " + std::to_string(column + 1) + name + ": " +
                      (gap ? gap_diagnosis(cell, rules_.gap_advice) : diagnosis(cell, separator_)));
  }

  const std::string& source_;
  const TableRules& rules_;
  std::vector<Line> lines_;
  char separator_ = blank_separated;
  std::size_t width_ = 0;
  std::vector<std::string> names_;
};

// Why bytes cannot be a table at all; nothing when they may be one.
std::optional<std::string> not_text(std::string_view bytes) {
  if (bytes.empty()) return "is empty";
  if (bytes.substr(0, 2) == "\xFF\xFE" || bytes.substr(0, 2) == "\xFE\xFF")
    return "is UTF-16 text; save it as UTF-8 or plain ASCII";
  if (bytes.front() == '{') return "is JSON, not a table of numbers";
  const auto control = [](char c) { return (c >= 0 && c < '\t') || (c > '\r' && c < ' ') || c == '\x7F'; };
  if (std::any_of(bytes.begin(), bytes.end(), control)) return "is a binary file, not a table of numbers";
  return std::nullopt;
}

}  // namespace

Table parse_csv(std::string_view text, const std::string& source, const TableRules& rules) {
  if (const auto reason = not_text(text))
    throw Failure(Exit::Input, source + " " + *reason +
                                   ". Expected: lines of numbers kept apart by commas, "
                                   "semicolons, tabs or blanks.");
  if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);
  return Reader(text, source, rules).read();
}

std::string shortest(double value) {
  std::array<char, 32> text;  // the longest shortest double has 24 characters
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

std::string format_csv(const Table& table, char separator) {
  std::string text;
  for (std::size_t i = 0; i < table.names.size(); ++i)
    text += table.names[i] + (i + 1 < table.names.size() ? separator : '\n');
  for (std::size_t i = 0; i < table.values.size(); ++i)
    text += shortest(table.values[i]) + ((i + 1) % table.columns == 0 ? '\n' : separator);
  return text;
}

}  // namespace cli
