// A page of panels under one title.
#pragma once

#include <string>
#include <vector>

#include "panel.h"

namespace plot {

struct Figure {
  int width = 1600;  // pixels
  int height = 1200;
  double scale = 1;  // of letters, lines and everything
  int columns = 1;
  std::string title;
  std::string note;                 // a line or two below the panels
  std::vector<double> shares = {};  // of the columns' widths; equal when empty
  std::vector<Panel> panels = {};   // row by row

  std::string bytes(Format format) const;
  Pixels pixels() const;

 private:
  void draw(Canvas& canvas) const;
};

}  // namespace plot
