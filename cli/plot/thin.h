// Lines with no more points than can be seen.
#pragma once

#include <vector>

namespace plot {

struct Point {
  double x = 0, y = 0;
};

// The line without points that nobody can tell from their neighbours, `tolerance` apart at most: first those so near to
// the one before, then, of a graph (x never decreases), all but the first, lowest, highest and last of each column of
// that width. Every point of the line stays within `tolerance` of what is left, and the ends stay.
std::vector<Point> thinned(const std::vector<Point>& line, double tolerance);

}  // namespace plot
