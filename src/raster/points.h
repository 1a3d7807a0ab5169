// Points of the chaos game themselves, of the plane or of space, with the first letters of their addresses.
#pragma once

#include <cstdint>
#include <vector>

#include "base/cancel.h"
#include "system/system.h"

namespace ifsm::core {

struct ChaosPoints {
  std::vector<double> points;         // `dimension` doubles each
  std::vector<std::int32_t> letters;  // `length` each, numbers of maps
};

constexpr std::int64_t most_letters = 1 << 14;

// The points of double precision that plain::chaos_counts counts, in its order: the same seed gives the same ones on
// any number of threads and on any machine, and fewer are the first of more. Each point lies in the piece of the word
// of its letters, the map that was taken last first: x = w_i1(w_i2(… )).
ChaosPoints chaos_points(const System& system, std::uint64_t seed, std::int64_t count, std::int64_t length,
                         Watch& watch);

// The same, told where the caller wants them: `count` points, `length` letters of each; either may be NULL. After
// Cancelled anything may be there.
void tell_points(const System& system, std::uint64_t seed, std::int64_t count, double* points, std::int64_t length,
                 std::int32_t* letters, Watch& watch);

}  // namespace ifsm::core
