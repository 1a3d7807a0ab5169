// A deformer as the handle table keeps it: with the flag of the call that uses it.
#pragma once

#include <atomic>
#include <utility>

#include "deform/deformer.h"

namespace ifsm::core {

struct Deforming {
  Deforming(ModelPtr model, const Manner& manner) : deformer(std::move(model), manner) {}

  Deformer deformer;
  std::atomic_flag busy = ATOMIC_FLAG_INIT;
};

}  // namespace ifsm::core
