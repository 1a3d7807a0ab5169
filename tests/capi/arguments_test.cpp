// Arrays, options and reports from inside, with structs as an older and a newer header would have them.
#include "capi/arguments.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <vector>

namespace ifsm::core {
namespace {

struct Older {
  std::uint32_t struct_size;
  std::int32_t levels;
};
struct Ours {
  std::uint32_t struct_size;
  std::int32_t levels;
  double threshold;
};
struct Newer {
  std::uint32_t struct_size;
  std::int32_t levels;
  double threshold;
  std::int64_t unknown;
};

template <class T>
const Ours* as_ours(const T& given) {
  return reinterpret_cast<const Ours*>(&given);
}

Status status_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.status();
  }
  return Status::ok;
}

TEST(Options, AreAllDefaultsWhenTheyAreNull) {
  const Ours read = read_options<Ours>(nullptr);
  EXPECT_EQ(read.struct_size, sizeof(Ours));
  EXPECT_EQ(read.levels, 0);
  EXPECT_EQ(read.threshold, 0);
}

TEST(Options, OfAnOlderHeaderHaveDefaultsWhereItEnds) {
  struct {
    Older known;
    double beyond;
  } given{{sizeof(Older), 7}, 99};
  const Ours read = read_options(as_ours(given));
  EXPECT_EQ(read.levels, 7);
  EXPECT_EQ(read.threshold, 0);
}

TEST(Options, OfANewerHeaderAreFineWhileWhatIsUnknownIsZero) {
  const Newer given{sizeof(Newer), 7, 2.5, 0};
  EXPECT_EQ(read_options(as_ours(given)).levels, 7);
  EXPECT_EQ(read_options(as_ours(given)).threshold, 2.5);
}

TEST(Options, OfANewerHeaderAreRefusedAtTheFirstUnknownByteThatIsSet) {
  const Newer given{sizeof(Newer), 7, 2.5, std::int64_t{1} << 16};
  try {
    read_options(as_ours(given));
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Status::options);
    EXPECT_EQ(error.index(), 18);
    EXPECT_EQ(error.value(), 1);
  }
}

TEST(Options, AreRefusedWithASizeThatNoHeaderHas) {
  Ours given{0, 7, 2.5};
  for (const std::uint32_t size : {0u, 4u, 7u, 13u, 4100u, 0xFFFFFFFFu}) {
    given.struct_size = size;
    EXPECT_EQ(status_of([&] { read_options(&given); }), Status::options) << size;
  }
}

TEST(Options, AreZeroedOverTheWholeOfTheCallersStruct) {
  Newer given{1, 2, 3, 4};
  init_options(reinterpret_cast<Ours*>(&given), sizeof(Newer));
  EXPECT_EQ(given.struct_size, sizeof(Newer));
  EXPECT_EQ(given.levels, 0);
  EXPECT_EQ(given.threshold, 0);
  EXPECT_EQ(given.unknown, 0);
}

TEST(Options, AreZeroedNoFurtherThanTheCallersStruct) {
  struct {
    Older known;
    double beyond;
  } given{{1, 2}, 99};
  init_options(reinterpret_cast<Ours*>(&given), sizeof(Older));
  EXPECT_EQ(given.known.levels, 0);
  EXPECT_EQ(given.beyond, 99);
}

TEST(Options, AreNotInitialisedAtNullNorWithAnImpossibleSize) {
  Ours given{1, 2, 3};
  EXPECT_EQ(status_of([] { init_options<Ours>(nullptr, sizeof(Ours)); }), Status::null);
  EXPECT_EQ(status_of([&] { init_options(&given, 0); }), Status::options);
  EXPECT_EQ(given.levels, 2);
}

TEST(Report, FillsWhatAnOlderHeaderKnows) {
  struct {
    Older known;
    double beyond;
  } target{{sizeof(Older), 0}, 99};
  Report(reinterpret_cast<Ours*>(&target), "info").write({0, 7, 2.5});
  EXPECT_EQ(target.known.struct_size, sizeof(Older));
  EXPECT_EQ(target.known.levels, 7);
  EXPECT_EQ(target.beyond, 99);
}

TEST(Report, LeavesAloneWhatANewerHeaderKnowsMore) {
  Newer target{sizeof(Newer), 0, 0, 5};
  Report(reinterpret_cast<Ours*>(&target), "info").write({0, 7, 2.5});
  EXPECT_EQ(target.struct_size, sizeof(Newer));
  EXPECT_EQ(target.threshold, 2.5);
  EXPECT_EQ(target.unknown, 5);
}

TEST(Report, IsRefusedWithoutAPlaceOrASize) {
  Ours target{0, 3, 4};
  EXPECT_EQ(status_of([] { Report<Ours>(nullptr, "info"); }), Status::null);
  EXPECT_EQ(status_of([&] { Report(&target, "info"); }), Status::options);
}

const std::vector<double> values{1, 2, 3};
const auto make_values = [] { return values; };

TEST(Output, TellsOnlyTheCountWhenItIsNullAndZero) {
  std::int64_t count = 0;
  deliver(3, output<double>(nullptr, 0, "points"), count, []() -> std::vector<double> { throw 1; });
  EXPECT_EQ(count, 3);
}

TEST(Output, IsUntouchedWhenItIsTooSmall) {
  double room[2] = {7, 7};
  std::int64_t count = 9;
  try {
    deliver(3, output(room, 2, "points"), count, make_values);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Status::capacity);
    EXPECT_EQ(error.argument(), "points");
    EXPECT_EQ(error.required(), 3);
  }
  EXPECT_EQ(room[0], 7);
  EXPECT_EQ(count, 9);
}

TEST(Output, IsUntouchedWhenMakingTheValuesFails) {
  double room[3] = {7, 7, 7};
  std::int64_t count = 9;
  EXPECT_THROW(deliver(3, output(room, 3, "points"), count, []() -> std::vector<double> { throw 1; }), int);
  EXPECT_EQ(room[0], 7);
  EXPECT_EQ(count, 9);
}

TEST(Output, IsWrittenNoFurtherThanNeeded) {
  double room[4] = {7, 7, 7, 7};
  std::int64_t count = 0;
  deliver(3, output(room, 4, "points"), count, make_values);
  EXPECT_EQ(count, 3);
  EXPECT_EQ(room[2], 3);
  EXPECT_EQ(room[3], 7);
}

TEST(Output, IsRefusedWhenItIsNullWithRoomOrOfNegativeRoom) {
  double room[1];
  EXPECT_EQ(status_of([] { output<double>(nullptr, 1, "points"); }), Status::null);
  EXPECT_EQ(status_of([&] { output(room, -1, "points"); }), Status::range);
}

TEST(Input, MayBeNullOnlyWhenItIsEmpty) {
  const double one = 1;
  EXPECT_EQ(status_of([] { input<double>(nullptr, 0, "values", "count"); }), Status::ok);
  EXPECT_EQ(status_of([] { input<double>(nullptr, 1, "values", "count"); }), Status::null);
  EXPECT_EQ(status_of([&] { input(&one, -1, "values", "count"); }), Status::range);
}

}  // namespace
}  // namespace ifsm::core
