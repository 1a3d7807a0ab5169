#include "values.h"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>

namespace conformance {
namespace {

constexpr std::int64_t largest_in_a_double = std::int64_t{1} << 53;

const Json& tagged(const Json& value, const char* tag) {
  if (!value.is_object() || !value.contains(tag)) throw std::runtime_error(value.dump() + " is no " + tag);
  return value.at(tag);
}

}  // namespace

template <>
Json json_of(const double& number) {
  if (number != number) return "nan";  // whatever its sign
  std::array<char, 40> text{};
  static_cast<void>(std::snprintf(text.data(), text.size(), "%a", number));
  return text.data();
}

template <>
Json json_of(const std::int64_t& number) {
  if (number >= -largest_in_a_double && number <= largest_in_a_double) return number;
  return std::to_string(number);
}

template <>
Json json_of(const std::int32_t& number) {
  return number;
}

template <>
Json json_of(const char* const& text) {
  return {{"text", text}};
}

Json json_of(const std::vector<double>& numbers) {
  Json list = Json::array();
  for (const double number : numbers) list.push_back(json_of(number));
  return list;
}

Json json_of(const std::vector<std::int32_t>& numbers) { return {{"int32", numbers}}; }

Json json_of(const std::vector<std::uint32_t>& numbers) { return {{"uint32", numbers}}; }

Json json_of(const std::vector<std::uint8_t>& bytes) {
  constexpr char digits[] = "0123456789abcdef";
  std::string text;
  for (const std::uint8_t byte : bytes) text += {digits[byte / 16], digits[byte % 16]};
  return {{"bytes", text}};
}

double real_of(const Json& value) {
  const auto text = value.get<std::string>();
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0') throw std::runtime_error(text + " is no double");
  return number;
}

std::int64_t signed_of(const Json& value) {
  return value.is_string() ? std::stoll(value.get<std::string>()) : value.get<std::int64_t>();
}

std::uint64_t unsigned_of(const Json& value) {
  return value.is_string() ? std::stoull(value.get<std::string>()) : value.get<std::uint64_t>();
}

void read(const Json& value, std::vector<double>& numbers) {
  numbers.clear();
  for (const Json& number : value) numbers.push_back(real_of(number));
}

void read(const Json& value, std::vector<std::int32_t>& numbers) {
  numbers.clear();
  for (const Json& number : tagged(value, "int32")) numbers.push_back(static_cast<std::int32_t>(signed_of(number)));
}

void read(const Json& value, std::vector<std::int64_t>& numbers) {
  numbers.clear();
  for (const Json& number : tagged(value, "int64")) numbers.push_back(signed_of(number));
}

void read(const Json& value, std::vector<std::uint32_t>& numbers) {
  numbers.clear();
  for (const Json& number : tagged(value, "uint32")) numbers.push_back(static_cast<std::uint32_t>(unsigned_of(number)));
}

void read(const Json& value, std::vector<std::uint8_t>& bytes) {
  bytes.clear();
  const auto text = tagged(value, "bytes").get<std::string>();
  for (std::size_t i = 0; i < text.size(); i += 2)
    bytes.push_back(static_cast<std::uint8_t>(std::stoi(text.substr(i, 2), nullptr, 16)));
}

}  // namespace conformance
