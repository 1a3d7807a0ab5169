// The panels of a model, each with the numbers that it shows.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <ifsm.hpp>

#include "curves.h"
#include "plot/panel.h"
#include "report.h"

namespace figures {

struct Shown {
  plot::Panel panel;
  cli::Json numbers;
};

// The measured points, of one curve or several.
Shown samples_panel(const std::vector<cli::Samples>& curves);
// The curve of the finest level.
Shown curve_panel(const ifsm::Model& model);
// The same, and the control polygon over it.
Shown polygon_panel(const ifsm::Model& model);
// What grows from the control polygon alone: the curve's limit without details. Throws ifsm::Error when the filter's
// maps are not proven to contract.
Shown attractor_panel(const ifsm::Model& model);
// Distances from the model of its sketches, by level and by size.
Shown levels_panel(const ifsm::Model& model, const ifsm::Cancel& cancel);
Shown budgets_panel(const ifsm::Model& model, const ifsm::Cancel& cancel);
Shown scalogram_of(const ifsm::Model& model);
// Distances between two rows of samples, point by point, along the first; `title` says whose.
Shown residuals_panel(const std::vector<double>& curve, const std::vector<double>& other, int dimension, bool closed,
                      const std::string& title);

}  // namespace figures
