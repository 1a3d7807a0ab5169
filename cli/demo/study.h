// What the demo finds out about a coast, before anything is drawn.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "curves.h"

namespace demo {

// What is to be found out: known before anything is computed or written.
struct Plan {
  cli::Samples samples;
  std::vector<std::int64_t> budgets;  // how many vectors a sketch may hold, control points and details together
  std::int64_t shown_budget = 0;      // whose fit the pictures of one model show
};

// The best sketch that was found under one filter.
struct Sketch {
  std::vector<double> points;  // at the samples
  cli::Distance distance;      // from them
  std::int64_t numbers = 0;    // that a file holds: vectors, and the filter's own when it was fitted
};

struct Row {
  std::int64_t budget = 0;
  std::int64_t details = 0;
  Sketch start, fitted;
};

struct Study {
  cli::Samples samples;
  std::int64_t shown_budget = 0;
  ifsm::Model model;                   // exact, under the filter fitted at shown_budget
  std::int64_t numbers_of_filter = 0;  // the free ones of a fitted filter; a named one costs none
  std::vector<Row> rows;               // each fitted at its own budget
};

// Told a share of the work, 0 … 1, and a word for it; answers whether to stop.
using Progress = std::function<bool(double, const std::string&)>;

// Throws cli::Failure for curves that are not of the plane, or too short for any budget.
Plan plan(const std::string& path);

Study study(Plan plan, const Progress& progress);

// The table of errors, with what its columns mean.
std::string table_of(const Study& study);

}  // namespace demo
