// Silence of Ceres, which logs even when told to be silent.
#pragma once

namespace ifsm::core {

// While one lives, anywhere in the process, nothing below a fatal fault is logged. Any thread.
class Quiet {
 public:
  Quiet();
  ~Quiet();
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;
};

}  // namespace ifsm::core
