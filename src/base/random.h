// Random numbers that are a function of a seed and a counter: no state, any order, the same bits on every platform.
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace ifsm::core {

// Philox 4x32, ten rounds. Source: J. K. Salmon et al., Parallel random numbers: as easy as 1, 2, 3, 2011.
std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key);

// Two independent standard normal numbers for each seed, stream and index, by Marsaglia's polar method. Made of sums,
// products, quotients and square roots alone, which every IEEE machine rounds alike.
std::array<double, 2> normal_pair(std::uint64_t seed, std::uint32_t stream, std::uint64_t index);

// The pairs of indices 0, 1, … one after the other, several at once; of an odd count the last one is half told.
void normal_numbers(std::uint64_t seed, std::uint32_t stream, std::span<double> numbers);

}  // namespace ifsm::core
