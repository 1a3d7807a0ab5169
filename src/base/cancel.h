// Cancelling and progress. Long work holds a Watch and polls it often enough to answer within 100 ms.
#pragma once

#include <atomic>
#include <functional>

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
  // progress(fraction, stage) returns true to cancel; it runs on the thread that calls report().
  using Progress = std::function<bool(double fraction, const char* stage)>;

  Watch() = default;
  Watch(const CancelToken* token, Progress progress);

  // Throws Cancelled when the token was raised. Any thread; costs one load.
  void poll() const {
    if (token_ != nullptr && token_->requested()) throw Cancelled{};
  }

  // Polls, then tells the progress callback; `fraction` never goes back: a smaller one is told as the last.
  void report(double fraction, const char* stage);

  // Everything reported through the result lies in [from, to] of this watch.
  Watch part(double from, double to);

 private:
  const CancelToken* token_ = nullptr;
  Progress progress_;
  double reported_ = 0;
};

}  // namespace ifsm::core
