#include <string>

#include "deform/dressing.h"
#include "io/edits.h"
#include "io/edits_format.h"
#include "io/fingerprint.h"

namespace ifsm::core {
namespace {

class EditsWriter {
 public:
  EditsWriter(const Deformer& deformer, Emitter& out) : deformer_(deformer), out_(out) {}

  void write() {
    const std::vector<Timed> log = deformer_.log();
    out_.object(6);
    text("format", edits_format_name);
    integer("version", edits_format_version);
    text("model", fingerprint(deformer_.model()));
    text("turning", name_of(deformer_.manner().turning));
    text("follow", name_of(deformer_.manner().follow));
    out_.key("edits"), out_.array(static_cast<Index>(log.size()));
    for (const Timed& edit : log) write(edit);
    out_.end();
    out_.end();
  }

 private:
  void write(const Timed& timed) {
    out_.object(4);
    number("begin", timed.span.begin);
    number("end", timed.span.end);
    text("easing", name_of(timed.span.easing));
    std::visit([&](const auto& edit) { write(edit); }, timed.edit);
    out_.end();
  }

  void write(const Move& move) {
    out_.key("move"), out_.object(8);
    integer("level", move.level);
    integers("handles", move.handles);
    points("vectors", move.vectors);
    boolean("places", move.places);
    text("reach", name_of(move.reach));
    text("falloff", name_of(move.falloff));
    text("ruler", name_of(move.ruler));
    number("radius", move.radius);
    out_.end();
  }

  void write(const Pin& pin) {
    out_.key("pin"), out_.object(3);
    integer("level", pin.level);
    integers("handles", pin.handles);
    boolean("hold", pin.hold);
    out_.end();
  }

  void write(const Drag& drag) {
    out_.key("drag"), out_.object(4);
    integer("level", drag.level);
    out_.key("parameters"), out_.array(static_cast<Index>(drag.parameters.size()));
    for (const double parameter : drag.parameters) out_.number(parameter);
    out_.end();
    points("places", drag.places);
    text("lead", name_of(drag.lead));
    out_.end();
  }

  void write(const Restyle& restyle) {
    out_.key("restyle"), out_.object(7);
    write(restyle.levels);
    number("scale", restyle.scale);
    number("angle", restyle.angle);
    integer("mirror", restyle.mirror + 1);
    out_.end();
  }

  void write(const Texture& texture) {
    out_.key("texture"), out_.object(8);
    write(texture.levels);
    number("roughness", texture.roughness);
    number("size", texture.size);
    text("seed", std::to_string(texture.seed));  // a number would lose what lies beyond 2^53
    const bool random = texture.told.empty() && !texture.from;
    const int levels = random ? 0 : deformer_.model().levels();
    out_.key("details"), out_.array(levels);
    for (int level = 0; level < levels; ++level) {
      const PointsPtr details = core::texture(deformer_.model(), texture, level);
      out_.object(details ? 1 : 0);
      if (details) points("dense", *details);
      out_.end();
    }
    out_.end();
    out_.end();
  }

  void write(const Levels& levels) {
    integer("first", levels.first);
    integer("last", levels.last);
    integer("fade", levels.fade);
    number("share", levels.share);
  }

  void text(std::string_view key, std::string_view value) { out_.key(key), out_.text(value); }
  void integer(std::string_view key, Index value) { out_.key(key), out_.integer(value); }
  void number(std::string_view key, double value) { out_.key(key), out_.number(value); }
  void boolean(std::string_view key, bool value) { out_.key(key), out_.boolean(value); }

  void integers(std::string_view key, const std::vector<Index>& values) {
    out_.key(key), out_.array(static_cast<Index>(values.size()));
    for (const Index value : values) out_.integer(value);
    out_.end();
  }

  void points(std::string_view key, const Points& points) {
    out_.key(key), out_.array(points.size());
    for (Index i = 0; i < points.count(); ++i)
      for (Index axis = 0; axis < points.dimension(); ++axis)
        out_.number(points.plane(axis)[static_cast<std::size_t>(i)]);
    out_.end();
  }

  const Deformer& deformer_;
  Emitter& out_;
};

}  // namespace

Bytes write_edits(const Deformer& deformer, Format format) {
  Bytes bytes;
  EditsWriter(deformer, *make_emitter(format, bytes)).write();
  return bytes;
}

}  // namespace ifsm::core
