// A model whose lines are kept, once they were asked for: what a deformer reads again and again.
#pragma once

#include <memory>
#include <vector>

#include "curve/model.h"

namespace ifsm::core {

class Base {
 public:
  explicit Base(ModelPtr model);

  const ModelPtr& model() const { return model_; }
  const Shape& shape() const { return model_->shape(); }
  // All polygons of a level, from the centre; the bits of core::line(). Not for two threads at once.
  const Points& line(int level) const;

 private:
  ModelPtr model_;
  mutable std::vector<std::unique_ptr<const Points>> lines_;
};

using BasePtr = std::shared_ptr<const Base>;

}  // namespace ifsm::core
