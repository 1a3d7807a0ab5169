// What a command tells: aligned text for people, JSON for programs.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

namespace cli {

using Json = nlohmann::ordered_json;

// A number as people read it: `digits` significant ones.
std::string rounded(double value, int digits = 4);

// "1 gap", "3 gaps".
std::string counted(std::size_t number, const std::string& noun);
std::string counted(const Json& number, const std::string& noun);

// Not the first byte of a character of UTF-8.
inline bool continues_character(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

// Text from a file, fit for a terminal: no control characters, and not longer than a line has room for.
std::string printable(std::string_view text);

// The same text, or what is left of it in UTF-8: other bytes, as file names may have them, are replaced.
std::string valid_utf8(const std::string& text);

// Columns under their headings, two blanks apart, aligned to the right; the first `left` of them to the left.
std::string aligned(const std::vector<std::string>& headings, const std::vector<std::vector<std::string>>& rows,
                    std::size_t left = 0);

std::string text_of(const Json& json);          // for people, one member a line
std::string compact_text_of(const Json& json);  // for programs, all in one line

// To standard output. Throws Failure{Output}.
void print(const std::string& text);
void print(const Json& json);

// A note to standard error.
void note(const std::string& text);

}  // namespace cli
