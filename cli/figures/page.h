// Several panels on a page whose letters and lines suit its size.
#pragma once

#include <string>
#include <vector>

#include "plot/figure.h"

namespace figures {

struct PageSize {
  int width = 0;  // pixels; 0 for what suits the panels, here and below
  int height = 0;
};

plot::Figure page_of(std::vector<plot::Panel> panels, const std::string& title, const std::string& note, PageSize size);

}  // namespace figures
