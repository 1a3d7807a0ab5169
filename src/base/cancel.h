// Cancelling and progress. Long work holds a Watch and polls it often enough to answer within 100 ms.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
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

// Thrown by Watch, never caught below src/capi except to clean up.
struct Cancelled {};

class Watch {
 public:
  // progress(fraction, stage) returns true to cancel; it runs on the thread that made the watch.
  using Progress = std::function<bool(double fraction, const char* stage)>;

  Watch() = default;
  Watch(const CancelToken* token, Progress progress);

  // Throws Cancelled when the token was raised, or when the progress callback says so, which is asked again when it has
  // not been for a while. Any thread (others than the watch's own ask the token alone); costs a look at the clock.
  void poll() const {
    if (token_ != nullptr && token_->requested()) throw Cancelled{};
    if (progress_) ask_again();
  }

  // Polls, then tells the progress callback; `fraction` never goes back: a smaller one is told as the last. `stage` is
  // static.
  void report(double fraction, const char* stage);

  // Reports 1, and "done" unless this watch is a part of another.
  void finish() { report(1.0, part_ ? stage_ : "done"); }

  // Everything reported through the result lies in [from, to] of this watch, and is in its stage until it reports one.
  Watch part(double from, double to);

 private:
  using Clock = std::chrono::steady_clock;
  void ask_again() const;

  const CancelToken* token_ = nullptr;
  Progress progress_;
  std::thread::id owner_;
  double reported_ = 0;
  const char* stage_ = "start";  // before the first report
  bool part_ = false;
  mutable Clock::time_point asked_;  // the owner's
};

}  // namespace ifsm::core
