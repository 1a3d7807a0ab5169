#include "measure/spectrum.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "curve/significance.h"

namespace ifsm::core {
namespace {

double root_mean_square(const Eigen::VectorXd& significances, Index places) {
  return significances.stableNorm() / std::sqrt(static_cast<double>(places));
}

double implied_dimension(Index dimension, double hurst) {
  if (dimension == 1) return std::clamp(2 - hurst, 1.0, 2.0);
  const auto most = static_cast<double>(dimension);
  return hurst > 1 / most ? std::max(1 / hurst, 1.0) : most;
}

// Levels of rounding alone tell nothing: samples are known to epsilon of the curve's size, and analysis adds some.
void fit(Spectrum& told, Index dimension, double diagonal) {
  const double rounding = 4 * std::numeric_limits<double>::epsilon() * diagonal;
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> x, y;
  for (int level = told.first; level <= told.last; ++level)
    if (const auto l = static_cast<std::size_t>(level); told.rms[l] > rounding) {
      x.push_back(std::log(told.scales[l]));
      y.push_back(std::log(told.rms[l]));
    }
  const Trend line = x.size() < 3 ? Trend{none, none, none, none} : trend(x, y);
  told.hurst = line.slope;
  told.standard_error = line.standard_error;
  told.r_squared = line.r_squared;
  told.dimension = x.size() < 3 ? none : implied_dimension(dimension, line.slope);
}

}  // namespace

Spectrum spectrum(const Model& model) {
  Spectrum told{};
  const std::vector<Eigen::VectorXd> all = gains(model.filter(), model.levels());
  for (int level = 0; level < model.levels(); ++level) {
    const Eigen::VectorXd effects = significance(model, level, all[static_cast<std::size_t>(level)]);
    told.scales.push_back(std::pow(model.shape().maps(), -level));
    told.rms.push_back(root_mean_square(effects, model.placement().places()));
  }
  told.first = 2;
  told.last = model.levels() - 2;
  if (told.last - told.first < 2) told.first = 0, told.last = model.levels() - 1;
  fit(told, model.dimension(), model.parts().diagonal);
  return told;
}

}  // namespace ifsm::core
