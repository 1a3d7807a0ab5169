// The handle table from inside: generations, slots and growth, which no caller of the C ABI can bring to their ends.
#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <random>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "base/error.h"
#include "capi/handles.h"

namespace ifsm::core {
namespace {

std::shared_ptr<void> object(int value = 0) { return std::make_shared<int>(value); }

int value_of(const HandleTable& table, std::uint64_t id) {
  return *std::static_pointer_cast<int>(table.borrow(Kind::model, id, "model"));
}

std::string refusal(const HandleTable& table, Kind kind, std::uint64_t id) {
  try {
    table.borrow(kind, id, "it");
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Status::invalid_handle);
    EXPECT_EQ(error.argument(), "it");
    return error.what();
  }
  return "";
}

TEST(HandleTable, ReturnsTheObjectThatWasInserted) {
  HandleTable table;
  const auto first = table.insert(Kind::model, object(1));
  const auto second = table.insert(Kind::model, object(2));
  EXPECT_EQ(value_of(table, first), 1);
  EXPECT_EQ(value_of(table, second), 2);
}

TEST(HandleTable, NeverGivesAnIdOutTwice) {
  HandleTable table;
  std::set<std::uint64_t> seen;
  for (int i = 0; i < 10000; ++i) {
    const auto id = table.insert(Kind::model, object());
    ASSERT_TRUE(seen.insert(id).second);
    if (i % 3 != 0) table.remove(Kind::model, id, "model");
  }
}

TEST(HandleTable, RetiresASlotAtItsLastGeneration) {
  HandleTable table({.slots = 2, .generations = 3});
  std::vector<std::uint64_t> ids;
  for (int i = 0; i < 6; ++i) {
    ids.push_back(table.insert(Kind::model, object(i)));
    table.remove(Kind::model, ids.back(), "model");
  }
  EXPECT_THROW(table.insert(Kind::model, object()), Error);
  for (const auto id : ids) EXPECT_NE(refusal(table, Kind::model, id).find("destroyed"), std::string::npos);
}

TEST(HandleTable, IsAsItWasWhenItIsFull) {
  HandleTable table({.slots = 1, .generations = 9});
  const auto id = table.insert(Kind::model, object(5));
  const auto refused = object();
  EXPECT_THROW(table.insert(Kind::model, refused), Error);
  EXPECT_EQ(refused.use_count(), 1);
  EXPECT_EQ(value_of(table, id), 5);
  table.remove(Kind::model, id, "model");
  EXPECT_EQ(value_of(table, table.insert(Kind::model, object(6))), 6);
}

TEST(HandleTable, KeepsEveryObjectWhileItGrows) {
  HandleTable table;
  std::vector<std::uint64_t> ids;
  for (int i = 0; i < 5000; ++i) ids.push_back(table.insert(Kind::model, object(i)));
  for (int i = 0; i < 5000; ++i) ASSERT_EQ(value_of(table, ids[static_cast<std::size_t>(i)]), i);
}

TEST(HandleTable, LetsGoOfTheObjectWithItsLastShare) {
  HandleTable table;
  const auto kept = object();
  const auto id = table.insert(Kind::model, kept);
  const auto borrowed = table.borrow(Kind::model, id, "model");
  table.remove(Kind::model, id, "model");
  EXPECT_EQ(kept.use_count(), 2);  // this test's and the borrower's
}

TEST(HandleTable, SaysWhatIsWrongWithAHandle) {
  HandleTable table;
  const auto id = table.insert(Kind::filter, object());
  EXPECT_NE(refusal(table, Kind::model, 0).find("it is the null handle"), std::string::npos);
  EXPECT_NE(refusal(table, Kind::model, id).find("it is an ifsm_filter, not an ifsm_model"), std::string::npos);
  EXPECT_NE(refusal(table, Kind::model, id ^ std::uint64_t{1} << 50).find("not a handle of this library"),
            std::string::npos);
  EXPECT_NE(refusal(table, Kind::filter, id + 1).find("never given out"), std::string::npos);
  table.remove(Kind::filter, id, "filter");
  EXPECT_NE(refusal(table, Kind::filter, id).find("it is destroyed"), std::string::npos);
}

TEST(HandleTable, KnowsADestroyedHandleWhoseSlotIsInUseAgain) {
  HandleTable table;
  const auto stale = table.insert(Kind::model, object());
  table.remove(Kind::model, stale, "model");
  const auto fresh = table.insert(Kind::model, object(7));
  EXPECT_NE(refusal(table, Kind::model, stale).find("destroyed"), std::string::npos);
  EXPECT_THROW(table.remove(Kind::model, stale, "model"), Error);
  EXPECT_EQ(value_of(table, fresh), 7);
}

TEST(HandleTable, RefusesEveryIdThatDiffersInOneBit) {
  HandleTable table;
  const auto id = table.insert(Kind::model, object());
  for (int bit = 0; bit < 64; ++bit)
    EXPECT_NE(refusal(table, Kind::model, id ^ std::uint64_t{1} << bit), "") << "bit " << bit;
}

TEST(HandleTable, RefusesForgedIdsEvenWhenItIsFullOfLiveOnes) {
  HandleTable table;
  std::set<std::uint64_t> live;
  for (int i = 0; i < 5000; ++i) live.insert(table.insert(Kind::model, object()));
  std::mt19937_64 random(1);
  for (int i = 0; i < 100000; ++i) {
    const auto id = random();
    if (live.count(id) == 0) {
      ASSERT_NE(refusal(table, Kind::model, id), "") << id;
    }
  }
}

TEST(HandleTable, DoesNotKnowTheHandlesOfAnotherTable) {
  HandleTable ours;
  ours.insert(Kind::model, object());
  for (int tries = 0; tries < 3; ++tries) {  // two tables draw the same cookie once in 65536
    HandleTable theirs;
    const auto id = theirs.insert(Kind::model, object());
    if (refusal(ours, Kind::model, id).find("not a handle of this library") != std::string::npos) return;
  }
  FAIL() << "three tables with the same cookie";
}

TEST(HandleTable, LetsOneOfManyThreadsDestroyAHandle) {
  HandleTable table;
  for (int round = 0; round < 200; ++round) {
    const auto id = table.insert(Kind::model, object());
    std::atomic<int> destroyed{0};
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t)
      threads.emplace_back([&] {
        try {
          table.remove(Kind::model, id, "model");
          ++destroyed;
        } catch (const Error&) {
        }
      });
    for (auto& thread : threads) thread.join();
    ASSERT_EQ(destroyed, 1);
  }
}

TEST(HandleTable, ServesThreadsThatInsertBorrowAndRemoveAtOnce) {
  HandleTable table({.slots = 4096, .generations = 1000000});
  std::vector<std::thread> threads;
  std::atomic<int> wrong{0};
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&, t] {
      for (int i = 0; i < 5000; ++i) {
        const int value = t * 5000 + i;
        const auto id = table.insert(Kind::model, object(value));
        if (value_of(table, id) != value) ++wrong;
        table.remove(Kind::model, id, "model");
      }
    });
  for (auto& thread : threads) thread.join();
  EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace ifsm::core
