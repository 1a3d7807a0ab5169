// What ifsm info tells of a system.
#pragma once

#include <string>

#include <ifsm.hpp>

#include "report.h"

namespace cli {

Json report_of_system(const std::string& name, const ifsm::System& system);
std::string system_in_words(const Json& report);

// The systems of a file of several.
Json report_of_file(const std::string& file, const std::vector<std::string>& names);
std::string file_in_words(const Json& report);

}  // namespace cli
