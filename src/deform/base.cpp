#include "deform/base.h"

#include <utility>

namespace ifsm::core {

Base::Base(ModelPtr model) : model_(std::move(model)), lines_(static_cast<std::size_t>(model_->levels()) + 1) {}

const Points& Base::line(int level) const {
  auto& kept = lines_[static_cast<std::size_t>(level)];
  if (!kept) kept = std::make_unique<const Points>(core::line(*model_, level));
  return *kept;
}

}  // namespace ifsm::core
