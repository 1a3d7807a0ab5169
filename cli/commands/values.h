// What the values of options may be. Each refuses with the value and what is allowed: "-1 is not a whole number from 1
// on".
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <ifsm.hpp>

namespace cli {

// For CLI::Option::transform: numbers are decimal, whatever their zeros in front.
CLI::Validator whole_number(std::uint64_t low, std::uint64_t high = std::numeric_limits<std::int64_t>::max());
CLI::Validator whole_number_or_auto(std::uint64_t low, std::uint64_t high);
CLI::Validator number_from_zero();
CLI::Validator number_above_zero();
CLI::Validator number_between(const std::string& low, const std::string& high);  // as they are to be told
CLI::Validator one_of(const std::vector<std::string>& words);

// Of `--distance`: rms, max, hausdorff.
CLI::Validator distance_name();
ifsm::Distance distance_of(const std::string& name);

// A column of a table: not the option that comes after a forgotten list.
CLI::Validator column_name();

}  // namespace cli
