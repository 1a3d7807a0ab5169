// Files as whole byte strings: read at once, replaced at once. "-" is standard input or output.
#pragma once

#include <string>
#include <string_view>

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

// Removes the new file of a write_file that is under way, if any, and lets no other begin: for the last moment before
// _exit. Any thread.
void abandon_writing();

}  // namespace cli
