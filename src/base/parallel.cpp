#include "base/parallel.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>

namespace ifsm::core {
namespace {

std::atomic<int> default_count{0};

// TBB prints a warning when it is asked for more threads than the process may have.
int allowed(int wanted) {
  const auto most = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  return static_cast<int>(std::min(static_cast<std::size_t>(wanted), most));
}

}  // namespace

void set_default_threads(int threads) { default_count.store(threads, std::memory_order_relaxed); }

int default_threads() { return default_count.load(std::memory_order_relaxed); }

void parallel_for(std::int64_t chunks, int threads, const std::function<void(std::int64_t chunk)>& body) {
  const int wanted = threads > 0 ? threads : default_threads();
  if (chunks <= 1 || wanted == 1) {
    for (std::int64_t chunk = 0; chunk < chunks; ++chunk) body(chunk);
    return;
  }
  tbb::task_arena arena(wanted > 0 ? allowed(wanted) : tbb::task_arena::automatic);
  arena.execute([&] { tbb::parallel_for(std::int64_t{0}, chunks, body, tbb::simple_partitioner{}); });
}

}  // namespace ifsm::core
