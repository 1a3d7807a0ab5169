// Threads. Work is cut into chunks whose borders do not depend on the number of threads, so results keep their bits.
#pragma once

#include <cstdint>
#include <functional>

namespace ifsm::core {

// Process-wide default: 0 means one a core.
void set_default_threads(int threads);
int default_threads();

// Calls body(chunk) once for every chunk in 0 … chunks - 1, on at most `threads` threads (0: the default). Chunks must
// not write to the same place. The first exception that a chunk throws is thrown again here, after all have ended.
void parallel_for(std::int64_t chunks, int threads, const std::function<void(std::int64_t chunk)>& body);

}  // namespace ifsm::core
