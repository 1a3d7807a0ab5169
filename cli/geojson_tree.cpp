#include "geojson_tree.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <set>

#include <nlohmann/json.hpp>

#include "csv.h"
#include "failure.h"
#include "report.h"

namespace cli {
namespace {

constexpr std::size_t most_depth =
    64;  // of objects and arrays in each other; a GeometryCollection of polygons needs 10
constexpr int most_coordinate_depth = 4;
constexpr double none = std::numeric_limits<double>::quiet_NaN();

// What the parser reads from; every copy moves the same position. Without one it is the end.
struct Cursor {
  std::string_view text;
  std::size_t next = 0;
};

class Bytes {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = char;

  Bytes() = default;
  explicit Bytes(Cursor& cursor) : cursor_(&cursor) {}

  char operator*() const { return cursor_->text[cursor_->next]; }
  Bytes& operator++() {
    ++cursor_->next;
    return *this;
  }
  friend bool operator==(const Bytes& a, const Bytes& b) { return a.left() == b.left(); }
  friend bool operator!=(const Bytes& a, const Bytes& b) { return a.left() != b.left(); }

 private:
  std::size_t left() const { return cursor_ == nullptr ? 0 : cursor_->text.size() - cursor_->next; }

  Cursor* cursor_ = nullptr;
};

// One object or array that is being read.
struct Frame {
  enum class Kind { Object, List, Coordinates, Properties, Other };
  Kind kind;
  GeoObject* object = nullptr;  // that it belongs to
  std::string key = {};         // of an object: the member that comes
  std::size_t index = 0;        // of an array: the element that comes
  bool is_array = false;
  std::set<std::string> seen = {};    // of an Object: its members
  std::vector<double> position = {};  // of Coordinates: numbers
  bool holds_arrays = false;          // of Coordinates
  GeoPositions line = {};             // of Coordinates: the positions that lie in it
};

// A member's value that is not an array or an object.
struct Scalar {
  enum class Kind { Null, Boolean, Number, Text };
  Kind kind;
  std::string text;  // as a message or a name shows it
  double number = none;
};

// The shape that nlohmann's parser asks for.
class TreeBuilder {
 public:
  using Kind = Frame::Kind;

  TreeBuilder(Cursor& cursor, const std::string& source) : cursor_(cursor), source_(source) {}

  GeoObject result() && { return std::move(root_); }

  bool null() { return take({Scalar::Kind::Null, "null"}); }
  bool boolean(bool value) { return take({Scalar::Kind::Boolean, value ? "true" : "false"}); }
  bool number_integer(std::int64_t value) { return number(static_cast<double>(value), std::to_string(value)); }
  bool number_unsigned(std::uint64_t value) { return number(static_cast<double>(value), std::to_string(value)); }
  bool number_float(double value, const std::string&) { return number(value, shortest(value)); }
  bool string(std::string& value) { return take({Scalar::Kind::Text, value}); }
  bool binary(nlohmann::json::binary_t&) { return false; }

  bool key(std::string& name) {
    auto& frame = frames_.back();
    frame.key = name;
    if (frame.kind == Kind::Object && !frame.seen.insert(name).second && is_known(name))
      fail(path(), "is there twice; keep one of them");
    return true;
  }

  bool start_object(std::size_t) {
    if (frames_.empty()) {
      root_.place = here();
      return open({Kind::Object, &root_});
    }
    const auto& frame = frames_.back();
    if (frame.kind == Kind::Coordinates) fail(path(), "is an object; coordinates are arrays of numbers");
    if (frame.kind == Kind::List) return open_member(*frame.object);
    if (frame.kind != Kind::Object) return open({Kind::Other});
    if (frame.key == "geometry") return open_member(*frame.object);
    if (frame.key == "properties") return open({Kind::Properties, frame.object});
    if (is_list(frame.key) || frame.key == "coordinates") fail(path(), "is an object; it must be an array");
    return open({Kind::Other});
  }

  bool end_object() { return close(); }

  bool start_array(std::size_t) {
    if (frames_.empty()) fail("", "is a JSON array; GeoJSON is an object with a type, e.g. a FeatureCollection");
    auto& frame = frames_.back();
    if (frame.kind == Kind::List || (frame.kind == Kind::Object && frame.key == "geometry"))
      fail(path(), "is an array; it must be an object with a type");
    if (frame.kind == Kind::Coordinates) {
      if (!frame.position.empty()) fail(path(), "is an array beside numbers; a position holds numbers alone");
      frame.holds_arrays = true;
      return open_array({Kind::Coordinates, frame.object});
    }
    if (frame.kind == Kind::Object && frame.key == "coordinates") {
      frame.object->has_coordinates = true;
      return open_array({Kind::Coordinates, frame.object});
    }
    if (frame.kind == Kind::Object && is_list(frame.key)) {
      frame.object->has_members = true;
      return open_array({Kind::List, frame.object});
    }
    return open_array({Kind::Other});
  }

  bool end_array() {
    if (frames_.back().kind == Kind::Coordinates) finish_coordinates(frames_.back());
    return close();
  }

  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception& error) {
    // "[json.exception.parse_error.101] parse error at line 3, column 5: …", or without a place.
    std::string what = error.what();
    what.erase(0, what.find(']') + 2);
    if (what.rfind("number overflow", 0) == 0)
      fail(path(), "is beyond the range of double precision (" + printable(what) + "); use another unit");
    if (what.rfind("parse error at ", 0) == 0) what.erase(0, std::string_view("parse error at ").size());
    std::replace_if(
        what.begin(), what.end(), [](char c) { return c >= 0 && c < ' '; }, '?');
    throw Failure(Exit::Input, source_ + ", " + what +
                                   "; the text is no JSON from there on: cut short, or edited by hand? (NaN does not "
                                   "exist in JSON, and a file holds one GeoJSON object.)");
  }

 private:
  static bool is_list(const std::string& key) { return key == "features" || key == "geometries"; }
  static bool is_known(const std::string& key) {
    return is_list(key) || key == "type" || key == "geometry" || key == "coordinates" || key == "properties";
  }

  [[noreturn]] void fail(const std::string& member, const std::string& what) const {
    throw Failure(Exit::Input, source_ + ", line " + std::to_string(line()) + (member.empty() ? "" : ", ") + member +
                                   ": " + what + ".");
  }

  // The parser may have looked one byte ahead.
  std::size_t line() const {
    const auto read = cursor_.text.begin() + static_cast<std::ptrdiff_t>(std::max<std::size_t>(cursor_.next, 1) - 1);
    return 1 + static_cast<std::size_t>(std::count(cursor_.text.begin(), read, '\n'));
  }

  // Of what comes next.
  std::string path() const {
    std::string text;
    for (const auto& frame : frames_) {
      if (frame.is_array)
        text += "[" + std::to_string(frame.index) + "]";
      else
        text += (text.empty() ? "" : ".") + printable(frame.key);
    }
    return text;
  }

  GeoPlace here() { return {path(), line_so_far()}; }

  // The same as line(), counted once over the whole text.
  std::size_t line_so_far() {
    const auto from = cursor_.text.begin() + static_cast<std::ptrdiff_t>(counted_to_);
    const auto to = cursor_.text.begin() + static_cast<std::ptrdiff_t>(cursor_.next);
    lines_ += static_cast<std::size_t>(std::count(from, to, '\n'));
    counted_to_ = cursor_.next;
    return lines_;
  }

  bool open(Frame frame) {
    if (frames_.size() == most_depth)
      fail(path(), "lies in " + std::to_string(most_depth) + " objects and arrays; so deep nothing of GeoJSON lies");
    frames_.push_back(std::move(frame));
    return true;
  }

  bool open_array(Frame frame) {
    if (frame.kind == Kind::Coordinates) frame.line.place = here();
    frame.is_array = true;
    return open(std::move(frame));
  }

  bool open_member(GeoObject& owner) {
    owner.has_members = true;
    owner.members.push_back({});
    owner.members.back().place = here();
    return open({Kind::Object, &owner.members.back()});
  }

  bool close() {
    frames_.pop_back();
    count_element();
    return true;
  }

  void count_element() {
    if (!frames_.empty() && frames_.back().is_array) ++frames_.back().index;
  }

  bool number(double value, const std::string& text) { return take({Scalar::Kind::Number, text, value}); }

  bool take(const Scalar& value) {
    if (frames_.empty()) fail("", "holds " + value.text + " alone; GeoJSON is an object with a type");
    auto& frame = frames_.back();
    switch (frame.kind) {
      case Kind::Coordinates: take_coordinate(frame, value); break;
      case Kind::List: fail(path(), "is " + shown(value) + "; it must be an object with a type");
      case Kind::Object: take_member(*frame.object, frame.key, value); break;
      case Kind::Properties: take_property(*frame.object, frame.key, value); break;
      case Kind::Other: break;
    }
    count_element();
    return true;
  }

  static std::string shown(const Scalar& value) {
    return value.kind == Scalar::Kind::Text ? "\"" + printable(value.text) + "\"" : value.text;
  }

  void take_member(GeoObject& object, const std::string& key, const Scalar& value) {
    const bool text = value.kind == Scalar::Kind::Text;
    if (key == "type") {
      if (!text) fail(path(), "is " + shown(value) + "; it must be text, e.g. \"LineString\"");
      object.type = value.text;
    } else if (key == "geometry" && value.kind == Scalar::Kind::Null) {
      object.has_members = true;
      object.members.push_back({});
      object.members.back().place = here();
      object.members.back().null = true;
    } else if (key == "geometry" || is_list(key) || key == "coordinates") {
      fail(path(), "is " + shown(value) + "; it must be " + (key == "geometry" ? "an object or null" : "an array"));
    } else if (key == "id" && object.name.empty() && is_name(value)) {
      object.name = value.text;
    } else if (key == "format" && text) {
      object.format = value.text;
    }
  }

  static bool is_name(const Scalar& value) {
    return value.kind == Scalar::Kind::Number || (value.kind == Scalar::Kind::Text && !value.text.empty());
  }

  // A name is better than an id, and the properties' better than the Feature's: rank tells which came before.
  void take_property(GeoObject& object, const std::string& key, const Scalar& value) {
    const bool name = key == "name" || key == "NAME" || key == "Name";
    if (!is_name(value) || !(name || (key == "id" && object.name.empty()))) return;
    object.name = value.text;
  }

  void take_coordinate(Frame& frame, const Scalar& value) {
    if (value.kind != Scalar::Kind::Number)
      fail(path(), "is " + shown(value) + "; every coordinate must be a number: correct it, or take the position out");
    if (frame.holds_arrays) fail(path(), "is a number beside arrays; a position is an array of numbers");
    frame.position.push_back(value.number);
  }

  void finish_coordinates(Frame& frame) {
    auto& object = *frame.object;
    const auto around =
        std::count_if(frames_.begin(), frames_.end(), [&](const Frame& f) { return f.kind == Kind::Coordinates; });
    if (frame.position.empty() && !frame.holds_arrays && object.empty.empty()) object.empty = frame.line.place.path;
    if (!frame.position.empty()) finish_position(frame, static_cast<int>(around));
    if (frame.line.count() > 0) object.lines.push_back(std::move(frame.line));
  }

  void finish_position(const Frame& frame, int depth) {
    auto& object = *frame.object;
    const auto& place = frame.line.place.path;
    if (depth > most_coordinate_depth) fail(place, "lies in more arrays than any coordinates do");
    if (object.depth != 0 && object.depth != depth)
      fail(place, "is a position that lies in " + std::to_string(depth - 1) + " arrays, others before it in " +
                      std::to_string(object.depth - 1) + "; a geometry nests all of its positions alike");
    object.depth = depth;
    if (frame.position.size() < 2) fail(place, "has one number; a position has at least 2, longitude and latitude");
    auto& owner = depth > 1 ? frames_[frames_.size() - 2].line : point_;
    const bool altitude = frame.position.size() > 2;
    owner.with_altitude += altitude;
    for (const double value : {frame.position[0], frame.position[1], altitude ? frame.position[2] : none})
      owner.numbers.push_back(value);
  }

  Cursor& cursor_;
  const std::string& source_;
  GeoObject root_;
  std::vector<Frame> frames_;
  GeoPositions point_;  // a Point's position, which nobody asks for
  std::size_t lines_ = 1;
  std::size_t counted_to_ = 0;
};

}  // namespace

GeoObject read_geojson(std::string_view text, const std::string& source) {
  if (text.find('\0') != text.npos)  // the parser would take it for the end
    throw Failure(Exit::Input, source + " holds a NUL byte; it is a binary file, or damaged.");
  Cursor cursor{text};
  TreeBuilder builder(cursor, source);
  nlohmann::json::sax_parse(Bytes(cursor), Bytes(), &builder);
  return std::move(builder).result();
}

}  // namespace cli
