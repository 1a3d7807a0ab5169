#include "base/error.h"

#include <charconv>
#include <cmath>
#include <utility>

namespace ifsm::core {

Error::Error(Status status, std::string argument, std::string message)
    : status_(status), argument_(std::move(argument)), message_(std::move(message)) {}

Error&& Error::at(std::int64_t index) && {
  index_ = index;
  return std::move(*this);
}

Error&& Error::with(double value) && {
  value_ = value;
  return std::move(*this);
}

Error&& Error::needs(std::int64_t required) && {
  required_ = required;
  return std::move(*this);
}

std::int64_t in_range(std::int64_t value, std::int64_t low, std::int64_t high, const char* argument) {
  if (low <= value && value <= high) return value;
  const std::string allowed = low < high    ? "give a value from " + std::to_string(low) + " to " + std::to_string(high)
                              : low == high ? "it must be " + std::to_string(low)
                                            : "there are none to choose from here";
  throw Error(Status::range, argument, std::string(argument) + " is " + std::to_string(value) + "; " + allowed + ".")
      .with(static_cast<double>(value));
}

void require_finite(const double* values, std::int64_t count, const char* argument) {
  for (std::int64_t i = 0; i < count; ++i)
    if (!std::isfinite(values[i]))
      throw Error(Status::not_finite, argument,
                  std::string(argument) + "[" + std::to_string(i) + "] is " + text_of(values[i]) +
                      "; every value must be finite: remove or replace it.")
          .at(i)
          .with(values[i]);
}

void require_finite(double value, const char* argument) {
  if (std::isfinite(value)) return;
  throw Error(Status::not_finite, argument, std::string(argument) + " is " + text_of(value) + "; give a finite number.")
      .with(value);
}

std::int64_t checked_product(std::int64_t a, std::int64_t b, const char* argument) {
  constexpr std::int64_t most = std::int64_t{1} << 62;
  if (a >= 0 && b >= 0 && (b == 0 || a <= most / b)) return a * b;
  throw Error(Status::limit, argument,
              std::string(argument) + " asks for " + std::to_string(a) + " times " + std::to_string(b) +
                  " values, more than can be counted; give a smaller one.")
      .with(static_cast<double>(a));
}

std::string text_of(double value) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value);
  return {buffer, end.ptr};
}

}  // namespace ifsm::core
