#include "measure/refine.h"

#include "measure/spectrum.h"
#include "support.h"

using namespace ifsm::core;
using namespace ifsm::core::testing;

namespace {

ModelPtr walk(Random& random, Index count, Index dimension, bool closed, int n = 5, int maps = 2) {
  return analyze(casteljau(Shape(Topology::joined, n, maps)), random_curve(random, count, dimension, Kind::walk),
                 closed);
}

Refinement asked(int levels, std::uint64_t seed) {
  Refinement refinement;
  refinement.levels = levels;
  refinement.seed = seed;
  return refinement;
}

Points finest(const Model& model) { return points(model, model.levels()); }

TEST(Refinement, LeavesTheSamplesWhereTheyAreAndAtTheirParameters) {
  Random random(1);
  for (const int n : {2, 3, 5, 9})
    for (const int maps : {2, 3, 5})
      for (const Index dimension : {1, 2, 3, 4})
        for (const bool closed : {false, true}) {
          const ModelPtr model = walk(random, 150, dimension, closed, n, maps);
          const ModelPtr finer = refine(*model, asked(2, 5));
          EXPECT_EQ(finer->levels(), model->levels() + 2);
          EXPECT_EQ(finer->placement().samples(), finer->placement().places());
          std::vector<double> parameters;
          for (Index k = 0; k < 150; ++k) parameters.push_back(model->placement().parameter(k));
          EXPECT_LE(distance(evaluate(*finer, Curve::polyline, parameters), samples(*model)),
                    1e-12 * finer->parts().diagonal)  // what analysis promises
              << model->shape() << ", d = " << dimension;
          const Index step = model->shape().nodes(2);
          for (Index k = 0; k < 150; ++k)
            EXPECT_EQ(finer->placement().parameter(model->placement().place(k) * step),
                      parameters[static_cast<std::size_t>(k)]);
        }
}

TEST(Refinement, HasTheSameBitsForTheSameSeedAndOthersForOthers) {
  Random random(2);
  const ModelPtr model = walk(random, 129, 2, false);
  const Points one = finest(*refine(*model, asked(3, 1))), same = finest(*refine(*model, asked(3, 1)));
  EXPECT_EQ(one, same);
  for (const std::uint64_t seed : {std::uint64_t{2}, std::uint64_t{1} << 40})
    EXPECT_GT(distance(one, finest(*refine(*model, asked(3, seed)))), 0.01);
}

TEST(Refinement, OfNoRoughnessIsThePolylineItself) {
  Random random(3);
  for (const int maps : {2, 3}) {
    const ModelPtr model = walk(random, 100, 2, true, 4, maps);
    Refinement smooth = asked(2, 9);
    smooth.roughness = 0;
    const ModelPtr finer = refine(*model, smooth);
    std::vector<double> parameters;
    for (Index k = 0; k < finer->placement().places(); ++k) parameters.push_back(finer->placement().parameter(k));
    EXPECT_LE(distance(samples(*finer), evaluate(*model, Curve::polyline, parameters)),
              1e-12 * model->parts().diagonal);
  }
}

TEST(Refinement, OfAStraightLineIsThatLine) {
  Points line(2, 33);
  for (Index k = 0; k < 33; ++k) line.matrix().row(k) << static_cast<double>(k), 2.0 * static_cast<double>(k);
  const ModelPtr model = analyze(casteljau(Shape(Topology::joined, 3, 2)), line, false);
  const Points fine = samples(*refine(*model, asked(3, 1)));
  for (Index k = 0; k < fine.count(); ++k) EXPECT_NEAR(fine.matrix()(k, 1), 2 * fine.matrix()(k, 0), 1e-10);
}

// Mean squared displacements of the refined places, scale by scale, against what the trend said.
TEST(Refinement, IsAsRoughAtEachNewLevelAsTheTrendSays) {
  Random random(4);
  for (const int maps : {2, 3})
    for (const double roughness : {1.0, 0.5}) {
      const ModelPtr model = walk(random, 4 * (maps == 2 ? 512 : 729) + 1, 1, false, 5, maps);
      const Points coarse = finest(*model);
      const std::vector<char> known(static_cast<std::size_t>(coarse.count()), 1);
      const Texture texture = learn(coarse, known, maps, model->levels(), 4);
      constexpr int extra = 3;
      Refinement refinement = asked(extra, 11);
      refinement.roughness = roughness;
      const Points fine = finest(*refine(*model, refinement));
      double expected = texture.next * roughness * roughness;
      for (int level = 1; level <= extra; ++level, expected *= texture.decay) {
        const Index step = model->shape().nodes(extra - level), segments = (fine.count() - 1) / (step * maps);
        double sum = 0;
        for (Index s = 0; s < segments; ++s) {
          const double a = fine.matrix()(s * step * maps, 0), b = fine.matrix()((s + 1) * step * maps, 0);
          for (Index i = 1; i < maps; ++i) {
            const double share = static_cast<double>(i) / maps;
            sum += std::pow(fine.matrix()((s * maps + i) * step, 0) - (1 - share) * a - share * b, 2);
          }
        }
        // A sum of squares of normals, all of one size; correlated where there is more than one in a segment: at most
        // as if there were one.
        const double standard_error = expected * std::sqrt(2 / static_cast<double>(segments));
        EXPECT_NEAR(sum / static_cast<double>(segments), expected, 5 * standard_error) << "level " << level;
      }
    }
}

TEST(Refinement, KeepsTheHurstExponent) {
  // By midpoint displacement, so that the exponent is known.
  for (const double hurst : {0.3, 0.5, 0.7}) {
    Random random(5);
    constexpr int levels = 11;
    ModelPtr model =
        from_polygon(named_filter("casteljau", Topology::joined, 2, 2), points_of({{0}, {1}}), false, levels);
    for (int level = 0; level < levels; ++level) {
      Points details = model->details(level);
      for (double& value : details.plane(0)) value = std::pow(2, -hurst * level) * normal(random);
      model = with_details(*model, level, details, Frame::absolute);
    }
    const Spectrum told = spectrum(*refine(*model, asked(4, 3)));
    EXPECT_EQ(told.last, levels + 2);
    // The slope over fourteen levels; of its error most is that of the coarsest, a fifth at most.
    EXPECT_NEAR(told.hurst, hurst, 0.08);
    // And level by level below the old samples: within a tenth, for thousands of details.
    for (std::size_t l = levels; l < levels + 3; ++l)
      EXPECT_NEAR(told.rms[l] / told.rms[l - 1], std::pow(2, -hurst), 0.1);
  }
}

TEST(Refinement, TurnsAndScalesWithAPlaneCurve) {
  Random random(6);
  const Points curve = random_curve(random, 200, 2, Kind::walk);
  const FilterPtr filter = casteljau(Shape(Topology::joined, 4, 2));
  const double angle = 0.7, size = 40;
  Eigen::Matrix2d turn;
  turn << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  Points moved = curve;
  moved.matrix() = (size * curve.matrix() * turn.transpose()).rowwise() + Eigen::RowVector2d(300, -70);
  const Points fine = samples(*refine(*analyze(filter, curve, true), asked(3, 8)));
  const Points other = samples(*refine(*analyze(filter, moved, true), asked(3, 8)));
  Points wanted = fine;
  wanted.matrix() = (size * fine.matrix() * turn.transpose()).rowwise() + Eigen::RowVector2d(300, -70);
  EXPECT_LE(distance(other, wanted), 1e-10 * diagonal(moved));
}

TEST(Refinement, IsTheSameForCurvesOfAnySize) {
  Random random(9);
  for (const Index dimension : {1, 2, 3}) {
    const Points curve = random_curve(random, 100, dimension, Kind::walk);
    const FilterPtr filter = casteljau(Shape(Topology::joined, 4, 2));
    const Points fine = samples(*refine(*analyze(filter, curve, false), asked(2, 8)));
    for (const double size : {0x1p-900, 0x1p900}) {
      Points other = curve;
      other.matrix() *= size;
      Points told = samples(*refine(*analyze(filter, other, false), asked(2, 8)));
      told.matrix() /= size;
      EXPECT_LE(distance(told, fine), 1e-10 * diagonal(curve));
    }
  }
}

TEST(Refinement, NeverTurnsBackAlongTheSegmentThatItDivides) {
  Random random(7);
  for (const Index dimension : {2, 3})
    for (const int maps : {2, 4}) {
      const ModelPtr model = walk(random, 300, dimension, false, 4, maps);
      Refinement rough = asked(1, 4);
      rough.roughness = 2;
      const Points coarse = finest(*model), fine = finest(*refine(*model, rough));
      double moved = 0;
      for (Index s = 0; s + 1 < coarse.count(); ++s) {
        // Fine places of one segment, told along what it was; its ends are the fine polyline's own (gaps were filled).
        const Eigen::RowVectorXd a = fine.matrix().row(s * maps), way = fine.matrix().row((s + 1) * maps) - a;
        for (Index i = 0; i < maps; ++i) {
          const Eigen::RowVectorXd step = fine.matrix().row(s * maps + i + 1) - fine.matrix().row(s * maps + i);
          EXPECT_GT(step.dot(way), -1e-9 * way.squaredNorm()) << "segment " << s;
          moved += (step - way / maps).norm();
        }
      }
      EXPECT_GT(moved, 0.1 * static_cast<double>(coarse.count()));
    }
}

TEST(Refinement, IsRefusedForSquareModelsAndForSizesThatCannotBe) {
  Random random(8);
  const ModelPtr square =
      analyze(casteljau(Shape(Topology::square, 3, 2)), random_curve(random, 50, 2, Kind::walk), false);
  EXPECT_EQ(refusal([&] { refine(*square, asked(1, 0)); }).status(), Status::shape);
  const ModelPtr model = walk(random, 50, 2, false);
  for (const int levels : {0, -1, 41})
    EXPECT_EQ(refusal([&] { refine(*model, asked(levels, 0)); }).argument(), "levels");
  EXPECT_EQ(refusal([&] { refine(*model, asked(39, 0)); }).status(), Status::limit);
  Refinement wrong = asked(1, 0);
  wrong.roughness = -1;
  EXPECT_EQ(refusal([&] { refine(*model, wrong); }).argument(), "roughness");
  wrong.roughness = std::nan("");
  EXPECT_EQ(refusal([&] { refine(*model, wrong); }).status(), Status::not_finite);
  wrong.roughness = 1, wrong.learned = 0;
  EXPECT_EQ(refusal([&] { refine(*model, wrong); }).argument(), "learned");
}

TEST(Refinement, OfACurveThatIsAPointOrOfAPolygonWithoutLevelsAddsNothing) {
  const FilterPtr filter = casteljau(Shape(Topology::joined, 3, 2));
  const ModelPtr point = analyze(filter, points_of({{1, 1}, {1, 1}, {1, 1}}), false);
  const Points same = samples(*refine(*point, asked(2, 1)));
  for (Index k = 0; k < same.count(); ++k) EXPECT_EQ(same.matrix().row(k), Eigen::RowVector2d(1, 1));
  const ModelPtr bare = from_polygon(filter, points_of({{0, 0}, {1, 2}, {3, 0}}), false, 0);
  EXPECT_LE(distance(samples(*refine(*bare, asked(1, 1))), points_of({{0, 0}, {0.5, 1}, {1, 2}, {2, 1}, {3, 0}})),
            1e-12);
}

}  // namespace
