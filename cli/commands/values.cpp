#include "commands/values.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <optional>

namespace cli {
namespace {

template <class Number>
std::optional<Number> parsed(const std::string& text) {
  const auto start = text.data() + (text.size() > 1 && text[0] == '+' && text[1] != '-' ? 1 : 0);
  const auto end = text.data() + text.size();
  Number value = 0;
  const auto [rest, error] = std::from_chars(start, end, value);
  return error == std::errc() && rest == end ? std::optional(value) : std::nullopt;
}

CLI::Validator whole_number_or(const std::string& word, std::uint64_t low, std::uint64_t high) {
  constexpr std::uint64_t no_limit = std::numeric_limits<std::int64_t>::max();
  const auto range =
      high < no_limit ? std::to_string(low) + " to " + std::to_string(high) : "from " + std::to_string(low);
  const auto told = "a whole number " + (high < no_limit ? "from " + range : range + " to " + std::to_string(high)) +
                    (word.empty() ? "" : ", or " + word);
  return {[=](std::string& text) -> std::string {
            if (!word.empty() && text == word) return {};
            const auto value = parsed<std::uint64_t>(text);
            if (!value || *value < low || *value > high) return "'" + text + "' is not " + told;
            text = std::to_string(*value);
            return {};
          },
          range + (word.empty() ? "" : ", or " + word)};
}

CLI::Validator number(const std::string& told, const std::function<bool(double)>& fine) {
  return {[=](std::string& text) -> std::string {
            const auto value = parsed<double>(text);
            return value && std::isfinite(*value) && fine(*value) ? "" : "'" + text + "' is not a number " + told;
          },
          told};
}

}  // namespace

CLI::Validator whole_number(std::uint64_t low, std::uint64_t high) { return whole_number_or("", low, high); }
CLI::Validator whole_number_or_auto(std::uint64_t low, std::uint64_t high) {
  return whole_number_or("auto", low, high);
}

CLI::Validator number_from_zero() {
  return number("from 0 on", [](double value) { return value >= 0; });
}
CLI::Validator number_above_zero() {
  return number("above 0", [](double value) { return value > 0; });
}

CLI::Validator number_between(const std::string& low, const std::string& high) {
  return number("from " + low + " to " + high, [least = *parsed<double>(low), most = *parsed<double>(high)](
                                                   double value) { return least <= value && value <= most; });
}

CLI::Validator one_of(const std::vector<std::string>& words) {
  std::string all;
  for (const auto& word : words) all += (all.empty() ? "" : ", ") + word;
  return {[=](std::string& text) -> std::string {
            const bool known = std::find(words.begin(), words.end(), text) != words.end();
            return known ? "" : "'" + text + "' is none of " + all;
          },
          ""};
}

CLI::Validator distance_name() { return one_of({"rms", "max", "hausdorff"}); }

ifsm::Distance distance_of(const std::string& name) {
  if (name == "max") return ifsm::Distance::largest;
  return name == "hausdorff" ? ifsm::Distance::hausdorff : ifsm::Distance::rms;
}

CLI::Validator column_name() {
  return {[](std::string& text) -> std::string {
            const bool option = text.size() > 1 && text.front() == '-';
            return option ? "'" + text + "' is no column; give headers or numbers with commas between them, e.g. x,y"
                          : "";
          },
          ""};
}

}  // namespace cli
