#include "io/system_files.h"

#include <algorithm>

#include "base/error.h"
#include "io/flame.h"
#include "io/fractint.h"
#include "io/system_file.h"
#include "io/text_lines.h"

namespace ifsm::core {
namespace {

enum class Kind { document, flame, fractint };

bool is_cbor(std::uint8_t first) {
  constexpr std::uint8_t map = 0xa0, map_end = 0xbf, self_described = 0xd9;
  return (first >= map && first <= map_end) || first == self_described;
}

Kind kind_of(std::string_view text) {
  const auto first = std::find_if_not(text.begin(), text.end(), is_space);
  if (first == text.end()) throw Error(Status::format, "bytes", "The file is empty; give one that holds a system.");
  if (*first == '{' || is_cbor(static_cast<std::uint8_t>(text.front()))) return Kind::document;
  return *first == '<' ? Kind::flame : Kind::fractint;
}

std::string_view without_mark(std::string_view text) {
  constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
  return text;
}

std::string list_of(const std::vector<NamedFileSystem>& systems) {
  constexpr std::size_t most = 20;
  std::string list;
  for (std::size_t k = 0; k < std::min(systems.size(), most); ++k)
    list += (k == 0 ? "" : ", ") + quoted(systems[k].name);
  return list + (systems.size() > most ? ", …" : "");
}

}  // namespace

std::vector<NamedFileSystem> read_systems(std::span<const std::uint8_t> bytes) {
  const std::string_view text = without_mark({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  std::vector<NamedFileSystem> systems;
  switch (kind_of(text)) {
    case Kind::document: systems.push_back({"", read_system(bytes), {}}); break;
    case Kind::flame:
      for (FlameSystem& each : read_flame(text))
        systems.push_back({std::move(each.name), std::move(each.system), std::move(each.refused)});
      break;
    case Kind::fractint:
      for (FractintSystem& each : read_fractint(text))
        systems.push_back({std::move(each.name), std::move(each.system), {}});
      break;
  }
  return systems;
}

SystemPtr read_system_named(std::span<const std::uint8_t> bytes, std::optional<std::string_view> name) {
  const std::vector<NamedFileSystem> systems = read_systems(bytes);
  const auto refuse = [&](const std::string& what, const std::string& way_out) {
    throw Error(Status::range, "name", "The file holds " + what + "; " + way_out + " " + list_of(systems) + ".");
  };
  if (!name && systems.size() > 1) refuse(std::to_string(systems.size()) + " systems", "name one of");
  const auto is_meant = [&](const auto& each) { return !name || each.name == *name; };
  const auto found = std::find_if(systems.begin(), systems.end(), is_meant);
  if (found == systems.end()) refuse("no system " + quoted(*name), "there is");
  if (std::find_if(found + 1, systems.end(), is_meant) != systems.end())
    refuse("several systems " + quoted(*name), "give each a name of its own:");
  if (found->refused) throw Error(*found->refused);
  return found->system;
}

}  // namespace ifsm::core
