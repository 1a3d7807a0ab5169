// The barrier and the record from inside: every exception becomes a status, and none gets out.
#include "capi/record.h"

#include <gtest/gtest.h>

#include <cmath>
#include <new>
#include <stdexcept>
#include <string>
#include <thread>

#include "base/cancel.h"
#include "base/error.h"
#include "capi/guarded.h"
#include "capi/log.h"

namespace ifsm::core {
namespace {

template <class Exception>
ifsm_status fail_with(const Exception& exception) {
  return guarded("the_function", [&] { throw exception; });
}

TEST(Barrier, LetsSuccessThroughAndLeavesTheRecord) {
  fail_with(Error(Status::range, "level", "Earlier."));
  EXPECT_EQ(guarded("another", [] {}), IFSM_OK);
  EXPECT_STREQ(last_record().message, "Earlier.");
}

TEST(Barrier, RecordsEverythingThatAnErrorSays) {
  EXPECT_EQ(fail_with(Error(Status::capacity, "points", "Too small.").at(3).with(2.5).needs(12)), IFSM_ERROR_CAPACITY);
  const ifsm_error& told = last_record();
  EXPECT_EQ(told.status, IFSM_ERROR_CAPACITY);
  EXPECT_STREQ(told.function, "the_function");
  EXPECT_STREQ(told.argument, "points");
  EXPECT_EQ(told.index, 3);
  EXPECT_EQ(told.value, 2.5);
  EXPECT_EQ(told.required, 12);
  EXPECT_STREQ(told.message, "Too small.");
}

TEST(Barrier, ClearsWhatTheLastFailureSaidMore) {
  fail_with(Error(Status::capacity, "points", "Too small.").at(3).with(2.5).needs(12));
  fail_with(Error(Status::null, "model", "Null."));
  EXPECT_EQ(last_record().index, -1);
  EXPECT_TRUE(std::isnan(last_record().value));
  EXPECT_EQ(last_record().required, -1);
}

TEST(Barrier, TurnsEveryOtherExceptionIntoAStatus) {
  EXPECT_EQ(fail_with(Cancelled{}), IFSM_ERROR_CANCELLED);
  EXPECT_EQ(fail_with(std::bad_alloc()), IFSM_ERROR_MEMORY);
  EXPECT_EQ(fail_with(std::runtime_error("a fault")), IFSM_ERROR_INTERNAL);
  EXPECT_NE(std::string(last_record().message).find("a fault"), std::string::npos);
  EXPECT_EQ(fail_with(42), IFSM_ERROR_INTERNAL);
}

TEST(Barrier, LogsAFaultOfTheLibrary) {
  std::string logged;
  set_log_sink(
      [](void* user, std::int32_t level, const char* text) {
        EXPECT_EQ(level, 1);
        *static_cast<std::string*>(user) += text;
      },
      &logged);
  fail_with(std::runtime_error("a fault"));
  set_log_sink(nullptr, nullptr);
  EXPECT_NE(logged.find("a fault"), std::string::npos);
}

TEST(Barrier, SurvivesALogSinkThatThrows) {
  set_log_sink([](void*, std::int32_t, const char*) { throw 1; }, nullptr);
  EXPECT_EQ(fail_with(std::runtime_error("a fault")), IFSM_ERROR_INTERNAL);
  set_log_sink(nullptr, nullptr);
}

TEST(Record, KeepsMessagesOfAnyLength) {
  const std::string sentence(100000, 'x');
  fail_with(Error(Status::range, "level", sentence));
  EXPECT_EQ(last_record().message, sentence);
}

TEST(Record, KeepsItsStringsUntilTheNextFailure) {
  fail_with(Error(Status::range, "level", std::string(1000, 'x')));
  const char* message = last_record().message;
  for (int i = 0; i < 100; ++i) guarded("fine", [] {});
  EXPECT_EQ(message, std::string(1000, 'x'));
}

TEST(Record, BelongsToItsThread) {
  fail_with(Error(Status::range, "level", "Ours."));
  std::thread([] {
    EXPECT_EQ(last_record().status, IFSM_OK);
    fail_with(Error(Status::shape, "count", "Theirs."));
    EXPECT_STREQ(last_record().message, "Theirs.");
  }).join();
  EXPECT_STREQ(last_record().message, "Ours.");
}

TEST(Record, TellsTheOuterFailureAfterACallbackFailedToo) {
  guarded("outer", [] {
    guarded("inner", [] { throw Error(Status::null, "inner", "Inner."); });
    throw Error(Status::range, "outer", "Outer.");
  });
  EXPECT_STREQ(last_record().function, "outer");
  EXPECT_STREQ(last_record().message, "Outer.");
}

}  // namespace
}  // namespace ifsm::core
