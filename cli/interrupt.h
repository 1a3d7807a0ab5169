// Ctrl-C and its kin: they cancel a computation through its token, and end everything else on the spot. Once the result
// is written, the first one is too late and changes nothing; a second one ends a report that nobody reads.
#pragma once

#include <csignal>
#include <mutex>
#include <thread>

#include <ifsm.hpp>

namespace cli {

// One for the process, made before any other thread. SIGINT, SIGTERM and SIGHUP are blocked everywhere and awaited by
// one watcher thread, so that no code ever runs inside a signal handler.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  // While it lives, a signal cancels calls that hold its token; they then throw ifsm::Cancelled.
  class Cancellable {
   public:
    explicit Cancellable(Interrupt& interrupt);
    ~Cancellable();
    Cancellable(const Cancellable&) = delete;
    Cancellable& operator=(const Cancellable&) = delete;
    const ifsm::Cancel& token() const { return token_; }
    // Throws Failure{Cancelled} when a signal came too late for the call to notice.
    void confirm() const;

   private:
    Interrupt& interrupt_;
    ifsm::Cancel token_;
  };

 private:
  void watch();
  void answer();

  sigset_t signals_;
  std::mutex mutex_;
  const ifsm::Cancel* running_ = nullptr;  // the token of the computation under way
  bool late_ = false;                      // a signal came when all was written
  bool ending_ = false;
  std::thread watcher_;
};

}  // namespace cli
