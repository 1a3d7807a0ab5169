// Values written one after the other, as JSON or as CBOR (RFC 8949): no tree of values is built in memory.
#pragma once

#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "io/format.h"

namespace ifsm::core {

using Bytes = std::vector<std::uint8_t>;

// Objects and arrays tell their size first and are closed by end(). Doubles keep their bits: shortest decimals in JSON,
// binary64 in CBOR; they must be finite.
class Emitter {
 public:
  virtual ~Emitter() = default;
  virtual void object(Index members) = 0;
  virtual void array(Index elements) = 0;
  virtual void end() = 0;
  virtual void key(std::string_view name) = 0;
  virtual void text(std::string_view value) = 0;
  virtual void boolean(bool value) = 0;
  virtual void integer(Index value) = 0;  // not negative
  virtual void number(double value) = 0;
};

// Appends to `bytes`, which must outlive it. Names and texts are plain ASCII without quotes or backslashes.
std::unique_ptr<Emitter> make_emitter(Format format, Bytes& bytes);

}  // namespace ifsm::core
