// Cancelling and progress. Long work holds a Watch and polls it often enough to answer within 100 ms.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <string_view>
#include <thread>

namespace ifsm::core {

// A flag that any thread may raise, once.
class CancelToken {
 public:
  void request() { requested_.store(true, std::memory_order_relaxed); }
  bool requested() const { return requested_.load(std::memory_order_relaxed); }

 private:
  std::atomic<bool> requested_{false};
};

// Thrown by Watch and poll_interrupt, never caught below src/capi except to clean up.
struct Cancelled {};

// What this thread asks in work, also in such as has no progress callback: about every 50 ms, whether to stop (not 0).
// NULL: nothing.
using Interrupt = std::int32_t (*)(void* user);
void set_interrupt(Interrupt ask, void* user);

// Throws Cancelled when the thread's interrupt says so. Costs a look at the clock, or nothing without one.
void poll_interrupt();

// For loops of cheap steps: polls once in a few thousand of them.
class Polled {
 public:
  void step() {
    constexpr unsigned steps = 1 << 12;
    if (++done_ % steps == 0) poll_interrupt();
  }

 private:
  unsigned done_ = 0;
};

class Watch {
 public:
  // progress(fraction, stage) returns true to cancel; it runs on the thread that made the watch.
  using Progress = std::function<bool(double fraction, const char* stage)>;

  Watch() = default;
  Watch(const CancelToken* token, Progress progress);

  // Throws Cancelled when the token was raised, or when the progress callback says so (without one, the thread's
  // interrupt), which is asked again when it has not been for a while: 50 ms, or as long as its last answer took. Any
  // thread (others than the watch's own ask the token alone); costs a look at the clock.
  void poll() const {
    if (token_ != nullptr && token_->requested()) throw Cancelled{};
    if (progress_)
      ask_again();
    else
      poll_interrupt();
  }

  // Polls, then tells the progress callback; `fraction` never goes back: a smaller one is told as the last. `stage` is
  // static. A callback that takes longer than a millisecond is not told of everything, so that it costs half of the
  // time at most; new stages are always told.
  void report(double fraction, const char* stage);

  // Reports 1, and "done" unless this watch is a part of another.
  void finish() { report(1.0, part_ ? stage_ : "done"); }

  // Everything reported through the result lies in [from, to] of this watch, and is in its stage until it reports one.
  Watch part(double from, double to);

 private:
  using Clock = std::chrono::steady_clock;
  void ask_again() const;
  void tell() const;

  const CancelToken* token_ = nullptr;
  Progress progress_;
  std::thread::id owner_;
  double reported_ = 0;
  const char* stage_ = "start";  // before the first report
  bool part_ = false;
  // The owner's: when the callback last answered, how long that took, of which stage.
  mutable Clock::time_point asked_;
  mutable Clock::duration took_{};
  mutable std::string_view told_;
};

}  // namespace ifsm::core
