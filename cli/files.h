// Files as whole byte strings: read at once, replaced at once. "-" is standard input or output.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace cli {

// "-" under the name a message gives it; any other path as it is.
std::string input_name(const std::string& path);
std::string output_name(const std::string& path);

// "-", and any other path that stands for the same open file, such as /dev/stdout.
bool goes_to_standard_output(const std::string& path);

// Throws Failure{Input}: missing, unreadable, a directory.
std::string read_file(const std::string& path);

// Throws Failure{Output} when write_file cannot succeed (Failure{Usage} for an empty name): asked before a long
// computation starts. Creates nothing.
void check_writable(const std::string& path);

// Replaces the file in one step: the bytes go to a new file beside it, which then takes its name. What stood there
// before stays whole until then, and after any failure. Devices, pipes and open descriptors (/dev/stdout) are written
// to directly. A symbolic link stays one; the file that it names is replaced, or made. Throws Failure{Output}.
void write_file(const std::string& path, std::string_view bytes);

struct File {
  std::string path;
  std::string bytes;
};
enum class Existing { Replaced, Refused };

// Throws Failure{Output} when `existing` refuses a file that is there already.
void check_absent(const std::string& path, Existing existing);

// Throws Failure{Usage} when the output is one of the files that are read, under whatever name.
void check_not_read(const std::string& output, const std::vector<std::string>& inputs, const char* option = "-o");

// The same for several files: all new files are complete before the first takes its name. When one cannot, those that
// had theirs are removed again, unless they replaced others. No signal stops the taking of names half way.
void write_files(const std::vector<File>& files, Existing existing);

// How far the outputs of the process have come.
enum class Written {
  Nothing,  // no output has changed
  Part,     // a pipe or device may have got the beginning
  All,      // files take their names, or have them: it cannot be taken back
};

// Unless all is written: removes the new files of a writing that is under way, if any, and lets no other begin, for the
// last moment before _exit. Any thread.
Written abandon_writing();

}  // namespace cli
