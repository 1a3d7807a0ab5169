// How values stand in the file: README.md has the rules.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace conformance {

using Json = nlohmann::ordered_json;  // arguments and results stand in C's order

// Results as JSON; of structs the generated functions.cpp has one each.
template <class T>
Json json_of(const T& told);
template <>
Json json_of(const double& number);
template <>
Json json_of(const std::int32_t& number);
template <>
Json json_of(const std::int64_t& number);
template <>
Json json_of(const char* const& text);

Json json_of(const std::vector<double>& numbers);
Json json_of(const std::vector<std::int32_t>& numbers);
Json json_of(const std::vector<std::uint32_t>& numbers);
Json json_of(const std::vector<std::uint8_t>& bytes);

// And back.
double real_of(const Json& value);
std::int64_t signed_of(const Json& value);
std::uint64_t unsigned_of(const Json& value);
void read(const Json& value, std::vector<double>& numbers);
void read(const Json& value, std::vector<std::int32_t>& numbers);
void read(const Json& value, std::vector<std::int64_t>& numbers);
void read(const Json& value, std::vector<std::uint32_t>& numbers);
void read(const Json& value, std::vector<std::uint8_t>& bytes);

}  // namespace conformance
