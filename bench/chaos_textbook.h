// The chaos game as every textbook has it: one orbit in double precision. Compiled with -O3 -march=native.
#pragma once

#include <cstdint>
#include <vector>

struct TextbookMap {
  double a, b, c, d, e, f;  // x' = a x + b y + e, y' = c x + d y + f
  double until;             // the sum of the probabilities up to this map's
};

struct TextbookWindow {
  double left, top, columns_per_unit, rows_per_unit;
  std::int64_t width, height;
};

// counts: width · height.
void textbook_chaos(const std::vector<TextbookMap>& maps, const TextbookWindow& window, std::int64_t points,
                    std::uint32_t* counts);
