#include "capi/handles.h"

#include <bit>
#include <chrono>
#include <random>
#include <string>
#include <thread>
#include <utility>

#include "base/error.h"

namespace ifsm::core {
namespace {

struct Parts {
  std::uint64_t kind, cookie, slot, generation;
};

constexpr std::uint64_t low_bits(std::uint64_t value, int bits) { return value & ((std::uint64_t{1} << bits) - 1); }

constexpr std::uint64_t pack(const Parts& parts) {
  std::uint64_t id = parts.kind;
  id = id << HandleTable::cookie_bits | parts.cookie;
  id = id << HandleTable::slot_bits | parts.slot;
  return id << HandleTable::generation_bits | parts.generation;
}

constexpr Parts unpack(std::uint64_t id) {
  Parts parts{};
  parts.generation = low_bits(id, HandleTable::generation_bits), id >>= HandleTable::generation_bits;
  parts.slot = low_bits(id, HandleTable::slot_bits), id >>= HandleTable::slot_bits;
  parts.cookie = low_bits(id, HandleTable::cookie_bits), id >>= HandleTable::cookie_bits;
  parts.kind = id;
  return parts;
}

// The cookie tells tables apart; it guards against accidents, not against attackers, so the clock is good enough
// where there is no better source.
std::uint64_t draw_cookie() {
  try {
    return low_bits(std::random_device{}(), HandleTable::cookie_bits);
  } catch (const std::runtime_error&) {
    const auto now = std::chrono::steady_clock::now().time_since_epoch().count();
    return low_bits(static_cast<std::uint64_t>(now) * 0x9E3779B97F4A7C15u >> 40, HandleTable::cookie_bits);
  }
}

// Held for a handful of instructions.
class SpinLock {
 public:
  void lock() {
    while (flag_.test_and_set(std::memory_order_acquire)) std::this_thread::yield();
  }
  void unlock() { flag_.clear(std::memory_order_release); }

 private:
  std::atomic_flag flag_;
};

bool is_kind(std::uint64_t kind) { return kind >= 1 && kind <= static_cast<std::uint64_t>(Kind::system); }

}  // namespace

struct HandleTable::Slot {
  SpinLock lock;                 // guards id, generation and object
  std::uint32_t index = 0;       // fixed
  std::uint32_t generation = 0;  // of the last id given out, 0 for none
  std::uint32_t next_free = no_slot;
  std::uint64_t id = 0;  // the live id, 0 for none
  std::shared_ptr<void> object;
};

const char* kind_name(Kind kind) {
  switch (kind) {
    case Kind::cancel: return "cancel";
    case Kind::filter: return "filter";
    case Kind::model: return "model";
    case Kind::fit: return "fit";
    case Kind::deformer: return "deformer";
    case Kind::system: return "system";
  }
  return "handle";
}

HandleTable::~HandleTable() {
  for (auto& chunk : chunks_) delete[] chunk.load();
}

std::uint64_t HandleTable::insert(Kind kind, std::shared_ptr<void> object) {
  const std::lock_guard growing(growing_);
  Slot& slot = free_slot();
  const std::lock_guard guard(slot.lock);
  slot.id = pack({static_cast<std::uint64_t>(kind), cookie_, slot.index, ++slot.generation});
  slot.object = std::move(object);
  return slot.id;
}

std::shared_ptr<void> HandleTable::borrow(Kind kind, std::uint64_t id, const char* argument) const {
  if (Slot* slot = find(id); slot != nullptr && unpack(id).kind == static_cast<std::uint64_t>(kind)) {
    const std::lock_guard guard(slot->lock);
    if (slot->id == id) return slot->object;
  }
  refuse(kind, id, argument);
}

void HandleTable::remove(Kind kind, std::uint64_t id, const char* argument) {
  if (id == 0) return;
  const auto object = borrow(kind, id, argument);  // outlives the locks: a destructor may take its time
  const std::lock_guard growing(growing_);
  Slot& slot = *find(id);
  std::shared_ptr<void> removed;
  {
    const std::lock_guard guard(slot.lock);
    if (slot.id == id) removed = std::move(slot.object), slot.id = 0;
  }
  if (removed == nullptr) refuse(kind, id, argument);  // another thread was faster
  if (slot.generation < limits_.generations) slot.next_free = std::exchange(first_free_, slot.index);
}

// The slot that an id names, when there is one.
HandleTable::Slot* HandleTable::find(std::uint64_t id) const {
  const Parts parts = unpack(id);
  if (parts.slot >= size_.load(std::memory_order_acquire) || parts.cookie != cookie_) return nullptr;
  return &slot_at(static_cast<std::uint32_t>(parts.slot));
}

HandleTable::Slot& HandleTable::slot_at(std::uint32_t index) const {
  const std::uint32_t shifted = index + (1u << first_chunk_bits);
  const int power = static_cast<int>(std::bit_width(shifted)) - 1;
  Slot* chunk = chunks_[static_cast<std::size_t>(power - first_chunk_bits)].load(std::memory_order_acquire);
  return chunk[shifted - (1u << power)];
}

HandleTable::Slot& HandleTable::free_slot() {
  if (first_free_ == no_slot) return fresh_slot();
  Slot& slot = slot_at(first_free_);
  first_free_ = slot.next_free;
  return slot;
}

HandleTable::Slot& HandleTable::fresh_slot() {
  const std::uint32_t index = size_.load(std::memory_order_relaxed);
  if (index >= limits_.slots)
    throw Error(Status::limit, "", "All " + std::to_string(limits_.slots) + " handles are in use; destroy some first.");
  if (index == 0) cookie_ = draw_cookie();
  const std::uint32_t shifted = index + (1u << first_chunk_bits);
  if (std::has_single_bit(shifted))  // the first of its chunk
    chunks_[static_cast<std::size_t>(std::countr_zero(shifted) - first_chunk_bits)].store(new Slot[shifted]);
  Slot& slot = slot_at(index);
  slot.index = index;
  size_.store(index + 1, std::memory_order_release);
  return slot;
}

void HandleTable::refuse(Kind kind, std::uint64_t id, const char* argument) const {
  const std::string noun = std::string("ifsm_") + kind_name(kind);
  const std::string subject = std::string(argument) + " is ";
  const auto because = [&](const std::string& reason) {
    return Error(Status::invalid_handle, argument, subject + reason);
  };

  if (id == 0)
    throw because("the null handle; make an " + noun + " first, and check the status of the call that makes it.");
  Slot* slot = find(id);
  const Parts parts = unpack(id);
  if (slot == nullptr || !is_kind(parts.kind) || parts.generation == 0)
    throw because("not a handle of this library; pass an " + noun + " that it made, as it was made.");
  const std::lock_guard guard(slot->lock);
  if (parts.generation > slot->generation)
    throw because("a handle that was never given out; pass an " + noun + " that this library made, as it was made.");
  if (slot->id == id)
    throw because(std::string("an ifsm_") + kind_name(static_cast<Kind>(parts.kind)) + ", not an " + noun +
                  "; pass the handle of the right kind.");
  if (parts.generation == slot->generation && slot->id != 0)
    throw because("a handle whose kind was changed; pass an " + noun + " that this library made, as it was made.");
  throw because("destroyed; use an " + noun + " before it is destroyed, and destroy it once.");
}

}  // namespace ifsm::core
