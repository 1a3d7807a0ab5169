#include "interrupt.h"

#include <pthread.h>
#include <unistd.h>

#include <string>

#include "failure.h"
#include "files.h"

namespace cli {
namespace {

[[noreturn]] void end(Exit code, const std::string& sentence) {
  const auto line = "ifsm: " + sentence + "\n";
  if (::write(STDERR_FILENO, line.data(), line.size()) < 0) _exit(static_cast<int>(code));  // said or not, it ends
  _exit(static_cast<int>(code));
}

}  // namespace

Interrupt::Interrupt() {
  sigemptyset(&signals_);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&signals_, signal);
  pthread_sigmask(SIG_BLOCK, &signals_, nullptr);
  std::signal(SIGXFSZ, SIG_IGN);  // a write beyond the limit fails then, instead of killing
  watcher_ = std::thread([this] { watch(); });
}

Interrupt::~Interrupt() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  pthread_kill(watcher_.native_handle(), SIGTERM);
  watcher_.join();
}

void Interrupt::watch() {
  for (int signal = 0; sigwait(&signals_, &signal) == 0;) {
    const std::lock_guard lock(mutex_);
    if (ending_) return;
    answer();
  }
}

void Interrupt::answer() {
  if (running_) return running_->request();
  switch (abandon_writing()) {
    case Written::Nothing: end(Exit::Cancelled, cancelled);
    case Written::Part: end(Exit::Cancelled, "cancelled; the output got a part only.");
    case Written::All: break;
  }
  // What is left is to tell the report, unless nobody takes it.
  if (late_) end(Exit::Output, "the result is written; its report may be cut off.");
  late_ = true;
}

Interrupt::Cancellable::Cancellable(Interrupt& interrupt) : interrupt_(interrupt) {
  const std::lock_guard lock(interrupt_.mutex_);
  interrupt_.running_ = &token_;
}

Interrupt::Cancellable::~Cancellable() {
  const std::lock_guard lock(interrupt_.mutex_);
  interrupt_.running_ = nullptr;
}

void Interrupt::Cancellable::confirm() const {
  if (token_.requested()) throw Failure(Exit::Cancelled, cancelled);
}

}  // namespace cli
