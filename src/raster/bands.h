// Counts of windows that no cache holds. A count that is far away costs tens of ns; so pixels are first sorted by
// bands, and added band by band, whose counts stay near meanwhile. Each band is added by one thread: nothing is atomic,
// and there is one array of counts however many threads there are.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/cancel.h"

namespace ifsm::core {

class Bands {
 public:
  // Pixels at once; two bytes each when they are sorted. Fewer have shorter runs of one band, each far from the next.
  static constexpr std::int64_t piece = 1 << 19;

  // Adds to the counts, which stay where they are. For `pieces` in all, of `groups` that sort at the same time, if
  // memory allows: what is beside the counts takes a quarter of theirs at most, or what makes it 80 MB with them.
  Bands(std::span<std::uint32_t> counts, std::int64_t pieces, std::int64_t groups);

  std::int64_t groups() const { return groups_; }
  std::int64_t slots() const { return slots_; }

  // A group's, for a piece's pixels and `beyond_pixels` more.
  std::span<std::int32_t> room(std::int64_t group);

  // Into a slot that is empty. Groups do this at the same time, in different slots.
  void sort(std::span<const std::int32_t> pixels, std::int64_t group, std::int64_t slot);

  // Adds all that was sorted, on many threads, and empties the slots. Counts saturate at 2^32 - 1.
  void add(Watch& watch);

 private:
  using Small = std::uint16_t;  // a place within a band

  void add_band(std::size_t band);
  std::uint32_t* starts(std::int64_t slot) { return starts_.get() + static_cast<std::size_t>(slot) * stride_; }
  Small* sorted(std::int64_t slot) { return sorted_.get() + slot * piece; }

  std::span<std::uint32_t> counts_;
  std::size_t bands_, stride_;
  std::int64_t groups_, slots_;
  std::unique_ptr<std::int32_t[]> rooms_;
  std::unique_ptr<Small[]> near_;            // what groups sort into, before it goes to a slot
  std::unique_ptr<Small[]> sorted_;          // of each slot
  std::unique_ptr<std::uint32_t[]> starts_;  // of each slot and band; after the last one's, where it ends
  std::vector<std::uint8_t> filled_;         // slots
};

}  // namespace ifsm::core
