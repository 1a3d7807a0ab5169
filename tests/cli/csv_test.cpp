// Tables: what is written reads back bit for bit, and every misuse is told with its place and the way out.
#include "csv.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "failure.h"

namespace cli {
namespace {

std::vector<std::uint64_t> bits(const std::vector<double>& values) {
  std::vector<std::uint64_t> all(values.size());
  std::memcpy(all.data(), values.data(), values.size() * sizeof(double));
  return all;
}

double finite_double_of(std::uint64_t pattern) {
  double value;
  std::memcpy(&value, &pattern, sizeof value);
  return std::isfinite(value) ? value : 0;
}

RC_GTEST_PROP(Csv, WhatIsWrittenReadsBackBitForBit, ()) {
  const auto columns = *rc::gen::inRange<std::size_t>(1, 5);
  const auto rows = *rc::gen::inRange<std::size_t>(1, 30);
  const char separator = *rc::gen::element(',', ';', '\t', ' ');
  const bool header = *rc::gen::arbitrary<bool>();
  Table table{{}, columns, {}};
  for (const auto pattern :
       *rc::gen::container<std::vector<std::uint64_t>>(rows * columns, rc::gen::arbitrary<std::uint64_t>()))
    table.values.push_back(finite_double_of(pattern));
  if (header) table.names = {"x", "y", "z", "w"}, table.names.resize(columns);
  const auto back = parse_csv(format_csv(table, separator), "table");
  RC_ASSERT(back.columns == columns);
  RC_ASSERT(back.names == table.names);
  RC_ASSERT(bits(back.values) == bits(table.values));
}

RC_GTEST_PROP(Csv, NoBytesCrashTheReader, (const std::string& bytes)) {
  try {
    const auto table = parse_csv(bytes, "bytes");
    RC_ASSERT(table.rows() * table.columns == table.values.size());
  } catch (const Failure& failure) {
    RC_ASSERT(failure.code == Exit::Input);
  }
}

// Bytes that are nearly tables, to reach the rules behind the first check.
RC_GTEST_PROP(Csv, NoNearlyTableCrashesTheReader, ()) {
  const auto text = *rc::gen::container<std::string>(
      rc::gen::element('1', '2', '.', ',', ';', ' ', '\t', '\n', '\r', '"', '#', '-', '+', 'e', 'x', 'n'));
  try {
    for (const double value : parse_csv(text, "text").values) RC_ASSERT(std::isfinite(value));
  } catch (const Failure& failure) {
    RC_ASSERT(failure.code == Exit::Input);
  }
}

TEST(Csv, ExtremeDoublesReadBack) {
  using limits = std::numeric_limits<double>;
  for (const double value : {limits::max(), limits::lowest(), limits::min(), limits::denorm_min(), -0.0, 0.1, 1e22}) {
    const auto back = parse_csv(shortest(value), "value").values;
    EXPECT_EQ(bits(back), bits({value})) << shortest(value);
  }
}

struct Spelling {
  const char* name;
  std::string text;
};

class SameTable : public testing::TestWithParam<Spelling> {};

TEST_P(SameTable, IsReadFromEverySpelling) {
  const auto table = parse_csv(GetParam().text, "table");
  EXPECT_EQ(table.columns, 2u);
  EXPECT_EQ(table.values, (std::vector<double>{1.5, -2, 3e4, 0}));
}

INSTANTIATE_TEST_SUITE_P(
    Csv, SameTable,
    testing::Values(Spelling{"commas", "1.5,-2\n3e4,0\n"}, Spelling{"no_last_newline", "1.5,-2\n3e4,0"},
                    Spelling{"semicolons", "1.5;-2\n3e4;0\n"}, Spelling{"tabs", "1.5\t-2\n3e4\t0\n"},
                    Spelling{"blanks", "1.5 -2\n3e4 0\n"}, Spelling{"aligned", "  1.5   -2\n  3e4    0  \n"},
                    Spelling{"commas_and_blanks", "1.5, -2\n3e4 , 0\n"}, Spelling{"crlf", "1.5,-2\r\n3e4,0\r\n"},
                    Spelling{"cr", "1.5,-2\r3e4,0\r"},
                    Spelling{"byte_order_mark",
                             "\xEF\xBB\xBF"
                             "1.5,-2\n3e4,0\n"},
                    Spelling{"header", "x,y\n1.5,-2\n3e4,0\n"},
                    Spelling{"quoted_header", "\"x\",\"y, in km\"\n1.5,-2\n3e4,0\n"},
                    Spelling{"comments", "# a coast\n1.5,-2\n  # more\n3e4,0\n"},
                    Spelling{"blank_lines", "\n1.5,-2\n\n \n3e4,0\n\n"}, Spelling{"plus_signs", "+1.5,-2\n+3e4,+0\n"},
                    Spelling{"quoted_numbers", "\"1.5\",\"-2\"\n\"3e4\",\"0\"\n"}),
    [](const auto& info) { return std::string(info.param.name); });

TEST(Csv, ColumnsAreTakenByNameOrNumberInTheOrderAskedFor) {
  const std::string text = "id,x,y\n7,1,2\n8,3,4\n";
  EXPECT_EQ(parse_csv(text, "t", {{"y", "x"}}).values, (std::vector<double>{2, 1, 4, 3}));
  EXPECT_EQ(parse_csv(text, "t", {{"2", "3"}}).values, (std::vector<double>{1, 2, 3, 4}));
  EXPECT_EQ(parse_csv(text, "t", {{"y", "2"}}).names, (std::vector<std::string>{"y", "x"}));
}

TEST(Csv, ColumnsThatAreNotTakenMayHoldAnything) {
  EXPECT_EQ(parse_csv("name,x\nHöfn,1\n,2\n", "t", {{"x"}}).values, (std::vector<double>{1, 2}));
}

TEST(Csv, GapsAreReadAsNanWhenAskedFor) {
  const auto values = parse_csv("x,y\n1,nan\n,2\nNaN,-NAN\n", "t", {{}, true}).values;
  const std::vector<bool> gaps{false, true, true, false, true, true};
  ASSERT_EQ(values.size(), gaps.size());
  for (std::size_t i = 0; i < gaps.size(); ++i) EXPECT_EQ(std::isnan(values[i]), gaps[i]) << i;
}

std::string refusal(const std::string& text, const TableRules& rules) {
  try {
    parse_csv(text, "log.csv", rules);
    return "accepted";
  } catch (const Failure& failure) {
    return failure.what();
  }
}

TEST(Csv, GapsAreRefusedWithTheCallersWayOut) {
  EXPECT_EQ(refusal("x,y\n1,2\n3,nan\n", {{}, false, "close it"}),
            "log.csv, line 3, column 2 (y): 'nan' is a gap; close it, or else fill the cell in, remove the line, or "
            "leave the column out with --columns.");
  EXPECT_EQ(refusal("1,\n", {}),
            "log.csv, line 1, column 2: is empty; fill the cell in, remove the line, or leave the column out with "
            "--columns.");
  EXPECT_NE(refusal("1,inf\n", {{}, true}).find("'inf' is not finite; correct it"), std::string::npos);
  EXPECT_NE(refusal("1,km\n2,3\n1,nanometre\n", {{}, true}).find("'km' is not a number"), std::string::npos);
}

struct Misuse {
  const char* name;
  std::string text;
  std::vector<std::string> said;  // each of these is in the message
  std::vector<std::string> columns = {};
  Exit code = Exit::Input;
};

class MisusedTable : public testing::TestWithParam<Misuse> {};

TEST_P(MisusedTable, IsRefusedWithItsPlaceAndTheWayOut) {
  const auto& misuse = GetParam();
  try {
    parse_csv(misuse.text, "coast.csv", {misuse.columns});
    FAIL() << "was accepted";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code, misuse.code);
    const std::string message = failure.what();
    EXPECT_NE(message.find("coast.csv"), message.npos) << message;
    for (const auto& words : misuse.said) EXPECT_NE(message.find(words), message.npos) << message;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Csv, MisusedTable,
    testing::Values(
        Misuse{"empty", "", {"is empty", "Expected: lines of numbers"}},
        Misuse{"only_comments", "# nothing\n\n", {"holds no numbers"}},
        Misuse{"only_header", "x,y\n", {"a header but no numbers"}},
        Misuse{"binary",
               std::string("\x7f"
                           "ELF\0\1",
                           6),
               {"is a binary file"}},
        Misuse{"json", "{\"points\": []}", {"is JSON"}},
        Misuse{"utf16",
               std::string("\xFF\xFE"
                           "1\0",
                           4),
               {"UTF-16", "save it as UTF-8"}},
        Misuse{"ragged", "x,y\n1,2\n3\n", {"line 3", "1 value where line 1 has 2"}},
        Misuse{"too_long_row", "1,2\n3,4,5\n", {"line 2", "3 values where line 1 has 2"}},
        Misuse{"decimal_commas", "3,14;2,7\n", {"line 1, column 1", "'3,14'", "decimal comma", "with a point"}},
        Misuse{"decimal_comma_later", "x;y\n1;2\n3;2,7\n", {"line 3, column 2 (y)", "'2,7'", "decimal comma"}},
        Misuse{"decimal_commas_and_tabs", "3,14\t2,7\n", {"'3,14'", "decimal comma"}},
        Misuse{"decimal_commas_and_blanks", "3,14 2,7\n", {"line 1, column 2", "'14 2'", "decimal commas"}},
        Misuse{"decimal_commas_and_commas",
               "x,y\n3,14,2,7\n",
               {"line 2", "4 values where line 1 has 2", "decimal commas?"}},
        Misuse{"quoted_decimal_commas", "\"3,14\",\"2,7\"\n", {"'3,14'", "decimal comma"}},
        Misuse{"nan", "1,2\nnan,3\n", {"line 2, column 1", "'nan' is a gap", "remove the line"}},
        Misuse{"infinity", "1,-inf\n", {"line 1, column 2", "'-inf' is not finite"}},
        Misuse{"empty_cell", "x,y\n1,\n", {"line 2, column 2 (y)", "is empty", "remove the line"}},
        Misuse{"word", "x,y\n1,2\n3,abc\n", {"line 3, column 2 (y)", "'abc' is not a number"}},
        Misuse{"half_a_number", "1,2\n3,4km\n", {"line 2, column 2", "'4km' is not a number"}},
        Misuse{"too_large", "1,1e999\n", {"line 1, column 2", "'1e999' is beyond the range"}},
        Misuse{
            "unknown_column", "x,y\n1,2\n", {"no column 'z'", "x, y", "the numbers 1 to 2"}, {"x", "z"}, Exit::Usage},
        Misuse{
            "name_without_header", "1,2\n", {"no column 'x'", "no header", "the numbers 1 to 2"}, {"x"}, Exit::Usage},
        Misuse{"column_zero", "1,2\n", {"no column '0'"}, {"0"}, Exit::Usage},
        Misuse{"column_beyond", "1,2\n", {"no column '3'"}, {"3"}, Exit::Usage}),
    [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace cli
