// What the path of an output leads to, before anything is opened.
#pragma once

#include <sys/stat.h>

#include <filesystem>
#include <optional>
#include <string>

namespace cli {

struct Destination {
  std::filesystem::path path;          // the symbolic links of its last name followed; need not exist
  std::optional<int> descriptor = {};  // of this process, when the path stands for it: "-", /dev/stdout, /dev/fd/3
  int error = 0;                       // errno, when the path leads nowhere
};

Destination destination(const std::string& path);

bool same_file(const struct stat& a, const struct stat& b);

}  // namespace cli
