#include "capi/options.h"

#include <string>

namespace ifsm::core {

double positive_or(double value, double otherwise, const char* argument) {
  require_finite(value, argument);
  if (value == 0) return otherwise;
  if (value > 0) return value;
  throw Error(Status::range, argument,
              std::string(argument) + " is " + text_of(value) + "; give a number above 0, or 0 for the default.")
      .with(value);
}

double in_between(double value, double low, double high, const char* argument) {
  require_finite(value, argument);
  if (value >= low && value <= high) return value;
  throw Error(Status::range, argument,
              std::string(argument) + " is " + text_of(value) + "; give one from " + text_of(low) + " to " +
                  text_of(high) + ".")
      .with(value);
}

}  // namespace ifsm::core
