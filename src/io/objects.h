// Objects read by tables of their members: keys, types and finite numbers are checked, what they mean is not.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "linalg/points.h"

namespace ifsm::core {

struct Member;
using Members = std::vector<Member>;

// An object within an object, and an array of objects: the members of a new one, when it begins.
struct Object {
  std::function<Members()> begin;
};
struct Objects {
  std::function<Members()> begin;
  std::size_t most;
  const char* too_many;  // what an error says of the one that is too many
};

// Where a value goes, and by its type what it must be.
using Slot =
    std::variant<bool*, Index*, double*, std::string*, std::vector<double>*, std::vector<Index>*, Object, Objects>;

struct Member {
  std::string_view key;
  Slot slot;
  bool required = true;
  bool seen = false;
};

constexpr std::size_t most_levels = 40;  // Shape's; each level's entry is larger than the byte that can ask for it
constexpr const char* too_many_levels = "is one level too many; a tree has at most 40.";

// What a file calls itself; `what` is for messages: "model".
struct FileKind {
  std::string_view format;
  Index version;
  const char* what;
};

// Errors: format, version, limit, not finite; they name the entry ("details[3].at[17]") or the byte ("bytes"). A file
// of another kind, or of a newer version, is refused as that, whatever else it holds.
void read_object(std::span<const std::uint8_t> bytes, const FileKind& kind, const Members& members);

}  // namespace ifsm::core
