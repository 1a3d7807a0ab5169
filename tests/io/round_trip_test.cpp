// What is written comes back, bit for bit, and takes little room.
#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>
#include <clocale>

#include "support.h"

namespace ifsm::core::test {
namespace {

void require_round_trip(const Model& model) {
  for (const Format format : {Format::json, Format::cbor}) {
    const Bytes file = write_model(model, format);
    const ModelPtr back = read_model(file);
    RC_ASSERT(same_bits(model, *back));
    RC_ASSERT(write_model(*back, format) == file);
    RC_ASSERT(back->details_kept() == model.details_kept());
  }
}

RC_GTEST_PROP(RoundTrip, KeepsEveryBitOfAnalysedAndSketchedModels, (std::uint64_t seed)) {
  Random random(seed);
  const ModelPtr model = random_model(random);
  require_round_trip(*model);
  RC_ASSERT(same_bits(samples(*model), samples(*read_model(write_model(*model, Format::json)))));
}

RC_GTEST_PROP(RoundTrip, KeepsEveryBitOfAnyFiniteDouble, (std::uint64_t seed)) {
  Random random(seed);
  require_round_trip(*wild_model(random));
}

TEST(RoundTrip, HoldsForNamedFiltersOfEveryKind) {
  for (const char* name : {"haar", "bspline", "four-point", "koch", "takagi"}) {
    Random random(7);
    const FilterPtr filter = named_filter(name, Topology::square, 0, 0);
    const ModelPtr model = analyze(filter, random.points(2, 33, [&] { return random.number(); }), false);
    EXPECT_TRUE(same_bits(*model, *read_model(write_model(*model, Format::json)))) << name;
    EXPECT_TRUE(same_bits(*model, *read_model(write_model(*model, Format::cbor)))) << name;
  }
}

TEST(RoundTrip, HoldsForTheSmallestModels) {
  const FilterPtr haar = named_filter("haar", Topology::square, 0, 0);
  for (const bool closed : {false, true}) {
    const ModelPtr point = from_polygon(haar, Points(1, 1), closed, 0);  // one place, one sample
    EXPECT_TRUE(same_bits(*point, *read_model(write_model(*point, Format::cbor))));
  }
}

TEST(RoundTrip, ReadsDecimalsWhateverTheLocaleSays) {
  Random random(3);
  const ModelPtr model = random_model(random);
  const Bytes file = write_model(*model, Format::json);
  const std::string before = std::setlocale(LC_NUMERIC, nullptr);
  int tried = 0;
  for (const char* locale : {"de_DE.UTF-8", "ps_AF.UTF-8", "fr_FR.UTF-8"}) {
    if (std::setlocale(LC_NUMERIC, locale) == nullptr) continue;
    ++tried;
    EXPECT_TRUE(same_bits(*model, *read_model(file))) << locale;
    EXPECT_EQ(write_model(*model, Format::json), file) << locale;
  }
  std::setlocale(LC_NUMERIC, before.c_str());
  if (tried == 0) GTEST_SKIP() << "no locale with another decimal point is installed";
}

TEST(Writer, RefusesNumbersThatAreNotFinite) {
  Random random(5);
  ModelParts parts = random_model(random)->parts();
  parts.polygon.plane(0)[1] = INFINITY;
  const Model model(std::move(parts));
  for (const Format format : {Format::json, Format::cbor}) try {
      write_model(model, format);
      FAIL() << "an infinite control point was written";
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), Status::numerical);
      EXPECT_EQ(error.argument(), "control_points");
    }
}

TEST(Writer, RefusesASketchThatTheReaderWouldRefuse) {
  const FilterPtr filter = named_filter("casteljau", Topology::joined, 2, 2);
  Points polygon(4, 2);
  polygon.matrix().row(1).setOnes();
  const ModelPtr fits = from_polygon(filter, polygon, false, 23), too_deep = from_polygon(filter, polygon, false, 24);
  EXPECT_EQ(read_model(write_model(*fits, Format::cbor))->levels(), 23);
  try {
    write_model(*too_deep, Format::cbor);
    FAIL() << "2^26 doubles and more were written as a few bytes";
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Status::limit);
  }
}

// K = 32 of 4097 points, n = 5, N = 2, d = 2, L = 10. A decimal takes at most 24 characters and a comma, a double of
// CBOR 9 bytes; an index is below 4 · 2^9 = 2048, 4 digits and a comma, or 3 bytes.
TEST(Size, OfASketchIsThatOfItsFilterAndItsDetails) {
  const FilterPtr filter = named_filter("casteljau", Topology::joined, 5, 2);
  Random random(11);
  double y = 0;
  Points curve(2, 4097);
  for (Index k = 0; k < 4097; ++k)
    curve.plane(0)[static_cast<std::size_t>(k)] = static_cast<double>(k) + random.number(),
    curve.plane(1)[static_cast<std::size_t>(k)] = y += random.number();
  const ModelPtr model = analyze(filter, curve, false);
  const ModelPtr sketch = resolve(*model, most_significant(*model, 32), Watch());
  ASSERT_EQ(sketch->levels(), 10);
  ASSERT_EQ(sketch->details_kept(), 32);

  constexpr std::size_t doubles = 81 + 10 + 2 + 2 + 2 * 32, names = 300, levels = 10;
  const std::size_t json = names + doubles * 25 + 32 * 5 + levels * std::string("\n{\"at\":[],\"vectors\":[]},").size();
  const std::size_t cbor = names + doubles * 9 + 32 * 3 + levels * std::string("{at[vectors[__").size();
  EXPECT_LE(write_model(*sketch, Format::json).size(), json);
  EXPECT_LE(write_model(*sketch, Format::cbor).size(), cbor);
  RecordProperty("json", static_cast<int>(write_model(*sketch, Format::json).size()));
  RecordProperty("cbor", static_cast<int>(write_model(*sketch, Format::cbor).size()));
}

TEST(Size, OfALevelWithoutDetailsIsThatOfAnEmptyObject) {
  const FilterPtr filter = named_filter("casteljau", Topology::joined, 5, 2);
  const auto size = [&](int levels, Format format) {
    return write_model(*from_polygon(filter, Points(2, 5), false, levels), format).size();
  };
  constexpr std::size_t more_digits = 6 + 1;  // of samples and levels: 2^20 + 1 places instead of 9
  EXPECT_EQ(size(18, Format::json) - size(1, Format::json), 17 * std::string("\n{},").size() + more_digits);
  EXPECT_EQ(size(18, Format::cbor) - size(1, Format::cbor), 17 + 4u);  // samples in 5 bytes instead of 1
}

}  // namespace
}  // namespace ifsm::core::test
