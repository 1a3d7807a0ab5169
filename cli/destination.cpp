#include "destination.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <system_error>

namespace cli {
namespace {

namespace fs = std::filesystem;

constexpr int most_links = 40;  // that Linux follows

// The number that a path like /dev/fd/3 or /proc/self/fd/3 ends in.
std::optional<int> number_in(const fs::path& path) {
  const auto name = path.filename().string();
  int number = 0;
  const auto end = name.data() + name.size();
  const bool counts = std::from_chars(name.data(), end, number).ptr == end && !name.empty() && number >= 0;
  return counts && path.parent_path().filename() == "fd" ? std::optional(number) : std::nullopt;
}

bool starts_with(const std::string& text, const char* start) { return text.rfind(start, 0) == 0; }

// The open descriptor that a path under /dev or /proc stands for. To open such a path anew would write from the
// beginning of the file again, and to replace the file would lose what else is written to it.
std::optional<int> descriptor_named(const fs::path& path) {
  std::error_code ignored;
  const auto whole = fs::absolute(path, ignored).lexically_normal();
  const auto text = whole.string();
  const bool own = starts_with(text, "/dev/fd/") || starts_with(text, "/proc/self/fd/");
  const auto number = number_in(whole);
  if (!number || (!own && !starts_with(text, "/proc/"))) return std::nullopt;
  struct stat named;
  if (::stat(path.c_str(), &named) != 0) return own ? number : std::nullopt;
  for (const int candidate : {*number, STDOUT_FILENO, STDERR_FILENO}) {
    struct stat open;
    if (::fstat(candidate, &open) == 0 && same_file(open, named)) return candidate;
  }
  return std::nullopt;
}

}  // namespace

bool same_file(const struct stat& a, const struct stat& b) { return a.st_dev == b.st_dev && a.st_ino == b.st_ino; }

Destination destination(const std::string& path) {
  if (path == "-") return {path, STDOUT_FILENO};
  fs::path place = path;
  for (int links = 0; links <= most_links; ++links) {
    if (const auto descriptor = descriptor_named(place)) return {place, descriptor};
    struct stat found;
    if (::lstat(place.c_str(), &found) != 0) return {place, {}, errno == ENOENT ? 0 : errno};
    if (!S_ISLNK(found.st_mode)) return {place};
    std::error_code error;
    const auto target = fs::read_symlink(place, error);
    if (error) return {place, {}, error.value()};
    place = place.parent_path() / target;
  }
  return {path, {}, ELOOP};
}

}  // namespace cli
