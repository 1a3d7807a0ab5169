#include "io/flame.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <new>
#include <optional>
#include <pugixml.hpp>
#include <utility>

#include "io/flame_symmetry.h"
#include "io/flame_variations.h"
#include "io/text_lines.h"

namespace ifsm::core {
namespace {

// The tree of an XML file takes up to 16 times its bytes: 64 of a node for "<a/>".
constexpr std::size_t most_text = std::size_t{1} << 24, most_flames = 1 << 12;

std::int64_t line_at(std::string_view text, std::ptrdiff_t offset) {
  const auto before = text.substr(0, static_cast<std::size_t>(std::max<std::ptrdiff_t>(offset, 0)));
  return 1 + std::count(before.begin(), before.end(), '\n');
}

// An element, and what messages call it.
struct Place {
  std::string_view text;
  pugi::xml_node node;
  std::string name;

  std::int64_t line() const { return line_at(text, node.offset_debug()); }
  Error error(const std::string& says, Status status = Status::format) const {
    return at_line(status, line(), name + " " + says);
  }
};

struct Transform {
  Affine map;
  double weight = 0;
};

std::vector<double> numbers(const Place& place, const pugi::xml_attribute& attribute) {
  std::vector<double> values;
  std::string_view rest = attribute.value();
  const auto skip = [&rest](auto end) { rest.remove_prefix(static_cast<std::size_t>(end - rest.begin())); };
  for (skip(std::find_if_not(rest.begin(), rest.end(), is_space)); !rest.empty();) {
    const auto end = std::find_if(rest.begin(), rest.end(), is_space);
    const std::string_view word = rest.substr(0, static_cast<std::size_t>(end - rest.begin()));
    if (const Status status = read_number(word, values.emplace_back()); status != Status::ok)
      throw no_number(status, word, place.line(),
                      "the attribute " + quoted(attribute.name()) + " of " + place.name + " holds numbers.");
    skip(std::find_if_not(end, rest.end(), is_space));
  }
  return values;
}

std::vector<double> numbers(const Place& place, const pugi::xml_attribute& attribute, std::size_t count) {
  std::vector<double> values = numbers(place, attribute);
  if (values.size() == count) return values;
  throw place.error("has " + std::to_string(values.size()) + " numbers in " + quoted(attribute.name()) + "; give " +
                    std::to_string(count) + ".");
}

double number(const Place& place, const pugi::xml_attribute& attribute) { return numbers(place, attribute, 1)[0]; }

// Column by column, the translation last.
Affine affine(const Place& place, const pugi::xml_attribute& attribute) {
  const std::vector<double> c = numbers(place, attribute, 6);
  Affine map;
  map.linear.topLeftCorner<2, 2>() << c[0], c[2], c[1], c[3];
  map.shift.head<2>() << c[4], c[5];
  return map;
}

// XML forbids it, its parser does not see it, and one of the two would be lost.
void require_no_attribute_twice(const Place& place) {
  std::vector<std::string_view> names;
  for (const pugi::xml_attribute& each : place.node.attributes()) names.emplace_back(each.name());
  std::sort(names.begin(), names.end());
  if (const auto twice = std::adjacent_find(names.begin(), names.end()); twice != names.end())
    throw place.error("has the attribute " + quoted(*twice) + " twice; remove one.");
}

[[noreturn]] void refuse_variation(const Place& place, std::string_view name) {
  throw place.error("has the variation " + std::string(name) +
                    ", which is not linear: only flames whose transforms have no variation but linear are read.");
}

// How much of each variation a transform has, where none bends the plane: what its affine map is multiplied by.
class Amount {
 public:
  double value(const Place& place) const {
    if (linear_ || linear_3d_) return linear_.value_or(0) + linear_3d_.value_or(0);
    throw place.error("has no variation; give linear=\"1\" for the affine map alone.");
  }

  // Any attribute that is not another part of a transform. As flam3 does, of "var", "var1" and "linear" the last
  // counts.
  void read(const Place& place, const pugi::xml_attribute& attribute) {
    const std::string_view name = attribute.name();
    if (name == "linear") {
      linear_ = number(place, attribute);
    } else if (name == "linear3D") {  // Apophysis'; in the plane the same
      linear_3d_ = number(place, attribute);
    } else if (name == "var") {
      read_all(place, attribute);
    } else if (name == "var1") {
      read_one(place, attribute);
    } else if (is_variation(name)) {
      if (number(place, attribute) != 0) refuse_variation(place, name);
    } else if (!moves_no_point(name) && !says_zero(attribute)) {
      throw place.error("has the attribute " + quoted(name) +
                        ", which is not known here and may bend the plane; remove it if it does not.");
    }
  }

 private:
  // The old form: the amounts of all variations.
  void read_all(const Place& place, const pugi::xml_attribute& attribute) {
    const std::vector<double> amounts = numbers(place, attribute);
    for (std::size_t i = 1; i < amounts.size(); ++i)
      if (amounts[i] != 0)
        refuse_variation(place, variation_name(i).empty() ? std::to_string(i) : std::string(variation_name(i)));
    if (amounts.empty()) throw place.error("has no number in \"var\"; give one for each variation.");
    linear_ = amounts[0];
  }

  // The oldest form: the number of the only one.
  void read_one(const Place& place, const pugi::xml_attribute& attribute) {
    const double number_of_it = number(place, attribute);
    if (number_of_it != 0) refuse_variation(place, "of the number " + text_of(number_of_it));
    linear_ = 1;
  }

  static bool says_zero(const pugi::xml_attribute& attribute) {
    const std::string_view value = attribute.value();
    return !value.empty() && value.find_first_not_of("0.") == std::string_view::npos;
  }

  std::optional<double> linear_, linear_3d_;
};

void require_no_motion(const Place& place) {
  if (place.node.child("motion"))
    throw place.error("has an element <motion>, which moves it in time; remove it: a system stands still.");
}

// The attributes that transforms of both kinds have; `other` takes those that it wants of the rest.
template <class Other>
Affine geometry(const Place& place, const Other& other) {
  require_no_attribute_twice(place);
  require_no_motion(place);
  std::optional<Affine> coefs;
  Affine post = Affine::identity(2);
  Amount amount;
  for (const pugi::xml_attribute& each : place.node.attributes()) {
    const std::string_view name = each.name();
    if (name == "coefs")
      coefs = affine(place, each);
    else if (name == "post")
      post = affine(place, each);
    else if (!other(name, each))
      amount.read(place, each);
  }
  if (!coefs) throw place.error("has no \"coefs\"; give its six numbers.");
  const double scale = amount.value(place);
  return post * Affine{scale * coefs->linear, scale * coefs->shift};
}

Transform transform(const Place& place) {
  std::optional<double> weight;
  Transform result;
  result.map = geometry(place, [&](std::string_view name, const pugi::xml_attribute& each) {
    if (name == "weight") {
      weight = number(place, each);
      if (*weight < 0) throw place.error("has the weight " + text_of(*weight) + "; it cannot be negative.");
    } else if (name == "chaos") {
      const std::vector<double> ways = numbers(place, each);
      if (std::any_of(ways.begin(), ways.end(), [](double way) { return way != 1; }))
        throw place.error("has a \"chaos\" that is not all 1: which map follows another must not depend on it here.");
    } else {
      return false;
    }
    return true;
  });
  if (!weight) throw place.error("has no \"weight\"; give how often it is taken.");
  result.weight = *weight;
  return result;
}

// What moves all points when they are drawn.
Affine final_transform(const Place& place) {
  return geometry(place, [&](std::string_view name, const pugi::xml_attribute& each) {
    if (name == "weight") {
      if (number(place, each) != 0) throw place.error("has a weight, but moves every point; remove it.");
    } else if (name == "opacity") {  // flam3 leaves out so many of the points
      if (number(place, each) != 1) throw place.error("moves some points only; give it the opacity 1, or remove it.");
    } else {
      return name == "chaos";
    }
    return true;
  });
}

// F w F^-1: the attractor is what F makes of w's.
void move(std::vector<Affine>& maps, const Affine& final, const Place& place) {
  // Half of a double's digits; the result loses as many as this number has.
  constexpr double most_uneven = 0x1p26;
  if (!final.linear.allFinite() || !final.shift.allFinite())
    throw place.error("leaves what a double holds; make its numbers smaller.", Status::not_finite);
  const Vector3 stretches = singular_values(final.linear);
  if (!(stretches(0) < most_uneven * stretches(1)))
    throw place.error("makes the plane flat or nearly so, and cannot be undone; remove it.", Status::singular);
  Affine back;
  back.linear.topLeftCorner<2, 2>() = final.linear.topLeftCorner<2, 2>().inverse();
  back.shift = -(back.linear * final.shift);
  for (Affine& map : maps) map = final * map * back;
}

int kind_of(const Place& place) {
  const pugi::xml_attribute attribute = place.node.attribute("kind");
  if (!attribute) throw place.error("has no \"kind\"; give how often it repeats.");
  const double kind = number(place, attribute);
  if (kind == 0) throw place.error("has the kind 0, which flam3 chooses at random; give the one that is meant.");
  if (std::abs(kind) > System::most_maps || kind != std::round(kind))
    throw place.error("has the kind " + text_of(kind) + "; give a whole number that a system has room for.");
  return static_cast<int>(kind);
}

// The parts of a flame, as they come.
class Flame {
 public:
  explicit Flame(Place place) : place_(std::move(place)) {}

  void add(const pugi::xml_node& child) {
    const std::string_view element = child.name();
    if (element == "xform") {
      const Transform each = transform(part(child, "xform " + std::to_string(plain_.maps.size() + 1)));
      plain_.maps.push_back(each.map);
      plain_.weights.push_back(each.weight);
      require_room(plain_.maps.size());
    } else if (element == "finalxform") {
      set_once(final_, child, "the finalxform");
    } else if (element == "symmetry") {
      set_once(symmetry_, child, "the symmetry");
    }
  }

  SystemPtr system() const {
    if (plain_.maps.empty()) throw place_.error("has no <xform>; give one a map.");
    const int kind = symmetry_ ? kind_of(*symmetry_) : 1;
    require_room(plain_.maps.size() * static_cast<std::size_t>(symmetry_order(kind)));
    WeightedMaps all = kind == 1 ? plain_ : with_symmetry(plain_, kind);
    if (final_) move(all.maps, final_transform(*final_), *final_);
    return std::make_shared<System>(2, std::move(all.maps), std::move(all.weights));
  }

 private:
  Place part(const pugi::xml_node& child, const std::string& what) const {
    return {place_.text, child, what + " of " + place_.name};
  }

  void set_once(std::optional<Place>& where, const pugi::xml_node& child, const std::string& what) const {
    if (where) throw place_.error("has a second <" + std::string(child.name()) + ">; remove one.");
    where = part(child, what);
  }

  void require_room(std::size_t maps) const {
    if (maps > static_cast<std::size_t>(System::most_maps))
      throw place_.error("has " + std::to_string(maps) + " maps, its symmetry's among them; a system has at most 256.",
                         Status::limit);
  }

  Place place_;
  WeightedMaps plain_;
  std::optional<Place> final_, symmetry_;
};

SystemPtr system_of(const Place& place) {
  Flame flame(place);
  for (const pugi::xml_node& child : place.node.children()) flame.add(child);
  try {
    return flame.system();
  } catch (const Error& error) {
    if (error.argument() == "bytes") throw;
    throw place.error(std::string("is no system. ") + error.what(), error.status());
  }
}

// The next node of the tree in the file's order, without recursion: a file may be as deep as it is long.
pugi::xml_node following(pugi::xml_node node, bool enter) {
  if (enter && node.first_child()) return node.first_child();
  while (node && !node.next_sibling()) node = node.parent();
  return node.next_sibling();
}

void parse(pugi::xml_document& document, std::string_view text) {
  if (text.size() > most_text) throw at_line(Status::limit, 1, "The file has more than 16 MiB.");
  if (const std::size_t nul = text.find('\0'); nul != std::string_view::npos)
    throw at_line(Status::format, line_at(text, static_cast<std::ptrdiff_t>(nul)),
                  "The file holds a zero byte; an XML file in UTF-8 has none.");
  const pugi::xml_parse_result result =
      document.load_buffer(text.data(), text.size(), pugi::parse_minimal | pugi::parse_escapes, pugi::encoding_utf8);
  if (result.status == pugi::status_out_of_memory) throw std::bad_alloc();
  if (!result)
    throw at_line(Status::format, line_at(text, result.offset),
                  std::string("The file is no XML (") + result.description() + "); flames are XML in UTF-8.");
}

}  // namespace

std::vector<FlameSystem> read_flame(std::string_view text) {
  pugi::xml_document document;
  parse(document, text);
  std::vector<FlameSystem> all;
  for (pugi::xml_node node = document.first_child(); node;) {
    const bool is_flame = std::string_view(node.name()) == "flame";
    if (is_flame) {
      Place place{text, node, ""};
      if (all.size() == most_flames) throw at_line(Status::limit, place.line(), "The file has more than 4096 flames.");
      const pugi::xml_attribute name = node.attribute("name");
      const std::string called = name ? name.value() : std::to_string(all.size() + 1);
      place.name = "the flame " + quoted(called);
      FlameSystem& flame = all.emplace_back();
      flame.name = called;
      try {
        flame.system = system_of(place);
      } catch (const Error& error) {
        flame.refused = error;
      }
    }
    node = following(node, !is_flame);
  }
  if (all.empty()) throw at_line(Status::format, 1, "The file holds no <flame>.");
  return all;
}

}  // namespace ifsm::core
