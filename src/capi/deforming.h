// A deformer as the handle table keeps it: with the flag of the call that uses it.
#pragma once

#include <atomic>
#include <utility>

#include "deform/deformer.h"

namespace ifsm::core {

struct Deforming {
  explicit Deforming(Deformer made) : deformer(std::move(made)) {}

  Deformer deformer;
  std::atomic_flag busy = ATOMIC_FLAG_INIT;
};

}  // namespace ifsm::core
