#include "fit/quiet.h"

namespace ifsm::core {

// A Ceres without glog logs by a small copy of its own, whose level is set when it is compiled (scripts/wheel).
Quiet::Quiet() = default;
Quiet::~Quiet() = default;

}  // namespace ifsm::core
