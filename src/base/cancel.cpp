#include "base/cancel.h"

#include <algorithm>
#include <utility>

namespace ifsm::core {
namespace {

constexpr auto patience = std::chrono::milliseconds(50);  // half of what a cancel may take

using Clock = std::chrono::steady_clock;

// Nothing that would have to be destroyed with its thread.
struct {
  Interrupt ask;
  void* user;
  Clock::time_point asked;  // or looked at first: short calls never look at the clock
} thread_local constinit interrupt{};

}  // namespace

void set_interrupt(Interrupt ask, void* user) { interrupt = {ask, user, {}}; }

void poll_interrupt() {
  if (interrupt.ask == nullptr) return;
  const Clock::time_point now = Clock::now();
  if (interrupt.asked == Clock::time_point{}) interrupt.asked = now;
  if (now - interrupt.asked < patience) return;
  const bool stop = interrupt.ask(interrupt.user) != 0;
  interrupt.asked = Clock::now();
  if (stop) throw Cancelled{};
}

Watch::Watch(const CancelToken* token, Progress progress)
    : token_(token), progress_(std::move(progress)), owner_(std::this_thread::get_id()), asked_(Clock::now()) {}

void Watch::report(double fraction, const char* stage) {
  if (token_ != nullptr && token_->requested()) throw Cancelled{};
  reported_ = std::max(reported_, std::min(fraction, 1.0));
  stage_ = stage;
  constexpr auto quick = std::chrono::milliseconds(1);
  if (!progress_) return poll_interrupt();
  if (took_ < quick || told_ != stage_ || Clock::now() - asked_ >= took_) tell();
}

void Watch::ask_again() const {
  if (std::this_thread::get_id() == owner_ && Clock::now() - asked_ >= std::max<Clock::duration>(patience, took_))
    tell();
}

void Watch::tell() const {
  const auto start = Clock::now();
  told_ = stage_;
  const bool stop = progress_(reported_, stage_);
  asked_ = Clock::now();
  took_ = asked_ - start;
  if (stop) throw Cancelled{};
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
