// The one exception type of the library: it says which argument is wrong, where, what its value is, and the way out.
// src/capi turns it into the C error record.
#pragma once

#include <cstdint>
#include <exception>
#include <limits>
#include <string>

namespace ifsm::core {

// The numbers of ifsm_status; src/capi asserts that they agree.
enum class Status : std::int32_t {
  ok = 0,
  invalid_handle = 1,
  null = 2,
  range = 3,
  not_finite = 4,
  shape = 5,
  singular = 6,
  capacity = 7,
  options = 8,
  format = 9,
  version = 10,
  limit = 11,
  cancelled = 12,
  busy = 13,
  memory = 14,
  numerical = 15,
  internal = 16,
};

class Error : public std::exception {
 public:
  // `message` is a full sentence that says what to do.
  Error(Status status, std::string argument, std::string message);

  Error&& at(std::int64_t index) &&;
  Error&& with(double value) &&;
  Error&& needs(std::int64_t required) &&;

  const char* what() const noexcept override { return message_.c_str(); }
  Status status() const { return status_; }
  const std::string& argument() const { return argument_; }
  std::int64_t index() const { return index_; }
  double value() const { return value_; }
  std::int64_t required() const { return required_; }

 private:
  Status status_;
  std::string argument_;
  std::string message_;
  std::int64_t index_ = -1;
  double value_ = std::numeric_limits<double>::quiet_NaN();
  std::int64_t required_ = -1;
};

// `value` when low <= value <= high, else a range error that names `argument`.
std::int64_t in_range(std::int64_t value, std::int64_t low, std::int64_t high, const char* argument);

// The first of `count` doubles that is not finite is an error with its index.
void require_finite(const double* values, std::int64_t count, const char* argument);
void require_finite(double value, const char* argument);  // one alone: without an index

// a * b, or a limit error when it leaves 2^62: sizes are checked before they are multiplied.
std::int64_t checked_product(std::int64_t a, std::int64_t b, const char* argument);

// Shortest text that reads back as the same double.
std::string text_of(double value);

}  // namespace ifsm::core
