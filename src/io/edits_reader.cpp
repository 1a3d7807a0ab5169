#include <charconv>
#include <optional>
#include <string>

#include "io/edits.h"
#include "io/edits_format.h"
#include "io/events.h"
#include "io/fingerprint.h"
#include "io/objects.h"

namespace ifsm::core {
namespace {

// As the file says it: choices by their names, points as numbers.
struct MoveEntry {
  Index level = 0;
  std::vector<Index> handles;
  std::vector<double> vectors;
  bool places = false;
  std::string reach, falloff, ruler;
  double radius = 0;
};

struct PinEntry {
  Index level = 0;
  std::vector<Index> handles;
  bool hold = true;
};

struct DragEntry {
  Index level = 0;
  std::vector<double> parameters, places;
  std::string lead;
};

struct LevelsEntry {
  Index first = 0, last = 0, fade = 0;
  double share = 1;
};

struct RestyleEntry {
  LevelsEntry levels;
  double scale = 1, angle = 0;
  Index mirror = 0;
};

struct TextureEntry {
  LevelsEntry levels;
  double roughness = 0, size = 0;
  std::string seed;
  std::vector<std::vector<double>> details;
};

struct EditEntry {
  double begin = 0, end = 1;
  std::string easing;
  std::optional<MoveEntry> move;
  std::optional<PinEntry> pin;
  std::optional<DragEntry> drag;
  std::optional<RestyleEntry> restyle;
  std::optional<TextureEntry> texture;
};

struct LogEntry {
  std::string format, model, turning, follow;
  Index version = 0;
  std::vector<EditEntry> edits;
};

Members members_of(MoveEntry& m) {
  return {{"level", &m.level}, {"handles", &m.handles}, {"vectors", &m.vectors}, {"places", &m.places},
          {"reach", &m.reach}, {"falloff", &m.falloff}, {"ruler", &m.ruler},     {"radius", &m.radius}};
}

Members members_of(PinEntry& p) { return {{"level", &p.level}, {"handles", &p.handles}, {"hold", &p.hold}}; }

Members members_of(DragEntry& d) {
  return {{"level", &d.level}, {"parameters", &d.parameters}, {"places", &d.places}, {"lead", &d.lead}};
}

Members with_levels(LevelsEntry& l, Members others) {
  others.insert(others.end(), {{"first", &l.first}, {"last", &l.last}, {"fade", &l.fade}, {"share", &l.share}});
  return others;
}

Members members_of(RestyleEntry& r) {
  return with_levels(r.levels, {{"scale", &r.scale}, {"angle", &r.angle}, {"mirror", &r.mirror}});
}

Members members_of(TextureEntry& t) {
  const auto level = [&t]() -> Members { return {{"dense", &t.details.emplace_back(), false}}; };
  return with_levels(t.levels, {{"roughness", &t.roughness},
                                {"size", &t.size},
                                {"seed", &t.seed},
                                {"details", Objects{level, most_levels, too_many_levels}}});
}

template <class Entry>
Object object(std::optional<Entry>& entry) {
  return {[&entry] { return members_of(entry.emplace()); }};
}

Members members_of(EditEntry& e) {
  return {{"begin", &e.begin},
          {"end", &e.end},
          {"easing", &e.easing},
          {"move", object(e.move), false},
          {"pin", object(e.pin), false},
          {"drag", object(e.drag), false},
          {"restyle", object(e.restyle), false},
          {"texture", object(e.texture), false}};
}

Members members_of(LogEntry& l) {
  constexpr std::size_t most_edits = 1 << 20;
  return {{"format", &l.format},
          {"version", &l.version},
          {"model", &l.model},
          {"turning", &l.turning},
          {"follow", &l.follow},
          {"edits", Objects{[&l] { return members_of(l.edits.emplace_back()); }, most_edits,
                            "is one edit too many; a log has at most 2^20."}}};
}

Error contradiction(const std::string& entry, const std::string& says) {
  return {Status::format, entry, entry + " " + says};
}

template <class Choice>
Choice choice(const std::string& name, const std::string& entry) {
  const auto& names = Names<Choice>::names;
  std::string all;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (name == names[i]) return static_cast<Choice>(i);
    all += std::string(i == 0 ? "\"" : ", \"") + names[i] + "\"";
  }
  throw contradiction(entry, "must be one of " + all + ".");
}

// The edits' own checks say more of a level that is not there; this one is for the conversion.
int small(Index value, const std::string& entry) {
  constexpr Index most = 1 << 20;
  if (value >= 0 && value <= most) return static_cast<int>(value);
  throw contradiction(entry, "is " + std::to_string(value) + "; it must be from 0 to 2^20.")
      .with(static_cast<double>(value));
}

// Entries of one edit, as the deformer takes them.
class Edits {
 public:
  Edits(const Model& model, std::string entry) : model_(model), entry_(std::move(entry)) {}

  Timed timed(const EditEntry& e) const {
    const int kinds =
        e.move.has_value() + e.pin.has_value() + e.drag.has_value() + e.restyle.has_value() + e.texture.has_value();
    if (kinds != 1)
      throw contradiction(entry_, "has " + std::to_string(kinds) +
                                      " of \"move\", \"pin\", \"drag\", \"restyle\", \"texture\"; it must have one.");
    return {e.move      ? edit(*e.move)
            : e.pin     ? edit(*e.pin)
            : e.drag    ? edit(*e.drag)
            : e.restyle ? edit(*e.restyle)
                        : edit(*e.texture),
            {e.begin, e.end, choice<Easing>(e.easing, entry_ + ".easing")}};
  }

 private:
  Edit edit(const MoveEntry& m) const {
    Move move;
    move.level = small(m.level, entry_ + ".move.level");
    move.handles = m.handles;
    move.vectors = points(m.vectors, static_cast<Index>(m.handles.size()), ".move.vectors");
    move.places = m.places;
    move.reach = choice<Reach>(m.reach, entry_ + ".move.reach");
    move.falloff = choice<Falloff>(m.falloff, entry_ + ".move.falloff");
    move.ruler = choice<Ruler>(m.ruler, entry_ + ".move.ruler");
    move.radius = m.radius;
    return move;
  }

  Edit edit(const PinEntry& p) const { return Pin{small(p.level, entry_ + ".pin.level"), p.handles, p.hold}; }

  Edit edit(const DragEntry& d) const {
    Drag drag;
    drag.level = small(d.level, entry_ + ".drag.level");
    drag.parameters = d.parameters;
    drag.places = points(d.places, static_cast<Index>(d.parameters.size()), ".drag.places");
    drag.lead = choice<Lead>(d.lead, entry_ + ".drag.lead");
    return drag;
  }

  Edit edit(const RestyleEntry& r) const {
    return Restyle{levels(r.levels, ".restyle"), r.scale, r.angle, small(r.mirror, entry_ + ".restyle.mirror") - 1};
  }

  Edit edit(const TextureEntry& t) const {
    Texture texture{levels(t.levels, ".texture"), nullptr, t.roughness, t.size, seed(t.seed)};
    if (!t.details.empty() && static_cast<int>(t.details.size()) != model_.levels())
      throw Error(Status::shape, entry_ + ".texture.details",
                  entry_ + ".texture.details has " + std::to_string(t.details.size()) + " levels; the model has " +
                      std::to_string(model_.levels()) + ".")
          .needs(model_.levels());
    for (std::size_t level = 0; level < t.details.size(); ++level) {
      const auto& dense = t.details[level];
      const std::string entry = ".texture.details[" + std::to_string(level) + "].dense";
      texture.told.push_back(dense.empty() ? nullptr
                                           : std::make_shared<Points>(points(
                                                 dense, model_.details(static_cast<int>(level)).count(), entry)));
    }
    return texture;
  }

  std::uint64_t seed(const std::string& digits) const {
    std::uint64_t value = 0;
    const char* const end = digits.data() + digits.size();
    const auto [last, error] = std::from_chars(digits.data(), end, value);
    if (error == std::errc() && last == end) return value;
    throw contradiction(entry_ + ".texture.seed", "must be the digits of a number from 0 to 2^64 - 1.");
  }

  Levels levels(const LevelsEntry& l, const std::string& kind) const {
    return {small(l.first, entry_ + kind + ".first"), small(l.last, entry_ + kind + ".last"),
            small(l.fade, entry_ + kind + ".fade"), l.share};
  }

  Points points(const std::vector<double>& numbers, Index count, const std::string& what) const {
    const Index needed = checked_product(count, model_.dimension(), "bytes");
    if (static_cast<Index>(numbers.size()) != needed)
      throw Error(Status::shape, entry_ + what,
                  entry_ + what + " has " + std::to_string(numbers.size()) + " numbers; this edit needs " +
                      std::to_string(needed) + ".")
          .with(static_cast<double>(numbers.size()))
          .needs(needed);
    return Points::from_interleaved(numbers.data(), count, model_.dimension());
  }

  const Model& model_;
  std::string entry_;
};

void require_same_manner(const LogEntry& log, const Manner& own) {
  const bool turns_alike = choice<Turning>(log.turning, "turning") == own.turning;
  const bool follows_alike = choice<Follow>(log.follow, "follow") == own.follow;
  if (turns_alike && follows_alike) return;
  throw Error(Status::range, turns_alike ? "follow" : "turning",
              "The edits were made with turning \"" + log.turning + "\" and follow \"" + log.follow +
                  "\", not with \"" + std::string(name_of(own.turning)) + "\" and \"" +
                  std::string(name_of(own.follow)) + "\" as they are to be made now; use the same.");
}

}  // namespace

std::vector<Timed> read_edits(std::span<const std::uint8_t> bytes, const Deformer& deformer) {
  LogEntry log;
  read_object(bytes, {edits_format_name, edits_format_version, "edits"}, members_of(log));
  const Model& model = deformer.model();
  if (const std::string own = fingerprint(model); log.model != own)
    throw Error(Status::shape, "model",
                "The edits were made of another model (fingerprint " + printable(log.model) + ", this one's is " + own +
                    "); make them on the model that they were made of.");
  require_same_manner(log, deformer.manner());
  std::vector<Timed> edits;
  for (std::size_t i = 0; i < log.edits.size(); ++i)
    edits.push_back(Edits(model, "edits[" + std::to_string(i) + "]").timed(log.edits[i]));
  return edits;
}

}  // namespace ifsm::core
