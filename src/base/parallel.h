// Threads. Work is cut into chunks whose borders do not depend on the number of threads, so results keep their bits.
#pragma once

#include <cstdint>
#include <functional>

namespace ifsm::core {

// Process-wide default: 0 means one a core.
void set_default_threads(int threads);
int default_threads();

// Calls that this thread makes while the object lives use at most so many threads; 0 leaves it at the default.
class Threads {
 public:
  explicit Threads(int most);
  ~Threads();
  Threads(const Threads&) = delete;
  Threads& operator=(const Threads&) = delete;

 private:
  int before_;
};

// On how many threads parallel_for runs here at most: what buffers of one a thread are made for. At least 1.
std::int64_t threads_at_once();

// Calls body(chunk) once for every chunk in 0 … chunks - 1, on at most `threads` threads (0: as Threads, else the
// default says). Chunks must not write to the same place. The first exception that a chunk throws is thrown again here,
// after all have ended. Before a chunk its thread's interrupt is polled. A body may call parallel_for itself: what it
// does then shares the same threads.
void parallel_for(std::int64_t chunks, int threads, const std::function<void(std::int64_t chunk)>& body);

}  // namespace ifsm::core
