#include "capi/fit_options.h"

#include <cmath>

#include "capi/log.h"

namespace ifsm::core {

double positive_or(double value, double otherwise, const char* argument) {
  require_finite(value, argument);
  if (value == 0) return otherwise;
  if (value > 0) return value;
  throw Error(Status::range, argument,
              std::string(argument) + " is " + text_of(value) + "; give a number above 0, or 0 for the default.")
      .with(value);
}

void log_summary(const char* function, const FitResult& fit) {
  log(LogLevel::info, (std::string(function) + ": " + std::to_string(fit.iterations) + " iterations, cost " +
                       text_of(fit.start_cost) + " to " + text_of(fit.final_cost) + ", condition " +
                       text_of(fit.start_condition) + " to " + text_of(fit.final_condition))
                          .c_str());
}

}  // namespace ifsm::core
