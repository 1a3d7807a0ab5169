#include "io/emitter.h"

#include <bit>
#include <charconv>
#include <cmath>
#include <string>

namespace ifsm::core {
namespace {

// A line for each member of the outermost object and for each object in an array; no other white space.
class JsonEmitter : public Emitter {
 public:
  explicit JsonEmitter(Bytes& bytes) : bytes_(bytes) {}

  void object(Index) override { open('{', '}'); }
  void array(Index) override { open('[', ']'); }

  void end() override {
    const char closing = closing_.back();
    closing_.pop_back();
    if (closing_.empty()) put("\n");
    put({&closing, 1});
    if (closing_.empty()) put("\n");
    first_ = false;
  }

  void key(std::string_view name) override {
    separate();
    if (closing_.size() == 1) put("\n");
    quote(name);
    put(":");
    first_ = true;  // its value follows without a comma
  }

  void text(std::string_view value) override {
    separate();
    quote(value);
  }

  void boolean(bool value) override {
    separate();
    put(value ? "true" : "false");
  }

  void integer(Index value) override { digits(value); }

  void number(double value) override {
    // "-0" would be read as the integer 0 by many.
    if (value == 0 && std::signbit(value)) {
      separate();
      return put("-0.0");
    }
    digits(value);
  }

 private:
  void open(char opening, char closing) {
    separate();
    if (opening == '{' && !closing_.empty() && closing_.back() == ']') put("\n");
    put({&opening, 1});
    closing_.push_back(closing);
    first_ = true;
  }

  void separate() {
    if (!first_) put(",");
    first_ = false;
  }

  template <class Number>
  void digits(Number value) {
    separate();
    char buffer[32];
    const auto end = std::to_chars(buffer, buffer + sizeof buffer, value);
    put({buffer, end.ptr});
  }

  void quote(std::string_view text) {
    put("\"");
    put(text);
    put("\"");
  }

  void put(std::string_view text) { bytes_.insert(bytes_.end(), text.begin(), text.end()); }

  Bytes& bytes_;
  std::string closing_;  // brackets to come
  bool first_ = true;    // nothing before the next value that a comma would part it from
};

// Preferred serialisation, but for doubles: these are never shortened.
class CborEmitter : public Emitter {
 public:
  explicit CborEmitter(Bytes& bytes) : bytes_(bytes) {}

  void object(Index members) override { head(5, static_cast<std::uint64_t>(members)); }
  void array(Index elements) override { head(4, static_cast<std::uint64_t>(elements)); }
  void end() override {}
  void key(std::string_view name) override { text(name); }

  void text(std::string_view value) override {
    head(3, value.size());
    bytes_.insert(bytes_.end(), value.begin(), value.end());
  }

  void boolean(bool value) override { put(value ? 0xf5 : 0xf4, 1); }
  void integer(Index value) override { head(0, static_cast<std::uint64_t>(value)); }

  void number(double value) override {
    put(0xfb, 1);
    put(std::bit_cast<std::uint64_t>(value), 8);
  }

 private:
  // Major type and argument in as few bytes as they need: RFC 8949, section 3.
  void head(unsigned major, std::uint64_t argument) {
    const unsigned type = major << 5;
    if (argument < 24) return put(type | argument, 1);
    unsigned width = 1, code = 24;
    while (width < 8 && argument >> (8 * width) != 0) width *= 2, ++code;
    put(type | code, 1);
    put(argument, width);
  }

  void put(std::uint64_t value, unsigned width) {  // big-endian
    for (unsigned byte = width; byte-- > 0;) bytes_.push_back(static_cast<std::uint8_t>(value >> (8 * byte)));
  }

  Bytes& bytes_;
};

}  // namespace

std::unique_ptr<Emitter> make_emitter(Format format, Bytes& bytes) {
  if (format == Format::json) return std::make_unique<JsonEmitter>(bytes);
  return std::make_unique<CborEmitter>(bytes);
}

}  // namespace ifsm::core
