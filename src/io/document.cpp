#include "io/document.h"

#include "io/objects.h"

namespace ifsm::core {
namespace {

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

Members members_of(Document& d) {
  return {{"format", &d.format},
          {"version", &d.version},
          {"dimension", &d.dimension},
          {"closed", &d.closed},
          {"samples", &d.samples},
          {"levels", &d.levels},
          {"filter", Object{[&] { return members_of(d.filter); }}},
          {"center", &d.center},
          {"diagonal", &d.diagonal},
          {"largest_polygon", &d.largest_polygon},
          {"control_points", &d.control_points},
          {"details", Objects{[&] { return members_of(d.details.emplace_back()); }, most_levels, too_many_levels}}};
}

}  // namespace

Document read_document(std::span<const std::uint8_t> bytes) {
  Document document;
  read_object(bytes, {format_name, format_version, "a model"}, members_of(document));
  return document;
}

}  // namespace ifsm::core
