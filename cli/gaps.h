// Gaps in measured curves: points of which a coordinate is not known (NaN).
#pragma once

#include <cstddef>
#include <vector>

namespace cli {

// What becomes of a curve with gaps.
enum class Gaps { Refused, Split, Bridged };

// The curve cut at its gaps. A ring that has any falls into open pieces; the last of them runs through the point where
// the ring begins. Without a gap there is one piece, as closed as it was.
struct Split {
  std::vector<std::vector<double>> pieces;  // of two points or more
  bool closed = false;
  std::size_t gaps = 0;     // runs of unknown points
  std::size_t singles = 0;  // points that stand alone between gaps, and were left out
};
Split split_at_gaps(const std::vector<double>& points, std::size_t dimension, bool closed);

// The curve with its gaps filled: as many points as were missing, evenly spaced on the straight line across, so that a
// point keeps its place in the row. Gaps at the ends of an open curve lead nowhere and are cut off.
struct Bridge {
  std::vector<double> points;  // empty when no point is known
  std::size_t gaps = 0;
  std::size_t filled = 0;   // points
  std::size_t cut_off = 0;  // points
};
Bridge bridge_gaps(std::vector<double> points, std::size_t dimension, bool closed);

}  // namespace cli
