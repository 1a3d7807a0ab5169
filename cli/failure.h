// The one exception of the program: a sentence for the user and the exit code that goes with it.
#pragma once

#include <stdexcept>
#include <string>

namespace cli {

// Documented in docs/cli.md and in --help; each number means the same for ever.
enum class Exit : int { Fine = 0, Computing = 1, Usage = 2, Input = 3, Output = 4, Cancelled = 130 };

inline constexpr const char* cancelled = "cancelled; nothing was written.";

struct Failure : std::runtime_error {
  Failure(Exit exit_code, const std::string& message) : std::runtime_error(message), code(exit_code) {}
  Exit code;
};

}  // namespace cli
