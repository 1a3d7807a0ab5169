// Stage curve: what one iteration of Levenberg-Marquardt evaluates, 4097 points, n = 5, N = 2, its derivatives analytic
// against Ceres' automatic ones of the same formula (everything else, control points solved for and rows gathered,
// being the same); and how a fit of fixed iterations grows with its samples.
#include <benchmark/benchmark.h>
#include <ceres/jet.h>
#include <sys/resource.h>

#include <Eigen/Cholesky>

#include <vector>

#include "curve/named.h"
#include "fit/curve_problem.h"

namespace {

using namespace ifsm::core;

constexpr int n = 5, rows = 9, count = 28, controls = 10;
using Jet = ceres::Jet<double, controls + count>;

Points walk(Index samples) {
  Points points(2, samples);
  unsigned random = 1;
  const auto step = [&] {
    return static_cast<double>((random = random * 1664525U + 1013904223U) >> 8) / (1 << 24) - 0.5;
  };
  for (Index k = 1; k < points.count(); ++k)
    for (Index axis = 0; axis < 2; ++axis) points.matrix()(k, axis) = points.matrix()(k - 1, axis) + step();
  return points;
}

// Two points between which the iterations alternate, as a trial that is accepted does.
struct Setting {
  std::vector<FitCurve> curves = {{walk(4097), false}};
  CurveOptions options;
  Watch watch;
  FilterPtr filter = named_filter("casteljau", Topology::joined, n, 2);
  CurveProblem problem{curves, filter, options, watch};
  CurveState state = problem.state(filter->matrix(), {}, problem.levels()).value();
  CurveError error = problem.error(state, {}, problem.levels());
  RowMatrix matrices[2] = {filter->matrix(), moved()};

  RowMatrix moved() const {
    Eigen::VectorXd parameters = parameters_of(filter->shape(), filter->matrix(), Part::maps);
    for (Index p = 0; p < parameters.size(); ++p) parameters(p) += 1e-3 * static_cast<double>(p % 3);
    return matrix_of(filter->shape(), parameters.data(), Part::maps, filter->matrix());
  }
};

void analytic(benchmark::State& state) {
  Setting setting;
  int turn = 0;
  for (auto _ : state) {
    const RowMatrix& matrix = setting.matrices[turn ^= 1];
    benchmark::DoNotOptimize(setting.error.value(matrix));
    Normal normal(count);
    setting.error.gather(matrix, normal);
    benchmark::DoNotOptimize(normal.compressed().jacobian.data());
  }
}
BENCHMARK(analytic)->Unit(benchmark::kMillisecond);

// The polygon of a node, coordinate by coordinate, in Jets of control points and C.
struct Polygon {
  Jet at[2][n];
};

struct JetTree {
  const Setting& setting;
  Jet maps[n][rows];
  Normal& normal;
  std::size_t next = 0;

  void visit(int level, Index node, const Polygon& polygon) {
    const CurveTerm& term = setting.error.terms()[0];
    if (level == setting.problem.levels()) {
      for (; next < term.positions.size() && term.positions[next].leg < (node + 1) * (n - 1); ++next)
        add(term, polygon, term.positions[next], node * (n - 1));
      return;
    }
    Jet places[2][rows];
    for (int axis = 0; axis < 2; ++axis)
      for (int c = 0; c < rows; ++c) {
        Jet sum = polygon.at[axis][0] * maps[0][c];
        for (int i = 1; i < n; ++i) sum += polygon.at[axis][i] * maps[i][c];
        places[axis][c] = sum;
      }
    for (int child = 0; child < 2; ++child) {
      Polygon own;
      for (int axis = 0; axis < 2; ++axis)
        for (int i = 0; i < n; ++i) own.at[axis][i] = places[axis][child * (n - 1) + i];
      visit(level + 1, 2 * node + child, own);
    }
  }

  void add(const CurveTerm& term, const Polygon& polygon, const Position& position, Index first) {
    const Index leg = position.leg - first;
    for (int axis = 0; axis < 2; ++axis) {
      const Jet residual = (1 - position.fraction) * polygon.at[axis][leg] +
                           position.fraction * polygon.at[axis][leg + 1] -
                           term.target->samples(static_cast<Index>(next), axis);
      double* row = normal.row();
      for (int p = 0; p < controls + count; ++p) row[p] = residual.v(p);
      row[controls + count] = residual.a;
    }
  }
};

void automatic(benchmark::State& state) {
  Setting setting;
  const auto entries = free_entries(setting.filter->shape(), Part::maps);
  int turn = 0;
  for (auto _ : state) {
    const RowMatrix& matrix = setting.matrices[turn ^= 1];
    benchmark::DoNotOptimize(setting.error.value(matrix));
    const Lanes control = setting.error.solved(matrix)->front().control;
    Normal joint(controls + count);
    JetTree tree{setting, {}, joint};
    for (int r = 0; r < n; ++r)
      for (int c = 0; c < rows; ++c) tree.maps[r][c] = Jet(matrix(r, c));
    for (std::size_t p = 0; p < entries.size(); ++p) {
      const FreeEntry& entry = entries[p];
      tree.maps[entry.row][entry.column].v(controls + static_cast<Index>(p)) += 1;
      tree.maps[entry.opposite][entry.column].v(controls + static_cast<Index>(p)) -= 1;
    }
    Polygon root;
    for (int axis = 0; axis < 2; ++axis)
      for (int i = 0; i < n; ++i) root.at[axis][i] = Jet(control(i, axis), i * 2 + axis);
    tree.visit(0, 0, root);
    // The same elimination of the control points.
    const Eigen::MatrixXd whole = joint.product().selfadjointView<Eigen::Lower>();
    const Eigen::MatrixXd form = whole.topLeftCorner(controls, controls);
    const Eigen::MatrixXd mixed = whole.topRightCorner(controls, count + 1);
    Normal normal(count);
    normal.add(whole.bottomRightCorner(count + 1, count + 1) - mixed.transpose() * form.llt().solve(mixed));
    benchmark::DoNotOptimize(normal.compressed().jacobian.data());
  }
}
BENCHMARK(automatic)->Unit(benchmark::kMillisecond);

// Ten iterations from one start, whatever they bring.
void samples(benchmark::State& state) {
  const std::vector<FitCurve> curves = {{walk(state.range(0)), false}};
  CurveOptions options;
  options.starts = 1;
  options.iterations = 10;
  options.tolerance = 1e-300;
  for (auto _ : state) {
    Watch watch;
    benchmark::DoNotOptimize(fit_curve(curves, options, watch).final_cost);
  }
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  state.counters["peak_bytes_a_sample"] =
      static_cast<double>(used.ru_maxrss) * 1024 / static_cast<double>(state.range(0));
}
BENCHMARK(samples)->Arg(10'000)->Arg(100'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond);

}  // namespace
