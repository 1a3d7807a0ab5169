#include "capi/fit_options.h"

#include "capi/log.h"

namespace ifsm::core {

void log_summary(const char* function, const FitResult& fit) {
  log(LogLevel::info, (std::string(function) + ": " + std::to_string(fit.iterations) + " iterations, cost " +
                       text_of(fit.start_cost) + " to " + text_of(fit.final_cost) + ", condition " +
                       text_of(fit.start_condition) + " to " + text_of(fit.final_condition))
                          .c_str());
}

}  // namespace ifsm::core
