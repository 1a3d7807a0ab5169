// What is wrong with a command line, as a sentence.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace cli {

// Throws Failure{Usage} when the first word is neither a command nor an option of the program.
void check_command(const CLI::App& program, int argc, const char* const* argv);

// Of an error that the parser threw.
std::string sentence_of(const CLI::App& program, const CLI::ParseError& error);

}  // namespace cli
