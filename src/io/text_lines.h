// What readers of text files share: errors that name the line, words of a stranger's file in messages, numbers.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "base/error.h"

namespace ifsm::core {

// Argument "bytes", the line, counted from 1, in the message and as the index.
Error at_line(Status status, std::int64_t line, const std::string& says);

// What a message may hold of a stranger's file: in quotes, cut, without characters that do not print.
std::string quoted(std::string_view text);

bool is_space(char c);

// A decimal that a double holds: else not_finite or format, and what to say of it; `expected` ends the sentence.
Status read_number(std::string_view word, double& value);
Error no_number(Status status, std::string_view word, std::int64_t line, const std::string& expected);

}  // namespace ifsm::core
