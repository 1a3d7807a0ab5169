// What `ifsm fit` tells when it is done.
#pragma once

#include <string>

#include "commands/fitting.h"
#include "report.h"

namespace cli {

struct WrittenModel {
  std::string path;
  ifsm::Format format;
  std::size_t bytes;
};

// One model: "output", its shape, and "fit" unless nothing was fitted; "curve" when the file names it.
Json report_of(const Samples& samples, const FittedModel& fitted, const WrittenModel& written);

// In words: of a report with "input", of the same with several "models".
std::string in_words(const Json& report);

}  // namespace cli
