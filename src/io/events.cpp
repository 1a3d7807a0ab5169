#include "io/events.h"

#include <algorithm>
#include <charconv>
#include <iterator>
#include <limits>

// Its only assertion that input can reach is on strtod's end, where a locale's decimal point has several bytes (ps_AF).
// The value is read anew below: see number_of.
#define JSON_ASSERT(condition) static_cast<void>(0)
#include <nlohmann/json.hpp>

#include "base/error.h"

namespace ifsm::core {
namespace {

using Json = nlohmann::json;

constexpr int most_depth = 8;
// The longest token of a model has 24 bytes; the rest is room for white space. It also bounds the parser's own
// recursion (CBOR texts in pieces may hold texts in pieces) and what it copies of texts.
constexpr std::size_t most_between_events = 1024;

Error wrong(Status status, std::size_t byte, const std::string& message) {
  return Error(status, "bytes", message).at(static_cast<std::int64_t>(byte));
}

struct Cursor {
  std::span<const std::uint8_t> bytes;
  std::size_t next = 0;
  std::size_t last_event = 0;

  void advance() {
    if (++next - last_event > most_between_events)
      throw wrong(Status::limit, last_event,
                  "More than " + std::to_string(most_between_events) + " bytes follow byte " +
                      std::to_string(last_event) + " without a value; no text or white space of a model is so long.");
  }
};

// What the parser reads from; every copy moves the same cursor. Without a cursor it is the end.
class ByteIterator {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = char;

  ByteIterator() = default;
  explicit ByteIterator(Cursor& cursor) : cursor_(&cursor) {}

  char operator*() const { return static_cast<char>(cursor_->bytes[cursor_->next]); }
  ByteIterator& operator++() {
    cursor_->advance();
    return *this;
  }
  friend bool operator==(const ByteIterator& a, const ByteIterator& b) { return a.left() == b.left(); }

 private:
  std::size_t left() const { return cursor_ == nullptr ? 0 : cursor_->bytes.size() - cursor_->next; }

  Cursor* cursor_ = nullptr;
};

// The parser has read the number in the process's locale; the text says it in no locale but for its decimal point.
double number_of(double parsed, std::string text) {
  const auto is_point = [](char c) { return std::string_view("0123456789+-eE").find(c) == std::string_view::npos; };
  std::replace_if(text.begin(), text.end(), is_point, '.');
  std::from_chars(text.data(), text.data() + text.size(), parsed);  // leaves it on underflow, and without a text (CBOR)
  return parsed;
}

// The shape that nlohmann's parser asks for; false ends the parsing.
class Sax {
 public:
  Sax(Cursor& cursor, Events& events) : cursor_(cursor), events_(events) {}

  bool null() { return tell(nullptr); }
  bool boolean(bool value) { return tell(value); }
  bool string(std::string& value) { return tell(std::string_view(value)); }
  bool number_float(double value, const std::string& text) { return tell(number_of(value, text)); }

  // Only called for a minus sign: JSON's -0, or a CBOR integer -1-n below -2^63 that has wrapped.
  bool number_integer(std::int64_t value) {
    if (value < 0) return tell(value);
    return tell(value == 0 && json() ? -0.0 : -1.0 - static_cast<double>(static_cast<std::uint64_t>(-1 - value)));
  }

  bool number_unsigned(std::uint64_t value) {
    if (value > std::numeric_limits<std::int64_t>::max()) return tell(static_cast<double>(value));
    return tell(static_cast<std::int64_t>(value));
  }

  bool binary(Json::binary_t&) {
    throw wrong(Status::format, cursor_.last_event, "The file holds a byte string; a model has none.");
  }

  bool start_object(std::size_t) {
    deeper();
    events_.object();
    return next();
  }

  bool start_array(std::size_t) {
    deeper();
    events_.array();
    return next();
  }

  bool key(std::string& value) {
    events_.key(value);
    return next();
  }

  bool end_object() { return end(); }
  bool end_array() { return end(); }

  bool parse_error(std::size_t position, const std::string& token, const nlohmann::detail::exception& error) {
    constexpr int overflow = 406;
    if (error.id == overflow) {  // let the reader say which entry it is
      const double infinity = std::numeric_limits<double>::infinity();
      events_.scalar(token.starts_with('-') ? -infinity : infinity);
    }
    const std::string_view what = error.what();
    const std::size_t byte = std::min(position - std::min<std::size_t>(position, 1), cursor_.bytes.size());
    throw wrong(error.id == overflow ? Status::not_finite : Status::format, byte,
                std::string("The file is not ") + (json() ? "JSON" : "CBOR") + " at byte " + std::to_string(byte) +
                    "; it may be damaged or cut short: save it anew. (" + printable(what.substr(what.find(']') + 2)) +
                    ")");
  }

 private:
  bool json() const { return cursor_.bytes[0] < 0x80 || cursor_.bytes[0] == 0xef; }

  bool tell(const Scalar& value) {
    events_.scalar(value);
    return next();
  }

  bool end() {
    --depth_;
    events_.end();
    return next();
  }

  bool next() {
    cursor_.last_event = cursor_.next;
    return events_.wants_more();
  }

  void deeper() {
    if (++depth_ > most_depth)
      throw wrong(
          Status::limit, cursor_.next - 1,
          "More than " + std::to_string(most_depth) + " objects and arrays lie in each other; a model needs four.");
  }

  Cursor& cursor_;
  Events& events_;
  int depth_ = 0;
};

// JSON starts with a brace, white space before it, or a byte order mark; CBOR with a map.
bool is_json(std::uint8_t first) {
  return std::string_view("{ \t\r\n\xef").find(static_cast<char>(first)) != std::string_view::npos;
}
bool is_cbor(std::uint8_t first) { return first >> 5 == 5; }

// The parser takes a NUL for the end of the text and would not look further.
void require_no_nul(std::span<const std::uint8_t> bytes) {
  const auto nul = std::ranges::find(bytes, std::uint8_t{0});
  if (nul == bytes.end()) return;
  const auto byte = static_cast<std::size_t>(nul - bytes.begin());
  throw wrong(Status::format, byte,
              "Byte " + std::to_string(byte) + " is NUL, which JSON text does not hold; give the count without it.");
}

}  // namespace

void read_events(std::span<const std::uint8_t> bytes, Events& events) {
  if (bytes.empty()) throw wrong(Status::format, 0, "The file is empty; give the bytes of a saved one.");
  const bool json = is_json(bytes[0]);
  if (!json && !is_cbor(bytes[0]))
    throw wrong(
        Status::format, 0,
        "The first byte is " + std::to_string(bytes[0]) +
            ", with which neither JSON nor CBOR begins as this library saves it; give the bytes of a saved file.")
        .with(bytes[0]);
  if (json) require_no_nul(bytes);
  Cursor cursor{bytes};
  Sax sax(cursor, events);
  Json::sax_parse(ByteIterator(cursor), ByteIterator(), &sax,
                  json ? nlohmann::detail::input_format_t::json : nlohmann::detail::input_format_t::cbor);
}

std::string printable(std::string_view text) {
  constexpr std::size_t most = 160;
  std::string result(text.substr(0, most));
  std::replace_if(
      result.begin(), result.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return text.size() > most ? result + "..." : result;
}

}  // namespace ifsm::core
