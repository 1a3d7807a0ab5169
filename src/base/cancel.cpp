#include "base/cancel.h"

#include <algorithm>
#include <utility>

namespace ifsm::core {
namespace {

constexpr auto patience = std::chrono::milliseconds(50);  // half of what a cancel may take

}  // namespace

Watch::Watch(const CancelToken* token, Progress progress)
    : token_(token), progress_(std::move(progress)), owner_(std::this_thread::get_id()), asked_(Clock::now()) {}

void Watch::report(double fraction, const char* stage) {
  if (token_ != nullptr && token_->requested()) throw Cancelled{};
  reported_ = std::max(reported_, std::min(fraction, 1.0));
  stage_ = stage;
  asked_ = Clock::now();
  if (progress_ && progress_(reported_, stage_)) throw Cancelled{};
}

void Watch::ask_again() const {
  if (std::this_thread::get_id() != owner_) return;
  const auto now = Clock::now();
  if (now - asked_ < patience) return;
  asked_ = now;
  if (progress_(reported_, stage_)) throw Cancelled{};
}

Watch Watch::part(double from, double to) {
  Watch result(token_, [this, from, to](double fraction, const char* stage) {
    report(from + (to - from) * fraction, stage);
    return false;
  });
  result.stage_ = stage_;
  result.part_ = true;
  return result;
}

}  // namespace ifsm::core
