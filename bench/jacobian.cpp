// The sparse objective with its Jacobian, 4097 points, n = 5, N = 2: analytic against Ceres' automatic derivatives of
// the same formula, both gathered into the same normal matrix; and a whole fit.
#include <benchmark/benchmark.h>
#include <ceres/jet.h>

#include <cmath>
#include <vector>

#include "curve/named.h"
#include "fit/parameters.h"
#include "fit/sparse.h"
#include "fit/sparsity.h"

namespace {

using namespace ifsm::core;

constexpr int n = 5, rows = 9, d = 4, count = 56;
using Jet = ceres::Jet<double, count>;

Points walk() {
  Points points(2, 4097);
  unsigned random = 1;
  const auto step = [&] {
    return static_cast<double>((random = random * 1664525U + 1013904223U) >> 8) / (1 << 24) - 0.5;
  };
  for (Index k = 1; k < points.count(); ++k)
    for (Index axis = 0; axis < 2; ++axis) points.matrix()(k, axis) = points.matrix()(k - 1, axis) + step();
  return points;
}

struct Setting {
  FilterPtr filter = named_filter("casteljau", Topology::joined, n, 2);
  ModelPtr model = analyze(filter, walk(), false);
  Points finest = line(*model, model->levels());
  double scale = 2.0;
  Watch watch;
};

void analytic(benchmark::State& state) {
  Setting setting;
  Sparsity objective(setting.filter->shape(), {{&setting.finest, setting.model->levels(), {setting.scale}}},
                     setting.watch);
  for (auto _ : state) {
    Normal normal(count);
    objective.gather(setting.filter->matrix(), normal);
    benchmark::DoNotOptimize(normal.product().data());
  }
}
BENCHMARK(analytic)->Unit(benchmark::kMillisecond);

// R^-1 by Gauss-Jordan, in Jets.
using Square = std::vector<std::vector<Jet>>;
Square inverted(Square a) {
  Square b(rows, std::vector<Jet>(rows, Jet(0)));
  for (std::size_t i = 0; i < rows; ++i) b[i][i] = Jet(1);
  for (std::size_t i = 0; i < rows; ++i) {
    std::size_t pivot = i;
    for (std::size_t r = i; r < rows; ++r)
      if (std::abs(a[r][i].a) > std::abs(a[pivot][i].a)) pivot = r;
    std::swap(a[i], a[pivot]);
    std::swap(b[i], b[pivot]);
    const Jet scale = Jet(1) / a[i][i];
    for (std::size_t c = 0; c < rows; ++c) a[i][c] *= scale, b[i][c] *= scale;
    for (std::size_t r = 0; r < rows; ++r) {
      if (r == i) continue;
      const Jet factor = a[r][i];
      for (std::size_t c = 0; c < rows; ++c) a[r][c] -= factor * a[i][c], b[r][c] -= factor * b[i][c];
    }
  }
  return b;
}

Square jet_matrix(const Shape& shape, const RowMatrix& matrix) {
  Square r(rows, std::vector<Jet>(rows));
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t j = 0; j < rows; ++j) r[i][j] = Jet(matrix(static_cast<Index>(i), static_cast<Index>(j)));
  const auto entries = free_entries(shape);
  for (std::size_t p = 0; p < entries.size(); ++p) {
    const auto column = static_cast<std::size_t>(entries[p].column);
    r[static_cast<std::size_t>(entries[p].row)][column].v(static_cast<Index>(p)) += 1;
    if (entries[p].opposite >= 0)
      r[static_cast<std::size_t>(entries[p].opposite)][column].v(static_cast<Index>(p)) -= 1;
  }
  return r;
}

std::vector<std::vector<Jet>> jet_gains(const Square& r, int levels) {
  std::vector<std::vector<Jet>> gains(static_cast<std::size_t>(levels), std::vector<Jet>(d));
  Square gram(n, std::vector<Jet>(n, Jet(0)));
  for (std::size_t i = 0; i + 1 < n; ++i) gram[i][i] = Jet(1);
  for (std::size_t level = gains.size(); level-- > 0;) {
    Square whole(rows, std::vector<Jet>(rows, Jet(0)));
    for (std::size_t child = 0; child < 2; ++child)
      for (std::size_t a = 0; a < rows; ++a)
        for (std::size_t b = 0; b < rows; ++b)
          for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j < n; ++j) whole[a][b] += r[a][child * 4 + i] * gram[i][j] * r[b][child * 4 + j];
    for (std::size_t j = 0; j < d; ++j) gains[level][j] = sqrt(whole[n + j][n + j]);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) gram[i][j] = whole[i][j];
  }
  return gains;
}

void automatic(benchmark::State& state) {
  Setting setting;
  const Shape shape = setting.filter->shape();
  for (auto _ : state) {
    Normal normal(count);
    const Square r = jet_matrix(shape, setting.filter->matrix()), inverse = inverted(r);
    const auto gains = jet_gains(r, setting.model->levels());
    std::vector<Jet> fine[2];
    for (Index axis = 0; axis < 2; ++axis)
      for (const double value : setting.finest.plane(axis)) fine[axis].emplace_back(value);
    for (int level = setting.model->levels() - 1; level >= 0; --level) {
      std::vector<Jet> coarse[2];
      for (auto& line : coarse) line.resize(static_cast<std::size_t>(shape.line_length(level)));
      for (std::size_t node = 0; node < static_cast<std::size_t>(shape.nodes(level)); ++node) {
        Jet value[2][rows];
        for (std::size_t axis = 0; axis < 2; ++axis)
          for (std::size_t k = 0; k < rows; ++k) {
            Jet sum(0);
            for (std::size_t c = 0; c < rows; ++c)  // at the finest level the samples are constants, as Ceres sees them
              sum += level + 1 == setting.model->levels() ? inverse[c][k] * fine[axis][node * 8 + c].a
                                                          : inverse[c][k] * fine[axis][node * 8 + c];
            value[axis][k] = sum;
            if (k < n) coarse[axis][node * 4 + k] = sum;
          }
        for (std::size_t j = 0; j < d; ++j) {
          const Jet& g = gains[static_cast<std::size_t>(level)][j];
          const Jet x = value[0][n + j] * g / setting.scale, y = value[1][n + j] * g / setting.scale;
          const Jet q = x * x + y * y;
          const Jet weight = q.a > 0 ? sqrt(log(Jet(1) + q) / q) : Jet(1);
          for (const Jet& residual : {x * weight, y * weight}) {
            double* row = normal.row();
            for (Index p = 0; p < count; ++p) row[p] = residual.v(p);
            row[count] = residual.a;
          }
        }
      }
      for (std::size_t axis = 0; axis < 2; ++axis) fine[axis].swap(coarse[axis]);
    }
    benchmark::DoNotOptimize(normal.product().data());
  }
}
BENCHMARK(automatic)->Unit(benchmark::kMillisecond);

void whole_fit(benchmark::State& state) {
  FitOptions options;
  options.budgets = {state.range(0)};
  const std::vector<FitCurve> curves = {{walk(), false}};
  for (auto _ : state) {
    Watch watch;
    benchmark::DoNotOptimize(fit_sparse(curves, options, watch).iterations);
  }
}
BENCHMARK(whole_fit)->Arg(32)->Arg(128)->Arg(512)->Unit(benchmark::kMillisecond);

}  // namespace
