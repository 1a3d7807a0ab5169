#include "io/document.h"

#include <cmath>
#include <optional>
#include <utility>
#include <variant>

#include "io/events.h"

namespace ifsm::core {
namespace {

constexpr std::size_t most_levels = 40;  // Shape's; each level's entry is larger than the byte that can ask for it

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

  void require_known() const {
    if (!format_ || *format_ != format_name)
      throw Error(Status::format, "format",
                  "The file's \"format\" is not \"" + std::string(format_name) +
                      "\"; give a model that this library has saved.");
    if (!version_) throw Error(Status::format, "version", "The file does not tell its \"version\"; add it.");
    if (*version_ != format_version)
      throw Error(Status::version, "version",
                  "The file is of version " + std::to_string(*version_) +
                      " of the format, this library reads version " + std::to_string(format_version) +
                      "; use a newer library, or save the model for this one.")
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

// Where a value goes, and by its type what it must be.
using Slot = std::variant<bool*, Index*, double*, std::string*, std::vector<double>*, std::vector<Index>*, FilterEntry*,
                          std::vector<LevelEntry>*>;

const char* expected(const Slot& slot) {
  constexpr const char* names[] = {"true or false",       "an integer",           "a number",  "a text",
                                   "an array of numbers", "an array of integers", "an object", "an array of objects"};
  return names[slot.index()];
}

const char* expected_element(const Slot& slot) {
  if (std::holds_alternative<std::vector<double>*>(slot)) return "a number";
  return std::holds_alternative<std::vector<Index>*>(slot) ? "an integer" : "an object";
}

struct Member {
  std::string_view key;
  Slot slot;
  bool required = true;
  bool seen = false;
};

using Members = std::vector<Member>;

Members members_of(Document& d) {
  return {{"format", &d.format},
          {"version", &d.version},
          {"dimension", &d.dimension},
          {"closed", &d.closed},
          {"samples", &d.samples},
          {"levels", &d.levels},
          {"filter", &d.filter},
          {"center", &d.center},
          {"diagonal", &d.diagonal},
          {"largest_polygon", &d.largest_polygon},
          {"control_points", &d.control_points},
          {"details", &d.details}};
}

Members members_of(FilterEntry& f) {
  return {{"topology", &f.topology},
          {"control_points", &f.control_points},
          {"maps", &f.maps},
          {"stride", &f.stride},
          {"matrix", &f.matrix}};
}

Members members_of(LevelEntry& l) {
  return {{"dense", &l.dense, false}, {"at", &l.at, false}, {"vectors", &l.vectors, false}};
}

// Sends every value where its key says. The file is an object: the header was found in it.
class DocumentReader : public Events {
 public:
  explicit DocumentReader(Document& document) : document_(document) {}

  void scalar(const Scalar& value) override {
    Frame& top = stack_.back();
    if (top.array)
      std::visit([&](auto* slot) { append(*slot, value); }, top.slot), ++top.count;
    else
      std::visit([&](auto* slot) { store(*slot, value); }, top.slot);
  }

  void object() override {
    if (stack_.empty()) return open(members_of(document_));
    Frame& top = stack_.back();
    if (auto* levels = std::get_if<std::vector<LevelEntry>*>(&top.slot); levels != nullptr && top.array) {
      if ((*levels)->size() == most_levels) throw error(Status::limit, "is one level too many; a tree has at most 40.");
      return open(members_of((*levels)->emplace_back()));
    }
    auto* filter = std::get_if<FilterEntry*>(&top.slot);
    if (filter == nullptr) throw wrong_type();
    open(members_of(**filter));
  }

  void array() override {
    if (stack_.back().array) throw wrong_type();
    const Slot slot = stack_.back().slot;
    if (!std::visit([](auto* to) { return is_array(*to); }, slot)) throw wrong_type();
    stack_.push_back({{}, {}, slot, true, 0});
  }

  void key(std::string_view key) override {
    Frame& top = stack_.back();
    top.key = printable(key);
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

  template <class T>
  static constexpr bool is_array(const std::vector<T>&) {
    return true;
  }
  template <class T>
  static constexpr bool is_array(const T&) {
    return false;
  }

  void store(bool& to, const Scalar& value) { to = taken<bool>(value); }
  void store(Index& to, const Scalar& value) { to = taken<std::int64_t>(value); }
  void store(double& to, const Scalar& value) { to = number(value); }
  void store(std::string& to, const Scalar& value) { to = taken<std::string_view>(value); }
  template <class T>
  void store(T&, const Scalar&) {
    throw wrong_type();
  }

  void append(std::vector<double>& to, const Scalar& value) { to.push_back(number(value)); }
  void append(std::vector<Index>& to, const Scalar& value) { to.push_back(taken<std::int64_t>(value)); }
  template <class T>
  void append(T&, const Scalar&) {
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
    throw error(Status::not_finite, "is " + text_of(number) + "; every number of a model is finite.").with(number);
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

  Document& document_;
  std::vector<Frame> stack_;
};

}  // namespace

Document read_document(std::span<const std::uint8_t> bytes) {
  HeaderReader header;
  read_events(bytes, header);
  header.require_known();
  Document document;
  DocumentReader reader(document);
  read_events(bytes, reader);
  return document;
}

}  // namespace ifsm::core
