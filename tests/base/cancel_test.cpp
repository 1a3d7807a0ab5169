#include "base/cancel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <string>
#include <thread>
#include <utility>
#include <vector>

using namespace ifsm::core;

namespace {

TEST(CancelToken, StaysRaised) {
  CancelToken token;
  EXPECT_FALSE(token.requested());
  token.request();
  token.request();
  EXPECT_TRUE(token.requested());
}

TEST(Watch, WithoutTokenAndCallbackNeverCancels) {
  Watch watch;
  EXPECT_NO_THROW(watch.poll());
  EXPECT_NO_THROW(watch.report(0.5, "stage"));
}

TEST(Watch, CancelsInEveryPollAfterTheTokenWasRaisedByAnotherThread) {
  CancelToken token;
  const Watch watch(&token, {});
  EXPECT_NO_THROW(watch.poll());
  std::thread([&] { token.request(); }).join();
  EXPECT_THROW(watch.poll(), Cancelled);
  EXPECT_THROW(watch.poll(), Cancelled);
}

TEST(Watch, AnswersARequestThatArrivesWhileItIsPolled) {
  CancelToken token;
  const Watch watch(&token, {});
  std::thread requester([&] { token.request(); });
  EXPECT_THROW(for (;;) watch.poll(), Cancelled);
  requester.join();
}

TEST(Watch, CancelsWhenTheCallbackSaysSo) {
  Watch watch(nullptr, [](double fraction, const char*) { return fraction >= 0.5; });
  EXPECT_NO_THROW(watch.report(0.25, "a"));
  EXPECT_THROW(watch.report(0.5, "b"), Cancelled);
}

TEST(Watch, TellsFractionsThatNeverGoBackNorPassOne) {
  std::vector<std::pair<double, std::string>> told;
  Watch watch(nullptr, [&](double fraction, const char* stage) {
    told.emplace_back(fraction, stage);
    return false;
  });
  for (const double fraction : {0.0, 0.5, 0.25, 1.5, 0.75}) watch.report(fraction, "s");
  const std::vector<std::pair<double, std::string>> expected = {
      {0.0, "s"}, {0.5, "s"}, {0.5, "s"}, {1.0, "s"}, {1.0, "s"}};
  EXPECT_EQ(told, expected);
}

TEST(Watch, AsksTheCallbackAgainWhileItIsPolledAndNothingIsReported) {
  int asked = 0;
  double told = 0.25;
  Watch watch(nullptr, [&](double fraction, const char* stage) {
    EXPECT_EQ(fraction, told);
    EXPECT_STREQ(stage, "s");
    return ++asked >= 3;
  });
  watch.report(0.25, "s");
  EXPECT_THROW(for (;;) watch.poll(), Cancelled);
  EXPECT_EQ(asked, 3);

  asked = 0;
  told = 0.5;
  Watch part = watch.part(0.5, 1);
  part.report(0, "s");
  EXPECT_THROW(for (;;) part.poll(), Cancelled);
  EXPECT_THROW(for (;;) watch.poll(), Cancelled) << "the whole asks as well";
}

TEST(Watch, NamesAStageBeforeTheFirstReport) {
  std::string told;
  Watch watch(nullptr, [&](double, const char* stage) {
    told = stage;
    return true;
  });
  EXPECT_THROW(for (;;) watch.poll(), Cancelled);
  EXPECT_EQ(told, "start");
}

TEST(Watch, APartIsInTheStageOfTheWholeUntilItReports) {
  std::string told;
  bool cancel = false;
  Watch whole(nullptr, [&](double, const char* stage) {
    told = stage;
    return cancel;
  });
  whole.report(0.25, "first");
  cancel = true;
  Watch part = whole.part(0.25, 1);
  EXPECT_THROW(for (;;) part.poll(), Cancelled);
  EXPECT_EQ(told, "first");
}

TEST(Watch, IsDoneWhenTheWholeIsAndNotWhenAPartIs) {
  std::vector<std::pair<double, std::string>> told;
  Watch whole(nullptr, [&](double fraction, const char* stage) {
    told.emplace_back(fraction, stage);
    return false;
  });
  Watch part = whole.part(0, 0.5);
  part.report(0.5, "first");
  part.finish();
  whole.finish();
  using Told = std::pair<double, std::string>;
  EXPECT_EQ(told, (std::vector<Told>{{0.25, "first"}, {0.5, "first"}, {1.0, "done"}}));
}

TEST(Watch, AsksTheCallbackOnItsOwnThreadAlone) {
  int asked = 0;
  const Watch watch(nullptr, [&](double, const char*) { return ++asked > 0; });
  std::thread([&] {
    const auto until = std::chrono::steady_clock::now() + std::chrono::milliseconds(150);
    while (std::chrono::steady_clock::now() < until) watch.poll();
  }).join();
  EXPECT_EQ(asked, 0);
}

TEST(Watch, APartFillsItsShareOfTheWhole) {
  std::vector<double> told;
  Watch whole(nullptr, [&](double fraction, const char*) {
    told.push_back(fraction);
    return false;
  });
  Watch first = whole.part(0.0, 0.5);
  Watch second = whole.part(0.5, 1.0);
  first.report(0.5, "first");
  first.report(1.0, "first");
  second.report(0.5, "second");
  second.report(1.0, "second");
  EXPECT_EQ(told, (std::vector<double>{0.25, 0.5, 0.75, 1.0}));
}

TEST(Watch, APartIsCancelledWithTheWhole) {
  CancelToken token;
  Watch whole(&token, {});
  Watch part = whole.part(0.0, 1.0);
  token.request();
  EXPECT_THROW(part.poll(), Cancelled);
  EXPECT_THROW(part.report(0.5, "s"), Cancelled);
}

using std::chrono::milliseconds;
using Clock = std::chrono::steady_clock;

TEST(Watch, LeavesTimeForWorkWhenItsCallbackIsSlow) {
  // Slower than the time between two questions: were it timed from its start, every poll would ask.
  constexpr auto slow = milliseconds(70);
  int asked = 0, polls_between = 0, fewest = 1 << 30;
  const Watch watch(nullptr, [&](double, const char*) {
    if (asked > 0) fewest = std::min(fewest, polls_between);
    polls_between = 0;
    std::this_thread::sleep_for(slow);
    return ++asked == 3;
  });
  EXPECT_THROW(
      for (;;) {
        watch.poll();
        ++polls_between;
      },
      Cancelled);
  EXPECT_GT(fewest, 100) << "polls are a look at the clock; 70 ms hold thousands";
}

TEST(Watch, TellsASlowCallbackOfSomeReportsAndOfEveryStage) {
  std::vector<std::string> stages;
  Watch watch(nullptr, [&](double, const char* stage) {
    stages.emplace_back(stage);
    std::this_thread::sleep_for(milliseconds(20));
    return false;
  });
  for (int k = 0; k < 1000; ++k) watch.report(k / 2000., "first");
  EXPECT_LT(stages.size(), 100u);
  watch.report(.5, "second");
  watch.finish();
  ASSERT_GE(stages.size(), 3u);
  EXPECT_EQ(stages[stages.size() - 2], "second");
  EXPECT_EQ(stages.back(), "done");
}

class Interrupted : public testing::Test {
 protected:
  ~Interrupted() override { set_interrupt(nullptr, nullptr); }
  int asked_ = 0;
  static std::int32_t third_time(void* asked) { return ++*static_cast<int*>(asked) == 3; }
};

TEST_F(Interrupted, ACallWithoutAWatchEndsWhenItsThreadsInterruptSaysSo) {
  EXPECT_NO_THROW(poll_interrupt());
  set_interrupt(third_time, &asked_);
  const auto start = Clock::now();
  EXPECT_THROW(for (;;) poll_interrupt(), Cancelled);
  EXPECT_EQ(asked_, 3);
  EXPECT_GE(Clock::now() - start, milliseconds(149)) << "it is asked now and then, not always";
  std::thread([] {
    for (int k = 0; k < 1000; ++k) {
      poll_interrupt();
      std::this_thread::sleep_for(std::chrono::microseconds(100));
    }
  }).join();
  EXPECT_EQ(asked_, 3) << "other threads have their own";
}

TEST_F(Interrupted, AWatchWithoutACallbackAsksTheInterrupt) {
  set_interrupt(third_time, &asked_);
  Watch watch;
  EXPECT_THROW(for (;;) watch.poll(), Cancelled);
  asked_ = 0;
  Watch told(nullptr, [](double, const char*) { return false; });
  const auto start = Clock::now();
  while (Clock::now() - start < milliseconds(200)) told.poll();
  EXPECT_EQ(asked_, 0);
}

TEST_F(Interrupted, LoopsOfCheapStepsPollNowAndThen) {
  set_interrupt(third_time, &asked_);
  Polled polled;
  EXPECT_THROW(for (;;) polled.step(), Cancelled);
}

}  // namespace
