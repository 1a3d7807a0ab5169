// The handle table: objects that C callers name by 64-bit ids.
//
// An id packs the kind of object, a random cookie of this table, a slot and the slot's generation. An id is given out
// once and never again: a slot that has used its last generation is retired. So a destroyed handle stays recognisable,
// and one made up, or of another library or process, meets neither cookie nor generation but by a chance of 2^-60.
//
// The table holds immutable objects, and those whose every operation is atomic: a borrower shares them. A mutable kind
// has a busy flag in its own object, taken for the length of a call (deforming.h); the table need not know.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>

namespace ifsm::core {

enum class Kind : std::uint8_t { cancel = 1, filter = 2, model = 3, fit = 4, deformer = 5, system = 6 };

// "model" for Kind::model.
const char* kind_name(Kind kind);

class HandleTable {
 public:
  // How the 64 bits are shared out; the tests use tables with few generations and slots.
  static constexpr int kind_bits = 4, cookie_bits = 16, slot_bits = 22, generation_bits = 22;
  static_assert(kind_bits + cookie_bits + slot_bits + generation_bits == 64);

  struct Limits {
    std::uint32_t slots = 1u << slot_bits;
    std::uint32_t generations = (1u << generation_bits) - 1;  // of one slot, counted from 1
  };

  constexpr HandleTable() = default;
  constexpr explicit HandleTable(Limits limits) : limits_(limits) {}
  HandleTable(const HandleTable&) = delete;
  HandleTable& operator=(const HandleTable&) = delete;
  ~HandleTable();

  // The id of `object`, which is not null. Throws bad_alloc or a limit error, and then nothing has changed.
  std::uint64_t insert(Kind kind, std::shared_ptr<void> object);

  // A share of the object: it lives as long as that, whatever happens to its handle. Throws an invalid-handle error
  // that names `argument` and says what is wrong with the id, as far as that can be known.
  std::shared_ptr<void> borrow(Kind kind, std::uint64_t id, const char* argument) const;

  // Ends the handle; 0 is fine. The object goes when its last share does. Errors as borrow.
  void remove(Kind kind, std::uint64_t id, const char* argument);

 private:
  struct Slot;
  static constexpr int first_chunk_bits = 6;

  Slot* find(std::uint64_t id) const;
  Slot& slot_at(std::uint32_t index) const;
  Slot& free_slot();
  Slot& fresh_slot();
  [[noreturn]] void refuse(Kind kind, std::uint64_t id, const char* argument) const;

  Limits limits_;
  std::mutex growing_;                  // guards the three below, in insert and remove; look-ups never take it
  std::uint32_t first_free_ = no_slot;  // a list through Slot::next_free
  std::atomic<std::uint32_t> size_{0};  // slots that exist; they never move nor go away
  std::uint64_t cookie_ = 0;            // drawn with the first slot, and published with it by size_
  // Chunk k holds 2^(k + first_chunk_bits) slots, so a handful of pointers reach all of them.
  std::array<std::atomic<Slot*>, slot_bits - first_chunk_bits + 1> chunks_{};

  static constexpr std::uint32_t no_slot = ~0u;
};

}  // namespace ifsm::core
