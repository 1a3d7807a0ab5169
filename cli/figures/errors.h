// How far sketches are from the curve: by level and by budget, as numbers and drawn.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <ifsm.hpp>

#include "curves.h"
#include "plot/panel.h"

namespace figures {

struct SketchError {
  std::int64_t size = 0;     // levels, or control points and details together
  std::int64_t details = 0;  // kept
  cli::Distance apart;       // from the model, at the samples
};

// Of the first 0, 1, … levels of details, what is kept solved anew. Throws ifsm::Cancelled.
std::vector<SketchError> errors_by_level(const ifsm::Model& model, const ifsm::Cancel& cancel);

// Of 8, 16, … 1024 vectors, as far as there are details, the choice bettered and solved. Throws ifsm::Cancelled.
std::vector<SketchError> errors_by_budget(const ifsm::Model& model, const ifsm::Cancel& cancel);

// One kind of sketches: where its points are on the axis, and what a reader calls it.
struct ErrorLine {
  std::vector<double> at;
  std::vector<cli::Distance> apart;
  std::string name;  // "" when it is the only one
  plot::Colour colour;
  bool wide = false;  // drawn wider, to be seen below another one
};

// RMS and largest distances on a logarithmic axis. Distances of no more than rounding, told by `least`, are left out.
plot::Panel error_panel(const std::vector<ErrorLine>& lines, double least);

}  // namespace figures
