#include "raster/points.h"

#include "base/error.h"
#include "raster/orbits.h"
#include "support.h"
#include "system/address.h"
#include "system/moments.h"

using namespace ifsm::core;
using namespace ifsm::core::testing;

namespace {

ChaosPoints told(const System& system, std::uint64_t seed, std::int64_t count, std::int64_t length = 0) {
  Watch watch;
  return chaos_points(system, seed, count, length, watch);
}

Vector3 point(const System& system, const ChaosPoints& all, std::size_t k) {
  const auto d = static_cast<std::size_t>(system.dimension());
  Vector3 x = Vector3::Zero();
  for (std::size_t i = 0; i < d; ++i) x(static_cast<Eigen::Index>(i)) = all.points[k * d + i];
  return x;
}

std::vector<std::int64_t> word(const ChaosPoints& all, std::size_t k, std::size_t length) {
  const auto first = all.letters.begin() + static_cast<std::ptrdiff_t>(k * length);
  return {first, first + static_cast<std::ptrdiff_t>(length)};
}

constexpr double eps = std::numeric_limits<double>::epsilon();

TEST(ChaosPoints, AreThoseThatTheChaosGameCounts) {
  for (const char* name : {"fern", "gasket", "tree_type1_with_dummy"}) {
    const auto system = named_system(name);
    const Window window = around(*system, 300, 200);
    constexpr std::int64_t count = (2 << 20) + 77;
    const ChaosPoints all = told(*system, 4, count);
    std::vector<std::uint32_t> pixels(static_cast<std::size_t>(window.pixels()) + 1);
    for (std::size_t k = 0; k < count; ++k)
      ++pixels[static_cast<std::size_t>(Grid(window).pixel(all.points[2 * k], all.points[2 * k + 1]))];
    pixels.pop_back();
    EXPECT_EQ(pixels, plain::chaos_counts(*system, window, 4, count).pixels) << name;
  }
}

TEST(ChaosPoints, AreTheFirstOfMoreAndDoNotDependOnTheirLetters) {
  for (const char* name : {"fern", "fern_3d"}) {
    const auto system = named_system(name);
    const auto d = static_cast<std::size_t>(system->dimension());
    const ChaosPoints all = told(*system, 2, 1 << 18, 3);
    for (const std::int64_t count : {1, 63, 64, 65, 5000}) {
      const ChaosPoints few = told(*system, 2, count, 1);
      const auto n = static_cast<std::size_t>(count);
      ASSERT_EQ(few.points.size(), n * d);
      ASSERT_EQ(few.letters.size(), n);
      EXPECT_TRUE(std::equal(few.points.begin(), few.points.end(), all.points.begin())) << name << " " << count;
      for (std::size_t k = 0; k < n; ++k) ASSERT_EQ(few.letters[k], all.letters[3 * k]);
    }
    EXPECT_EQ(told(*system, 2, 5000).points, told(*system, 2, 5000, 7).points);
    EXPECT_NE(told(*system, 2, 5000).points, told(*system, 3, 5000).points);
  }
}

TEST(ChaosPoints, LieInThePieceOfTheirLettersAndFollowOneAnother) {
  constexpr std::size_t count = 2000, length = 24;
  for (const char* name : {"fern", "gasket", "twin_dragon", "tree_type1_with_dummy", "fern_cyclosorus", "sponge",
                           "tetrahedron", "fern_3d"}) {
    const auto system = named_system(name);
    const ChaosPoints all = told(*system, 1, count, length);
    const Ellipsoid& whole = system->enclosure();
    const double size = whole.centre.norm() + whole.axes.norm();
    for (std::size_t k = 0; k < count; ++k) {
      const Vector3 x = point(*system, all, k);
      const auto letters = word(all, k, length);
      for (const std::int64_t letter : letters)
        ASSERT_GT(system->probabilities()[static_cast<std::size_t>(letter)], 0) << name;
      // Both lie in w_θ(enclosure), whose diameter is twice its longest axis; an orbit's rounding, some eps a step,
      // shrinks as the maps do: 32 eps are more than that comes to for maps that are shorter than .9.
      const double piece = 2 * stretch(word_map(*system, letters).linear * whole.axes);
      ASSERT_LE((x - point_of(*system, letters, 1)).norm(), piece + 32 * eps * size) << name << " " << k;
      if (k < orbit_count) continue;
      const Vector3 before = point(*system, all, k - orbit_count);
      ASSERT_LE((x - system->maps()[static_cast<std::size_t>(letters[0])](before)).norm(), 8 * eps * size) << name;
      const auto letters_before = word(all, k - orbit_count, length);
      ASSERT_TRUE(std::equal(letters.begin() + 1, letters.end(), letters_before.begin())) << name << " " << k;
    }
  }
}

TEST(ChaosPoints, HaveAnExactAddressOfAllLetters) {
  // As many letters as there are ever steps before a chunk's first point, and one map for ever after them.
  for (const char* name : {"fern", "gasket", "tetrahedron"}) {
    const auto system = named_system(name);
    constexpr std::size_t count = 200, length = most_letters;
    const ChaosPoints all = told(*system, 3, count, length);
    const double size = system->enclosure().centre.norm() + system->enclosure().axes.norm();
    for (std::size_t k = 0; k < count; k += 13) {
      const auto letters = word(all, k, length);
      EXPECT_EQ(letters.back(), Start(*system).letter);
      EXPECT_LE((point(*system, all, k) - point_of(*system, letters, 1)).norm(), 32 * eps * size) << name << " " << k;
    }
  }
}

// Means of x, y, …, xx, xy, … about a point, in the order of monomials().
template <int d>
std::vector<double> mean_moments(const std::vector<double>& points, const Vector3& about) {
  using Point = Eigen::Matrix<double, d, 1>;
  const Point centre = about.head<d>();
  Point first = Point::Zero();
  Eigen::Matrix<double, d, d> second = Eigen::Matrix<double, d, d>::Zero();
  const std::size_t count = points.size() / d;
  for (std::size_t k = 0; k < count; ++k) {
    const Point x = Point(&points[k * d]) - centre;
    first += x;
    second.noalias() += x * x.transpose();
  }
  std::vector<double> means;
  for (int i = 0; i < d; ++i) means.push_back(first(i) / static_cast<double>(count));
  for (int i = 0; i < d; ++i)
    for (int j = i; j < d; ++j) means.push_back(second(i, j) / static_cast<double>(count));
  return means;
}

// Means of batches that have nothing in common tell by how they differ how far theirs may be from the measure's.
void expect_exact_moments(const System& system, std::int64_t points, const std::string& name) {
  constexpr int batches = 64, most_errors = 5;
  const auto exact_mean = moments(system, 1, Vector3::Zero());
  Vector3 about = Vector3::Zero();
  for (int i = 0; i < system.dimension(); ++i) about(i) = exact_mean[static_cast<std::size_t>(i) + 1];
  const auto exact = moments(system, 2, about);
  std::vector<std::vector<double>> means;
  for (int batch = 0; batch < batches; ++batch) {
    const auto seed = 100 + static_cast<std::uint64_t>(batch);
    const ChaosPoints all = told(system, seed, (points + batches - 1) / batches);
    means.push_back(system.dimension() == 2 ? mean_moments<2>(all.points, about) : mean_moments<3>(all.points, about));
  }
  const double size = system.enclosure().axes.norm();
  for (std::size_t m = 0; m < means[0].size(); ++m) {
    double mean = 0, square = 0;
    for (const auto& batch : means) mean += batch[m] / batches;
    for (const auto& batch : means) square += std::pow(batch[m] - mean, 2) / (batches - 1);
    const double error = std::sqrt(square / batches);
    // What is flat has no error but rounding's.
    EXPECT_LE(std::abs(mean - exact[m + 1]), most_errors * error + 64 * eps * size * size) << name << " " << m;
    EXPECT_LE(error, size * size * 100 / std::sqrt(static_cast<double>(points))) << name << ": nothing was tested";
  }
}

TEST(ChaosPoints, HaveTheExactMomentsInAHundredMillion) {
  for (const char* name : {"fern", "gasket"}) expect_exact_moments(*named_system(name), 100'000'000, name);
}

TEST(ChaosPoints, HaveTheExactMomentsInThePlaneAndInSpace) {
  for (const char* name : {"twin_dragon", "maple_leaf", "sponge", "tetrahedron", "fern_3d"})
    expect_exact_moments(*named_system(name), 5'000'000, name);
  Random random(31);
  for (int k = 0; k < 6; ++k)
    expect_exact_moments(random_system(random, 2 + k % 2, .9), 1'000'000, "random " + std::to_string(k));
}

TEST(ChaosPoints, OfAPlaneInSpaceAreThePlanes) {
  const auto fern = named_system("fern");
  const System lifted = embedded(*fern);
  const ChaosPoints flat = told(*fern, 1, 100'000, 2), space = told(lifted, 1, 100'000, 2);
  EXPECT_EQ(flat.letters, space.letters);
  // They begin at the same point but for rounding, and the third coordinate adds exact zeros.
  for (std::size_t k = 0; k < 100'000; ++k)
    ASSERT_LE((point(*fern, flat, k) - point(lifted, space, k)).norm(), 64 * eps * fern->enclosure().axes.norm());
  expect_exact_moments(lifted, 1'000'000, "fern in space");
}

TEST(ChaosPoints, RefusesByName) {
  const auto argument = [](const System& system, std::int64_t count, std::int64_t length) {
    try {
      told(system, 1, count, length);
    } catch (const Error& error) {
      return error.argument();
    }
    return std::string("none");
  };
  const auto fern = named_system("fern");
  EXPECT_EQ(argument(*fern, 0, 0), "count");
  EXPECT_EQ(argument(*fern, (std::int64_t{1} << 40) + 1, 0), "count");
  EXPECT_EQ(argument(*fern, 1, -1), "length");
  EXPECT_EQ(argument(*fern, 1, most_letters + 1), "length");
  EXPECT_EQ(argument(*fern, 1, most_letters), "none");
  EXPECT_EQ(argument(System(2, {plane(2, 0, 0, 2, 0, 0)}), 1, 0), "system");
}

}  // namespace
