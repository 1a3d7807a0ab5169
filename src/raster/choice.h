// Which map is taken next, from 32 random bits: Walker's alias method, in tables that fit vector registers.
#pragma once

#include <cstdint>
#include <vector>

#include "system/system.h"

namespace ifsm::core {

// The first `bits` random bits are a slot; those that follow decide between the map of the slot's number and another.
// Probabilities are met within 2^-31.
class Choice {
 public:
  // Of so many probabilities; the slots are as many as the smallest power of two that holds them, 2 at least.
  explicit Choice(const std::vector<double>& probabilities);

  int bits() const { return bits_; }
  std::size_t slots() const { return other_.size(); }
  // Of each slot: the part of 2^31 that is its own map's, and which map has the rest.
  const std::vector<std::int32_t>& share() const { return share_; }
  const std::vector<std::int32_t>& other() const { return other_; }

  int operator()(std::uint32_t random) const {
    const std::size_t slot = random >> (32 - bits_);
    const auto rest = static_cast<std::int32_t>((random << bits_) >> 1);
    return rest < share_[slot] ? static_cast<int>(slot) : other_[slot];
  }

 private:
  int bits_;
  std::vector<std::int32_t> share_, other_;
};

}  // namespace ifsm::core
