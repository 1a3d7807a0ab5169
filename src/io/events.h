// A file as a sequence of events. Only events.cpp knows JSON, CBOR and the parser that reads them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>

namespace ifsm::core {

using Scalar = std::variant<std::nullptr_t, bool, std::int64_t, double, std::string_view>;

class Events {
 public:
  virtual ~Events() = default;
  virtual void scalar(const Scalar& value) = 0;  // texts are borrowed during the call; doubles may be NaN or infinite
  virtual void object() = 0;
  virtual void array() = 0;
  virtual void key(std::string_view key) = 0;
  virtual void end() = 0;
  // After each event: false ends the reading early.
  virtual bool wants_more() const { return true; }
};

// Reads one value, JSON or CBOR as the first byte says, and nothing behind it. Format errors hold the byte's index;
// limit errors for more than 8 objects and arrays in each other, or more than 1024 bytes between two events.
void read_events(std::span<const std::uint8_t> bytes, Events& events);

// Foreign text fit for a message: ASCII, and not long.
std::string printable(std::string_view text);

}  // namespace ifsm::core
