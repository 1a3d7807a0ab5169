#include "figures/page.h"

#include <algorithm>
#include <cmath>

namespace figures {
namespace {

// A panel's room at scale 1: what its letters are made for. Less of it is made up by smaller letters.
constexpr double panel_width = 680, panel_height = 560;
constexpr double beside = 60, above = 160;  // margins; title and note

int columns_of(std::size_t panels) { return panels == 1 ? 1 : panels == 2 || panels == 4 ? 2 : 3; }

}  // namespace

plot::Figure page_of(std::vector<plot::Panel> panels, const std::string& title, const std::string& note,
                     PageSize size) {
  plot::Figure figure;
  figure.columns = columns_of(panels.size());
  const double rows = std::ceil(static_cast<double>(panels.size()) / figure.columns);
  const double enlarged = panels.size() == 1 ? 1.7 : 1;
  const double width = beside + panel_width * enlarged * figure.columns,
               height = above + panel_height * enlarged * rows;
  // One side alone keeps the shape of the page.
  figure.width = size.width > 0    ? size.width
                 : size.height > 0 ? static_cast<int>(std::lround(size.height * width / height))
                                   : static_cast<int>(width);
  figure.height = size.height > 0  ? size.height
                  : size.width > 0 ? static_cast<int>(std::lround(size.width * height / width))
                                   : static_cast<int>(height);
  figure.width = std::max(figure.width, 1), figure.height = std::max(figure.height, 1);
  figure.scale = std::min(figure.width / width, figure.height / height);
  figure.title = title;
  figure.note = note;
  figure.panels = std::move(panels);
  return figure;
}

}  // namespace figures
