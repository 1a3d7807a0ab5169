// What a command tells: aligned text for people, JSON for programs.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace cli {

using Json = nlohmann::ordered_json;

// A number as people read it: `digits` significant ones.
std::string rounded(double value, int digits = 4);

// Columns under their headings, aligned to the right, two blanks apart.
std::string aligned(const std::vector<std::string>& headings, const std::vector<std::vector<std::string>>& rows);

// To standard output. Throws Failure{Output}.
void print(const std::string& text);
void print(const Json& json);

// A note to standard error.
void note(const std::string& text);

}  // namespace cli
