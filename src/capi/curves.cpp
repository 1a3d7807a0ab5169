#include "capi/curves.h"

#include "capi/arguments.h"

namespace ifsm::core {
namespace {

constexpr std::int64_t most_points = std::int64_t{1} << 40;

Points points_of(const ifsm_curve& curve, std::int64_t fewest, const std::string& prefix) {
  in_range(curve.dimension, 1, 4, (prefix + "dimension").c_str());
  in_range(curve.count, fewest, most_points, (prefix + "count").c_str());
  const std::string argument = prefix + "points";
  required(curve.points, argument.c_str());
  require_finite(curve.points, curve.count * curve.dimension, argument.c_str());
  return Points::from_interleaved(curve.points, curve.count, curve.dimension);
}

}  // namespace

Points samples_of(const ifsm_curve& curve, const std::string& prefix) { return points_of(curve, 2, prefix); }

Points polygon_of(const ifsm_curve& curve) { return points_of(curve, 1, ""); }

bool is_closed(const ifsm_curve& curve, const std::string& prefix) {
  return in_range(curve.closed, 0, 1, (prefix + "closed").c_str()) == 1;
}

Points points_of(const double* values, std::int64_t count, std::int64_t needed, std::int64_t dimension,
                 const char* argument) {
  required(values, argument);
  require_count(count, needed * dimension, "count");
  require_finite(values, count, argument);
  return Points::from_interleaved(values, needed, dimension);
}

}  // namespace ifsm::core
