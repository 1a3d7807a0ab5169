// Tables of numbers as text: what spreadsheets, gnuplot and numpy write and read.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace cli {

struct Table {
  std::vector<std::string> names;  // of the columns; empty when the text has no header
  std::size_t columns = 0;
  std::vector<double> values;  // row-major

  std::size_t rows() const { return columns == 0 ? 0 : values.size() / columns; }
};

struct TableRules {
  std::vector<std::string> columns = {};  // to take, in that order, by header or by number from 1; empty takes all
  bool gaps = false;                      // cells of them that are empty or NaN are read as NaN; otherwise refused,
  std::string gap_advice = {};            // with this way out beside the usual ones
};

// Reads comma-, semicolon-, tab- or blank-separated numbers: with or without a header, a byte order mark, CRLF,
// comment lines (#) and blank lines. Every number is finite, but for gaps. Throws Failure{Input}, which names `source`,
// line, column, value and the way out, and Failure{Usage} for columns that the table does not have.
Table parse_csv(std::string_view text, const std::string& source, const TableRules& rules = {});

// The shortest decimal text that reads back as the same double, with a point whatever the locale.
std::string shortest(double value);

// One line a row, ended by \n, after a line of names when there are any.
std::string format_csv(const Table& table, char separator = ',');

}  // namespace cli
