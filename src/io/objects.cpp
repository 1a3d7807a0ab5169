#include "io/objects.h"

#include <cmath>
#include <optional>
#include <utility>

#include "base/error.h"
#include "io/events.h"

namespace ifsm::core {
namespace {

// Looks for "format" and "version" alone: a file of a newer version is refused as that, whatever else it holds.
class HeaderReader : public Events {
 public:
  void scalar(const Scalar& value) override {
    if (depth_ != 1) return;
    if (key_ == "format") format_ = text_of_entry(value);
    if (key_ == "version") version_ = integer_of_entry(value);
  }

  void object() override { ++depth_; }
  void array() override { ++depth_; }
  void end() override { --depth_; }
  void key(std::string_view key) override {
    if (depth_ == 1) key_ = key;
  }
  bool wants_more() const override { return !(format_ && version_); }

  void require(const FileKind& kind) const {
    if (!format_ || *format_ != kind.format)
      throw Error(Status::format, "format",
                  "The file's \"format\" is not \"" + std::string(kind.format) + "\"; give a file of " + kind.what +
                      " that this library has saved.");
    if (!version_) throw Error(Status::format, "version", "The file does not tell its \"version\"; add it.");
    if (*version_ != kind.version)
      throw Error(Status::version, "version",
                  "The file is of version " + std::to_string(*version_) +
                      " of the format, this library reads version " + std::to_string(kind.version) +
                      "; use a newer library, or save it for this one.")
          .with(static_cast<double>(*version_));
  }

 private:
  static std::string text_of_entry(const Scalar& value) {
    const auto* text = std::get_if<std::string_view>(&value);
    return text != nullptr ? std::string(*text) : std::string();
  }

  static std::int64_t integer_of_entry(const Scalar& value) {
    if (const auto* integer = std::get_if<std::int64_t>(&value)) return *integer;
    throw Error(Status::format, "version", "version is not an integer.");
  }

  int depth_ = 0;
  std::string key_;
  std::optional<std::string> format_;
  std::optional<std::int64_t> version_;
};

const char* expected(const Slot& slot) {
  constexpr const char* names[] = {"true or false",       "an integer",           "a number",  "a text",
                                   "an array of numbers", "an array of integers", "an object", "an array of objects"};
  return names[slot.index()];
}

const char* expected_element(const Slot& slot) {
  if (std::holds_alternative<std::vector<double>*>(slot)) return "a number";
  return std::holds_alternative<std::vector<Index>*>(slot) ? "an integer" : "an object";
}

// Sends every value where its key says. The file is an object: the header was found in it.
class ObjectReader : public Events {
 public:
  explicit ObjectReader(const Members& members) : members_(members) {}

  void scalar(const Scalar& value) override {
    Frame& top = stack_.back();
    if (top.array)
      append(top.slot, value), ++top.count;
    else
      store(top.slot, value);
  }

  void object() override {
    if (stack_.empty()) return open(members_);
    const Frame& top = stack_.back();
    if (const auto* objects = std::get_if<Objects>(&top.slot); objects != nullptr && top.array) {
      if (static_cast<std::size_t>(top.count) == objects->most) throw error(Status::limit, objects->too_many);
      return open(objects->begin());
    }
    const auto* object = std::get_if<Object>(&top.slot);
    if (object == nullptr) throw wrong_type();
    open(object->begin());
  }

  void array() override {
    if (stack_.back().array) throw wrong_type();
    const Slot slot = stack_.back().slot;
    if (!holds_array(slot)) throw wrong_type();
    stack_.push_back({{}, {}, slot, true, 0});
  }

  void key(std::string_view key) override {
    Frame& top = stack_.back();
    top.key = key.empty() ? "\"\"" : printable(key);
    for (Member& member : top.members)
      if (member.key == key) return enter(top, member);
    throw error(Status::format, "is not a key of version 1 of the format; remove it.");
  }

  void end() override {
    Frame& top = stack_.back();
    for (const Member& member : top.members)
      if (member.required && !member.seen) {
        top.key = member.key;
        throw error(Status::format, "is missing; add it.");
      }
    stack_.pop_back();
    if (!stack_.empty() && stack_.back().array) ++stack_.back().count;
  }

 private:
  struct Frame {
    Members members;  // of an object
    std::string key;  // its key that is read now
    Slot slot;        // of that key; an array's own
    bool array = false;
    Index count = 0;  // elements that an array has had
  };

  void open(Members members) { stack_.push_back({std::move(members), {}, {}, false, 0}); }

  void enter(Frame& top, Member& member) {
    if (std::exchange(member.seen, true)) throw error(Status::format, "is there twice; remove one.");
    top.slot = member.slot;
  }

  static bool holds_array(const Slot& slot) {
    return std::holds_alternative<std::vector<double>*>(slot) || std::holds_alternative<std::vector<Index>*>(slot) ||
           std::holds_alternative<Objects>(slot);
  }

  void store(const Slot& slot, const Scalar& value) const {
    if (auto* const* flag = std::get_if<bool*>(&slot))
      **flag = taken<bool>(value);
    else if (auto* const* integer = std::get_if<Index*>(&slot))
      **integer = taken<std::int64_t>(value);
    else if (auto* const* real = std::get_if<double*>(&slot))
      **real = number(value);
    else if (auto* const* text = std::get_if<std::string*>(&slot))
      **text = taken<std::string_view>(value);
    else
      throw wrong_type();
  }

  void append(const Slot& slot, const Scalar& value) const {
    if (auto* const* numbers = std::get_if<std::vector<double>*>(&slot))
      (*numbers)->push_back(number(value));
    else if (auto* const* integers = std::get_if<std::vector<Index>*>(&slot))
      (*integers)->push_back(taken<std::int64_t>(value));
    else
      throw wrong_type();
  }

  template <class T>
  T taken(const Scalar& value) const {
    if (const T* of_type = std::get_if<T>(&value)) return *of_type;
    throw wrong_type();
  }

  double number(const Scalar& value) const {
    if (const auto* integer = std::get_if<std::int64_t>(&value)) return static_cast<double>(*integer);
    const auto number = taken<double>(value);
    if (std::isfinite(number)) return number;
    throw error(Status::not_finite, "is " + text_of(number) + "; every number of a file is finite.").with(number);
  }

  Error wrong_type() const {
    const Frame& top = stack_.back();
    return error(Status::format,
                 std::string("must be ") + (top.array ? expected_element(top.slot) : expected(top.slot)) + ".");
  }

  // A sentence about the entry that is read now.
  Error error(Status status, const std::string& says) const {
    const Frame& top = stack_.back();
    return Error(status, path(), path() + " " + says).at(top.array ? top.count : -1);
  }

  std::string path() const {
    std::string path;
    for (const Frame& frame : stack_)
      if (frame.array)
        path += "[" + std::to_string(frame.count) + "]";
      else
        path += (path.empty() ? "" : ".") + frame.key;
    return path;
  }

  const Members& members_;
  std::vector<Frame> stack_;
};

}  // namespace

void read_object(std::span<const std::uint8_t> bytes, const FileKind& kind, const Members& members) {
  HeaderReader header;
  read_events(bytes, header);
  header.require(kind);
  ObjectReader reader(members);
  read_events(bytes, reader);
}

}  // namespace ifsm::core
