// Files as whole byte strings: read at once, replaced at once. "-" is standard input or output.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace cli {

// "-" under the name a message gives it; any other path as it is.
std::string input_name(const std::string& path);
std::string output_name(const std::string& path);

// Throws Failure{Input}: missing, unreadable, a directory.
std::string read_file(const std::string& path);

// Throws Failure{Output} when write_file cannot succeed: asked before a long computation starts. Creates nothing.
void check_writable(const std::string& path);

// Replaces the file in one step: the bytes go to a new file beside it, which then takes its name. What stood there
// before stays whole until then, and after any failure. Devices and pipes are written to directly.
// Throws Failure{Output}.
void write_file(const std::string& path, std::string_view bytes);

struct File {
  std::string path;
  std::string bytes;
};
enum class Existing { Replaced, Refused };

// Throws Failure{Output} when `existing` refuses a file that is there already.
void check_absent(const std::string& path, Existing existing);

// The same for several files: all new files are complete before the first takes its name. When one cannot, those that
// had theirs are removed again, unless they replaced others. No signal stops the taking of names half way.
void write_files(const std::vector<File>& files, Existing existing);

// Removes the new files of a writing that is under way, if any, and lets no other begin: for the last moment before
// _exit. Any thread.
void abandon_writing();

}  // namespace cli
