#include "raster/bands.h"

#include <algorithm>
#include <cstddef>
#include <limits>

#include "base/parallel.h"
#include "raster/orbits.h"

namespace ifsm::core {
namespace {

constexpr int band_bits = 16;              // 2^16 counts are 256 KiB, which every second-level cache holds
constexpr std::int64_t slots_a_group = 2;  // those of a chunk's points, at least
static_assert(slots_a_group * Bands::piece == points_per_chunk);
constexpr std::int64_t room_size = Bands::piece + static_cast<std::int64_t>(beyond_pixels);

template <class Number>
std::unique_ptr<Number[]> room_for(std::int64_t count) {
  return std::make_unique_for_overwrite<Number[]>(static_cast<std::size_t>(count));
}

}  // namespace

Bands::Bands(std::span<std::uint32_t> counts, std::int64_t pieces, std::int64_t groups)
    : counts_(counts), bands_((counts_.size() >> band_bits) + 1) {
  // A line more than there are bands, so that the slots' starts of one band are not all in the same set of a cache.
  constexpr std::size_t line = 64 / sizeof(std::uint32_t);
  stride_ = bands_ + 1 + line;
  constexpr std::int64_t small = 5 << 24;  // bytes
  const auto pixels = static_cast<std::int64_t>(counts_.size()), beside = std::max(small, 5 * pixels) - 4 * pixels;
  const auto slot = static_cast<std::int64_t>(piece * sizeof(Small) + stride_ * sizeof(std::uint32_t) + 1);
  const auto group = static_cast<std::int64_t>(room_size * sizeof(std::int32_t) + piece * sizeof(Small));
  groups_ = std::clamp(beside / (group + slots_a_group * slot), std::int64_t{1}, groups);
  slots_ = std::clamp((beside - groups_ * group) / slot, std::int64_t{1}, pieces);
  rooms_ = room_for<std::int32_t>(groups_ * room_size);
  near_ = room_for<Small>(groups_ * piece);
  sorted_ = room_for<Small>(slots_ * piece);
  starts_ = room_for<std::uint32_t>(slots_ * static_cast<std::int64_t>(stride_));
  filled_.resize(static_cast<std::size_t>(slots_));
}

std::span<std::int32_t> Bands::room(std::int64_t group) {
  return {rooms_.get() + group * room_size, static_cast<std::size_t>(room_size)};
}

void Bands::sort(std::span<const std::int32_t> pixels, std::int64_t group, std::int64_t slot) {
  std::uint32_t* start = starts(slot);
  std::fill_n(start, bands_ + 1, 0U);
  for (const std::int32_t pixel : pixels) ++start[pixel >> band_bits];
  for (std::size_t band = 1; band <= bands_; ++band) start[band] += start[band - 1];
  // Where bands end becomes where they start. First into what is in the cache: single places far away cost more.
  Small* near = near_.get() + group * piece;
  for (const std::int32_t pixel : pixels) near[--start[pixel >> band_bits]] = static_cast<Small>(pixel);
  std::copy_n(near, pixels.size(), sorted(slot));
  filled_[static_cast<std::size_t>(slot)] = 1;
}

void Bands::add_band(std::size_t band) {
  constexpr std::uint32_t full = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t* counts = counts_.data() + (band << band_bits);
  for (std::int64_t slot = 0; slot < slots_; ++slot) {
    if (filled_[static_cast<std::size_t>(slot)] == 0) continue;
    const std::uint32_t* start = starts(slot) + band;
    const Small* places = sorted(slot);
    for (std::uint32_t k = start[0]; k < start[1]; ++k) {
      std::uint32_t& count = counts[places[k]];
      count += count != full ? 1 : 0;
    }
  }
}

void Bands::add(Watch& watch) {
  constexpr std::size_t bands_a_task = 16;  // whose starts are in a line
  const auto tasks = static_cast<std::int64_t>((bands_ + bands_a_task - 1) / bands_a_task);
  constexpr std::int64_t reports = 16;
  const std::int64_t between = (tasks + reports - 1) / reports;
  for (std::int64_t done = 0; done < tasks; done += between) {
    const std::int64_t now = std::min(between, tasks - done);
    parallel_for(now, 0, [&](std::int64_t task) {
      watch.poll();
      const std::size_t first = static_cast<std::size_t>(done + task) * bands_a_task;
      for (std::size_t band = first; band < std::min(first + bands_a_task, bands_); ++band) add_band(band);
    });
    watch.report(static_cast<double>(done + now) / static_cast<double>(tasks), "points");
  }
  std::fill(filled_.begin(), filled_.end(), std::uint8_t{0});
}

}  // namespace ifsm::core
