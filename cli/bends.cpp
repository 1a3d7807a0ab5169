#include "bends.h"

#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "failure.h"
#include "files.h"
#include "models.h"

namespace cli {
namespace {

const std::string random_texture = "random";

// What a value may not say; bend() puts the option and the value before it.
struct Unclear {
  std::string says;
};

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts{""};
  for (const char c : text)
    if (c == at)
      parts.emplace_back();
    else
      parts.back() += c;
  return parts;
}

// The text before the last `at`, and what follows it: nothing when there is none.
struct Parted {
  std::string first, rest;
  bool parted = false;
};

Parted parted(const std::string& text, char at) {
  const auto found = text.rfind(at);
  if (found == std::string::npos) return {text, "", false};
  return {text.substr(0, found), text.substr(found + 1), true};
}

template <class Number>
Number number(const std::string& text, const char* what) {
  Number value{};
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  if (error == std::errc() && rest == end && std::isfinite(static_cast<double>(value))) return value;
  throw Unclear{"'" + text + "' is not " + what + "."};
}

double real(const std::string& text) { return number<double>(text, "a number"); }
int level_of(const std::string& text) { return number<int>(text, "a level's number"); }
int detail_level(const std::string& text) {
  return number<int>(text, "a level of details, or levels: 3, 2-5, first2, last2, and ~1 after them");
}

struct Way {
  bool to = false;  // a place; else by so much
  std::vector<double> vector;
};

Way way_of(const std::string& text, int dimension) {
  if (text.empty() || (text[0] != '+' && text[0] != '='))
    throw Unclear{"'" + text +
                  "' is no way: begin it with + for by so much (+-10,4 to the left), or with = for to a place."};
  Way way{text[0] == '=', {}};
  for (const auto& part : split(text.substr(1), ',')) way.vector.push_back(real(part));
  if (static_cast<int>(way.vector.size()) != dimension)
    throw Unclear{"the curve has dimension " + std::to_string(dimension) + ", and '" + text + "' has " +
                  std::to_string(way.vector.size()) + " coordinates."};
  return way;
}

// "TARGET:WAY"
struct Aimed {
  std::string target;
  Way way;
};

Aimed aimed(const std::string& text, int dimension) {
  const auto found = text.find(':');
  if (found == std::string::npos) throw Unclear{"'" + text + "' has no colon between what is moved and where to."};
  return {text.substr(0, found), way_of(text.substr(found + 1), dimension)};
}

struct Handles {
  int level = 0;
  std::vector<std::int64_t> numbers;
};

Handles handles_of(const std::string& text) {
  const auto [level, numbers, parted_here] = parted(text, '/');
  Handles handles;
  if (parted_here) handles.level = level_of(level);
  for (const auto& part : split(parted_here ? numbers : level, ','))
    handles.numbers.push_back(number<std::int64_t>(part, "a handle's number"));
  return handles;
}

ifsm::MoveOptions how_of(const std::string& text) {
  ifsm::MoveOptions how;
  bool falls = false, by_length = false;
  for (const auto& word : split(text, ',')) {
    const auto at = word.find('=');
    const std::string name = word.substr(0, at);
    if (name == "length" && at == std::string::npos) {
      how.ruler = ifsm::Ruler::length;
      by_length = true;
    } else if (name == "curve" && at == std::string::npos) {
      how.reach = ifsm::Reach::curve;
    } else if ((name == "smooth" || name == "linear") && at != std::string::npos) {
      if (std::exchange(falls, true)) throw Unclear{"smooth and linear do not go together, nor one of them twice."};
      how.falloff = name == "smooth" ? ifsm::Falloff::smooth : ifsm::Falloff::linear;
      how.radius = real(word.substr(at + 1));
    } else {
      throw Unclear{"'" + word + "' is none of smooth=RADIUS, linear=RADIUS, length, curve."};
    }
  }
  if (by_length && !falls) throw Unclear{"length says what RADIUS is of smooth=RADIUS or linear=RADIUS; add one."};
  return how;
}

std::vector<Mark> marks_of(const Handles& handles, bool held) {
  std::vector<Mark> marks;
  for (const auto handle : handles.numbers) marks.push_back({handles.level, handle, 0, held});
  return marks;
}

std::vector<Mark> move(ifsm::Deformer& deformer, const std::string& value) {
  const auto [what, how, told] = parted(value, '@');
  const auto [target, way] = aimed(what, deformer.describe().dimension);
  const Handles handles = handles_of(target);
  ifsm::MoveOptions options = told ? how_of(how) : ifsm::MoveOptions{};
  options.places = way.to;
  std::vector<double> vectors;
  for (std::size_t k = 0; k < handles.numbers.size(); ++k)
    vectors.insert(vectors.end(), way.vector.begin(), way.vector.end());
  deformer.move(handles.level, handles.numbers, vectors, options);
  return marks_of(handles, false);
}

std::vector<Mark> move_at(ifsm::Deformer& deformer, const std::string& value) {
  const auto [what, level, told] = parted(value, '@');
  const std::string details = "details=";
  const bool by_details = level.starts_with(details);
  const int dimension = deformer.describe().dimension;
  std::vector<double> parameters, places;
  std::vector<Way> ways;
  for (const auto& point : split(what, ';')) {
    const auto [target, way] = aimed(point, dimension);
    parameters.push_back(real(target));
    ways.push_back(way);
  }
  places = deformer.evaluate(parameters);
  std::vector<Mark> marks;
  auto place = places.begin();
  for (std::size_t k = 0; k < ways.size(); ++k) {
    bool held = !ways[k].to;
    for (const double coordinate : ways[k].vector) {
      held = held && coordinate == 0;
      *place = ways[k].to ? coordinate : *place + coordinate;
      ++place;
    }
    marks.push_back({-1, 0, parameters[k], held});
  }
  deformer.drag(told ? level_of(by_details ? level.substr(details.size()) : level) : 0, parameters, places,
                by_details ? ifsm::Lead::details : ifsm::Lead::handles);
  return marks;
}

std::vector<Mark> pin(ifsm::Deformer& deformer, const std::string& value) {
  const Handles handles = handles_of(value);
  deformer.pin(handles.level, handles.numbers);
  return marks_of(handles, true);
}

std::vector<Mark> unpin(ifsm::Deformer& deformer, const std::string& value) {
  const Handles handles = handles_of(value);
  deformer.pin(handles.level, handles.numbers, false);
  return {};
}

struct Levels {
  int first = 0, last = 0, fade = 0;
};

// All of them, when nothing is said.
Levels levels_of(const ifsm::Deformer& deformer, const Parted& said) {
  const int all = deformer.describe().levels;
  if (!said.parted) return {0, all - 1, 0};
  const auto [range, fade, fades] = parted(said.rest, '~');
  Levels levels;
  if (fades) levels.fade = number<int>(fade, "a number of levels");
  const auto named = [&](const std::string& word) -> std::optional<int> {
    if (!range.starts_with(word)) return std::nullopt;
    const int count = number<int>(range.substr(word.size()), "a number of levels");
    if (count >= 1 && count <= all) return count;
    throw Unclear{"'" + range + "': the model has " + std::to_string(all) + " levels of details; give 1 to " +
                  std::to_string(all) + "."};
  };
  if (const auto count = named("first"))
    levels.last = *count - 1;
  else if (const auto last = named("last"))
    levels.first = all - *last, levels.last = all - 1;
  else if (const auto dash = range.find('-'); dash != std::string::npos)
    levels.first = detail_level(range.substr(0, dash)), levels.last = detail_level(range.substr(dash + 1));
  else
    levels.first = levels.last = detail_level(range);
  return levels;
}

void restyle(ifsm::Deformer& deformer, const Levels& levels, double scale, ifsm::RestyleOptions options) {
  options.fade = levels.fade;
  deformer.restyle(levels.first, levels.last, scale, options);
}

std::vector<Mark> scale_details(ifsm::Deformer& deformer, const std::string& value) {
  const Parted said = parted(value, '@');
  restyle(deformer, levels_of(deformer, said), real(said.first), {});
  return {};
}

std::vector<Mark> turn_details(ifsm::Deformer& deformer, const std::string& value) {
  const Parted said = parted(value, '@');
  ifsm::RestyleOptions options;
  options.angle = real(said.first) * std::numbers::pi / 180;
  restyle(deformer, levels_of(deformer, said), 1, options);
  return {};
}

std::vector<Mark> mirror_details(ifsm::Deformer& deformer, const std::string& value) {
  const Parted said = parted(value, '@');
  const std::string axes = "xyzw";
  const auto axis = said.first.size() == 1 ? axes.find(said.first[0]) : std::string::npos;
  if (axis == std::string::npos || static_cast<int>(axis) >= deformer.describe().dimension)
    throw Unclear{"'" + said.first + "' is no axis of the curve; give one of the first " +
                  std::to_string(deformer.describe().dimension) + " of x, y, z, w."};
  ifsm::RestyleOptions options;
  options.mirror = static_cast<int>(axis) + 1;
  restyle(deformer, levels_of(deformer, said), 1, options);
  return {};
}

std::vector<Mark> texture(ifsm::Deformer& deformer, const std::string& value) {
  const Parted said = parted(value, '@');
  const Levels levels = levels_of(deformer, said);
  ifsm::TextureOptions options;
  options.fade = levels.fade;
  ifsm::Model from;
  if (said.first == random_texture || said.first.starts_with(random_texture + "=")) {
    if (said.first != random_texture) {
      const auto numbers = split(said.first.substr(random_texture.size() + 1), ',');
      const double roughness = real(numbers[0]);
      options.roughness = roughness == 0 ? std::numeric_limits<double>::min() : roughness;  // 0 would be the default
      if (numbers.size() > 1) options.seed = number<std::uint64_t>(numbers[1], "a seed, a whole number");
      if (numbers.size() > 2) throw Unclear{"random takes a roughness and a seed: random=0.7,42."};
    }
  } else {
    from = load_model(said.first);
    options.from = &from;
  }
  deformer.texture(levels.first, levels.last, options);
  return {};
}

std::vector<Mark> during(ifsm::Deformer& deformer, const std::string& value) {
  const std::map<std::string, ifsm::Easing> easings{{"smooth", ifsm::Easing::smooth},
                                                    {"linear", ifsm::Easing::linear},
                                                    {"in", ifsm::Easing::in},
                                                    {"out", ifsm::Easing::out}};
  const auto parts = split(value, ',');
  if (parts.size() < 2 || parts.size() > 3)
    throw Unclear{"give a begin and an end, and an easing if you like: 0,2,smooth."};
  if (parts.size() == 3 && easings.count(parts[2]) == 0)
    throw Unclear{"'" + parts[2] + "' is none of smooth, linear, in, out."};
  deformer.time(real(parts[0]), real(parts[1]), parts.size() == 3 ? easings.at(parts[2]) : ifsm::Easing::smooth);
  return {};
}

std::vector<Mark> edits(ifsm::Deformer& deformer, const std::string& value) {
  const auto bytes = read_file(value);
  try {
    deformer.replay({bytes.begin(), bytes.end()});
  } catch (const ifsm::Error& error) {
    throw Failure(Exit::Input, input_name(value) + ": " + error.what());
  }
  return {};
}

}  // namespace

std::vector<Mark> bend(ifsm::Deformer& deformer, const std::string& option, const std::string& value) {
  using Make = std::vector<Mark> (*)(ifsm::Deformer&, const std::string&);
  static const std::map<std::string, Make> edits_by_name{{"move", move},
                                                         {"move-at", move_at},
                                                         {"pin", pin},
                                                         {"unpin", unpin},
                                                         {"scale-details", scale_details},
                                                         {"turn-details", turn_details},
                                                         {"mirror-details", mirror_details},
                                                         {"texture", texture},
                                                         {"during", during},
                                                         {"edits", edits}};
  const std::string told = "--" + option + " " + value + ": ";
  try {
    if (value.empty()) throw Unclear{"is empty; `ifsm deform --help` tells what it says."};
    return edits_by_name.at(option)(deformer, value);
  } catch (const Unclear& unclear) {
    throw Failure(Exit::Usage, told + unclear.says);
  } catch (const ifsm::Error& error) {
    if (error.status == IFSM_ERROR_MEMORY) throw;
    throw Failure(Exit::Usage, told + error.what());
  }
}

std::string file_of_bend(const std::string& option, const std::string& value) {
  if (option == "edits") return value;
  const std::string source = parted(value, '@').first;
  const bool random = source == random_texture || source.starts_with(random_texture + "=");
  return option == "texture" && !random ? source : "";
}

}  // namespace cli
