#include "io/fractint.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <map>
#include <utility>

#include "io/text_lines.h"

namespace ifsm::core {
namespace {

constexpr std::size_t most_systems = 1 << 12, most_text = std::size_t{1} << 26;

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  return text;
}

// Text that is read from the left; comments, from ";" to the line's end, are spaces.
class Reader {
 public:
  explicit Reader(std::string_view text) : text_(text) {}

  std::int64_t line() const { return line_; }

  // Past spaces and commas.
  bool at_end() {
    while (!text_.empty() && (is_space(text_.front()) || text_.front() == ',' || text_.front() == ';')) skip_one();
    return text_.empty();
  }
  char front() const { return text_.front(); }
  void skip_one() {
    if (text_.front() == ';') return text_.remove_prefix(std::min(text_.find('\n'), text_.size()));
    line_ += text_.front() == '\n' ? 1 : 0;
    text_.remove_prefix(1);
  }

  // Up to one of some characters, which stays; the text's end is one, too.
  std::string_view until(std::string_view ends) {
    const std::size_t length = std::min(text_.find_first_of(ends), text_.size());
    const std::string_view found = text_.substr(0, length);
    line_ += std::count(found.begin(), found.end(), '\n');
    text_.remove_prefix(length);
    return found;
  }

 private:
  std::string_view text_;
  std::int64_t line_ = 1;
};

// The numbers of a block, and the line of each.
struct Numbers {
  std::vector<double> values;
  std::vector<std::int64_t> lines;
};

std::size_t numbers_per_map(int dimension) { return dimension == 3 ? 13 : 7; }

// Numbers that are not those of whole maps: the first line of another number of them than a map takes is to blame, if
// there is one after or before lines that are right.
Error incomplete(const Numbers& numbers, std::int64_t begin, int dimension, const std::string& name) {
  const std::size_t per_map = numbers_per_map(dimension);
  const std::string each = "each map takes " + std::to_string(per_map) +
                           (dimension == 2 ? " (write (3D) after the name of one of space)." : ".");
  std::map<std::int64_t, std::size_t> rows;
  for (const std::int64_t line : numbers.lines) ++rows[line];
  const auto is_right = [&](const auto& row) { return row.second == per_map; };
  const auto wrong = std::find_if_not(rows.begin(), rows.end(), is_right);
  if (std::any_of(rows.begin(), rows.end(), is_right))
    return at_line(
        Status::format, wrong->first,
        "This row of the system " + quoted(name) + " has " + std::to_string(wrong->second) + " numbers; " + each);
  return at_line(Status::format, begin,
                 "The system " + quoted(name) + " has " + std::to_string(numbers.values.size()) + " numbers; " + each);
}

// Up to a block's brace, which is left behind.
Numbers read_numbers(Reader& reader, int dimension, const std::string& name) {
  const std::int64_t begin = reader.line();
  const std::size_t per_map = numbers_per_map(dimension);
  Numbers numbers;
  for (;;) {
    if (reader.at_end())
      throw at_line(Status::format, begin, "The system " + quoted(name) + " has no end; close it by \"}\".");
    if (reader.front() == '}') break;
    const std::int64_t line = reader.line();
    const std::string_view word = reader.until(" \t\r\n\f\v,;}");
    if (const Status status = read_number(word, numbers.values.emplace_back()); status != Status::ok)
      throw no_number(status, word, line, "a system's rows hold numbers up to \"}\".");
    numbers.lines.push_back(line);
    if (numbers.values.size() > per_map * static_cast<std::size_t>(System::most_maps))
      throw at_line(Status::limit, line, "The system " + quoted(name) + " has more than 256 maps.");
  }
  reader.skip_one();
  if (numbers.values.empty() || numbers.values.size() % per_map != 0) throw incomplete(numbers, begin, dimension, name);
  return numbers;
}

SystemPtr system_of(const std::vector<double>& values, int dimension) {
  std::vector<Affine> maps;
  std::vector<double> weights;
  for (const double* v = values.data(); v != values.data() + values.size();) {
    Affine map;
    for (int row = 0; row < dimension; ++row)
      for (int column = 0; column < dimension; ++column) map.linear(row, column) = *v++;
    for (int axis = 0; axis < dimension; ++axis) map.shift(axis) = *v++;
    maps.push_back(map);
    weights.push_back(*v++);
  }
  return std::make_shared<System>(dimension, std::move(maps), std::move(weights));
}

// A block's name, and whether "(3D)" follows it.
std::pair<std::string, int> heading(std::string_view text) {
  constexpr std::string_view space = "(3d)";
  if (const std::size_t at = lower(text).rfind(space); at != std::string::npos)
    return {std::string(trimmed(text.substr(0, at))), 3};
  return {std::string(trimmed(text)), 2};
}

}  // namespace

std::vector<FractintSystem> read_fractint(std::string_view text) {
  if (text.size() > most_text) throw at_line(Status::limit, 1, "The file has more than 64 MiB.");
  Reader reader(text);
  std::vector<FractintSystem> all;
  while (!reader.at_end()) {
    const std::int64_t line = reader.line();
    const auto [name, dimension] = heading(reader.until("{};\n"));
    if (reader.at_end() || reader.front() != '{' || name.empty())
      throw at_line(Status::format, line, quoted(name) + " begins no system; one is a name, then its rows in braces.");
    reader.skip_one();
    if (lower(name) == "comment") {
      while (!reader.at_end() && reader.front() != '}') reader.skip_one();
      if (reader.at_end()) throw at_line(Status::format, line, "The comment has no end; close it by \"}\".");
      reader.skip_one();
      continue;
    }
    if (all.size() == most_systems) throw at_line(Status::limit, line, "The file has more than 4096 systems.");
    const Numbers numbers = read_numbers(reader, dimension, name);
    try {
      all.push_back({name, system_of(numbers.values, dimension)});
    } catch (const Error& error) {
      // Its index is that of a map.
      const std::size_t first =
          static_cast<std::size_t>(std::max<std::int64_t>(error.index(), 0)) * numbers_per_map(dimension);
      throw at_line(error.status(), error.index() < 0 ? line : numbers.lines[first],
                    "The system " + quoted(name) + ": " + error.what());
    }
  }
  if (all.empty())
    throw at_line(Status::format, 1, "The file holds no system; one is a name, then its rows in braces.");
  return all;
}

std::string write_fractint(std::string_view name, const System& system) {
  std::string text;
  for (const char c : name) {
    const bool plain =
        static_cast<unsigned char>(c) > ' ' && std::string_view("{}();,").find(c) == std::string_view::npos;
    text += plain ? c : '_';
  }
  if (text.empty() || lower(text) == "comment") text += '_';
  text += system.dimension() == 3 ? " (3D) {\n" : " {\n";
  const std::vector<double>& weights = system.weights().empty() ? system.probabilities() : system.weights();
  for (std::size_t i = 0; i < system.maps().size(); ++i) {
    const Affine& map = system.maps()[i];
    for (int row = 0; row < system.dimension(); ++row)
      for (int column = 0; column < system.dimension(); ++column) text += " " + text_of(map.linear(row, column));
    for (int axis = 0; axis < system.dimension(); ++axis) text += " " + text_of(map.shift(axis));
    text += " " + text_of(weights[i]) + "\n";
  }
  return text + "}\n";
}

}  // namespace ifsm::core
