#include "base/cancel.h"

#include <algorithm>
#include <utility>

namespace ifsm::core {

Watch::Watch(const CancelToken* token, Progress progress) : token_(token), progress_(std::move(progress)) {}

void Watch::report(double fraction, const char* stage) {
  poll();
  reported_ = std::max(reported_, std::min(fraction, 1.0));
  if (progress_ && progress_(reported_, stage)) throw Cancelled{};
}

Watch Watch::part(double from, double to) {
  return {token_, [this, from, to](double fraction, const char* stage) {
            report(from + (to - from) * fraction, stage);
            return false;
          }};
}

}  // namespace ifsm::core
