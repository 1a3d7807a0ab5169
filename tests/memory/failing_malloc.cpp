#include "failing_malloc.h"

#include <atomic>
#include <cerrno>
#include <cstddef>

// glibc keeps these for programs that define their own.
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* block, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
void __libc_free(void* block);
}

namespace failing_malloc {
namespace {

std::atomic<std::int64_t> fails_at{0};  // 0: never
std::atomic<std::int64_t> count{0};
std::atomic<bool> fired{false};
std::atomic<std::int64_t> blocks{0};

bool fails() {
  const std::int64_t at = fails_at.load(std::memory_order_relaxed);
  if (at == 0 || ++count != at) return false;
  fired = true;
  errno = ENOMEM;
  return true;
}

void* counted_in(void* block) {
  if (block != nullptr) ++blocks;
  return block;
}

}  // namespace

void arm(std::int64_t which) {
  count = 0;
  fired = false;
  fails_at = which;
}

bool disarm() {
  fails_at = 0;
  return fired;
}

std::int64_t counted() { return count; }
std::int64_t live() { return blocks; }

}  // namespace failing_malloc

using failing_malloc::counted_in;
using failing_malloc::fails;

extern "C" {

void* malloc(std::size_t size) { return fails() ? nullptr : counted_in(__libc_malloc(size)); }
void* calloc(std::size_t count, std::size_t size) { return fails() ? nullptr : counted_in(__libc_calloc(count, size)); }
void* memalign(std::size_t alignment, std::size_t size) {
  return fails() ? nullptr : counted_in(__libc_memalign(alignment, size));
}
void* aligned_alloc(std::size_t alignment, std::size_t size) { return memalign(alignment, size); }
int posix_memalign(void** block, std::size_t alignment, std::size_t size) {
  void* const made = memalign(alignment, size);
  if (made == nullptr) return ENOMEM;
  *block = made;
  return 0;
}
void* realloc(void* block, std::size_t size) {
  if (fails()) return nullptr;
  void* const moved = __libc_realloc(block, size);
  if (block == nullptr)
    counted_in(moved);
  else if (moved == nullptr && size == 0)
    --failing_malloc::blocks;
  return moved;
}
void free(void* block) {
  if (block != nullptr) --failing_malloc::blocks;
  __libc_free(block);
}

}  // extern "C"
