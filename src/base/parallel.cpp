#include "base/parallel.h"

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <list>
#include <map>
#include <mutex>

#include "base/cancel.h"

namespace ifsm::core {
namespace {

std::atomic<int> default_count{0};

struct ThisThread {
  int most = 0;
  bool inside = false;  // a body of parallel_for, whose arena it is in
};
thread_local ThisThread of_this_thread;

// While a body runs.
class Inside {
 public:
  explicit Inside(int wanted) : before_(of_this_thread) { of_this_thread = {wanted, true}; }
  ~Inside() { of_this_thread = before_; }
  Inside(const Inside&) = delete;
  Inside& operator=(const Inside&) = delete;

 private:
  ThisThread before_;
};

// TBB prints a warning when it is asked for more threads than the process may have.
int allowed(int wanted) {
  const auto most = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  return static_cast<int>(std::min(static_cast<std::size_t>(wanted), most));
}

// Arenas that nobody is in, by how many threads they hold. One that is made and destroyed anew for each call costs
// milliseconds and, with TBB 2021.8, 7 kB that never come back. They are as many as calls have ever run at once.
class Arenas {
 public:
  // Runs in an arena of its own, or in a new one when all are taken.
  template <class Run>
  void execute(int threads, const Run& run) {
    std::list<tbb::task_arena> taken = take(threads);
    const Return back{*this, threads, taken};
    taken.front().execute(run);
  }

 private:
  struct Return {
    Arenas& arenas;
    int threads;
    std::list<tbb::task_arena>& taken;
    ~Return() { arenas.give(threads, taken); }
  };

  std::list<tbb::task_arena> take(int threads) {
    std::list<tbb::task_arena> taken;
    const std::lock_guard lock(mutex_);
    std::list<tbb::task_arena>& idle = idle_[threads];
    if (idle.empty())
      taken.emplace_back(threads);
    else
      taken.splice(taken.begin(), idle, idle.begin());
    return taken;
  }

  // Allocates nothing.
  void give(int threads, std::list<tbb::task_arena>& taken) {
    const std::lock_guard lock(mutex_);
    std::list<tbb::task_arena>& idle = idle_.find(threads)->second;
    idle.splice(idle.begin(), taken);
  }

  std::mutex mutex_;
  std::map<int, std::list<tbb::task_arena>> idle_;
};

// Never destroyed: a thread may still be in one while the process ends.
Arenas& arenas() {
  static Arenas& all = *new Arenas;
  return all;
}

}  // namespace

void set_default_threads(int threads) { default_count.store(threads, std::memory_order_relaxed); }

int default_threads() { return default_count.load(std::memory_order_relaxed); }

Threads::Threads(int most) : before_(of_this_thread.most) {
  if (most > 0) of_this_thread.most = most;
}

Threads::~Threads() { of_this_thread.most = before_; }

std::int64_t threads_at_once() {
  const int asked = of_this_thread.most > 0 ? of_this_thread.most : default_threads();
  return asked > 0 ? allowed(asked) : std::max(tbb::info::default_concurrency(), 1);
}

void parallel_for(std::int64_t chunks, int threads, const std::function<void(std::int64_t chunk)>& body) {
  const int asked = threads > 0 ? threads : of_this_thread.most;
  const int wanted = asked > 0 ? asked : default_threads();
  if (chunks <= 1 || wanted == 1) {
    for (std::int64_t chunk = 0; chunk < chunks; ++chunk) {
      poll_interrupt();
      body(chunk);
    }
    return;
  }
  const auto run = [&] {
    tbb::parallel_for(
        std::int64_t{0}, chunks,
        [&](std::int64_t chunk) {
          const Inside inside(wanted);
          poll_interrupt();
          body(chunk);
        },
        tbb::simple_partitioner{});
  };
  if (of_this_thread.inside) {
    tbb::this_task_arena::isolate(run);  // a thread that waits here must not begin another of the outer chunks
    return;
  }
  arenas().execute(wanted > 0 ? allowed(wanted) : tbb::task_arena::automatic, run);
}

}  // namespace ifsm::core
