// Cancel tokens; and, since they are the simplest noun, what handles promise through the C ABI.
#include "support.h"

#include <atomic>
#include <random>
#include <string>
#include <thread>
#include <vector>

namespace {

ifsm_cancel new_token() {
  ifsm_cancel token{};
  EXPECT_EQ(ifsm_cancel_create(&token), IFSM_OK);
  return token;
}

TEST(Cancel, IsRequestedOnceAndForAll) {
  const ifsm_cancel token = new_token();
  int32_t requested = -1;
  WORKS(ifsm_cancel_requested(token, &requested));
  EXPECT_EQ(requested, 0);
  WORKS(ifsm_cancel_request(token));
  WORKS(ifsm_cancel_request(token));
  WORKS(ifsm_cancel_requested(token, &requested));
  EXPECT_EQ(requested, 1);
  WORKS(ifsm_cancel_destroy(token));
}

TEST(Cancel, RefusesNullPointers) {
  const ifsm_cancel token = new_token();
  FAILS(ifsm_cancel_create(nullptr), IFSM_ERROR_NULL, "cancel");
  FAILS(ifsm_cancel_requested(token, nullptr), IFSM_ERROR_NULL, "requested");
  WORKS(ifsm_cancel_destroy(token));
}

TEST(Handle, ThatIsNullMayBeDestroyedButNotUsed) {
  const ifsm_cancel null{};
  WORKS(ifsm_cancel_destroy(null));
  FAILS(ifsm_cancel_request(null), IFSM_ERROR_INVALID_HANDLE, "cancel");
}

TEST(Handle, ThatIsDestroyedIsRefusedByEveryCall) {
  const ifsm_cancel token = new_token();
  WORKS(ifsm_cancel_destroy(token));
  int32_t requested = -1;
  FAILS(ifsm_cancel_requested(token, &requested), IFSM_ERROR_INVALID_HANDLE, "cancel");
  FAILS(ifsm_cancel_destroy(token), IFSM_ERROR_INVALID_HANDLE, "cancel");
  EXPECT_NE(std::string(last_error().message).find("destroyed"), std::string::npos);
  EXPECT_EQ(requested, -1);
}

TEST(Handle, ThatIsStaleDoesNotReachTheObjectInItsPlace) {
  const ifsm_cancel stale = new_token();
  WORKS(ifsm_cancel_destroy(stale));
  const ifsm_cancel fresh = new_token();
  FAILS(ifsm_cancel_request(stale), IFSM_ERROR_INVALID_HANDLE, "cancel");
  FAILS(ifsm_cancel_destroy(stale), IFSM_ERROR_INVALID_HANDLE, "cancel");
  int32_t requested = -1;
  WORKS(ifsm_cancel_requested(fresh, &requested));
  EXPECT_EQ(requested, 0);
  WORKS(ifsm_cancel_destroy(fresh));
}

TEST(Handle, ThatIsForgedIsRefused) {
  const ifsm_cancel token = new_token();
  std::mt19937_64 random(2);
  for (int i = 0; i < 100000; ++i) {
    const ifsm_cancel forged{random()};
    if (forged.id == token.id) continue;
    ASSERT_EQ(ifsm_cancel_request(forged), IFSM_ERROR_INVALID_HANDLE);
    ASSERT_EQ(ifsm_cancel_destroy(forged), IFSM_ERROR_INVALID_HANDLE);
  }
  int32_t requested = -1;
  WORKS(ifsm_cancel_requested(token, &requested));
  EXPECT_EQ(requested, 0);
  WORKS(ifsm_cancel_destroy(token));
}

TEST(Handle, OfAnotherKindIsRefusedAndBothKindsAreNamed) {
  const ifsm_cancel token = new_token();
  ifsm_model_info info{};
  info.struct_size = sizeof info;
  FAILS(ifsm_model_describe(ifsm_model{token.id}, &info), IFSM_ERROR_INVALID_HANDLE, "model");
  EXPECT_NE(std::string(last_error().message).find("is an ifsm_cancel, not an ifsm_model"), std::string::npos);
  FAILS(ifsm_model_destroy(ifsm_model{token.id}), IFSM_ERROR_INVALID_HANDLE, "model");
  WORKS(ifsm_cancel_destroy(token));
}

TEST(Handle, MayBeDestroyedWhileOtherThreadsUseIt) {
  for (int round = 0; round < 100; ++round) {
    const ifsm_cancel token = new_token();
    std::atomic<int> odd{0};
    std::vector<std::thread> users;
    for (int t = 0; t < 3; ++t)
      users.emplace_back([&] {
        ifsm_status status = IFSM_OK;
        while (status == IFSM_OK) status = ifsm_cancel_request(token);
        if (status != IFSM_ERROR_INVALID_HANDLE) ++odd;
      });
    WORKS(ifsm_cancel_destroy(token));
    for (auto& user : users) user.join();
    ASSERT_EQ(odd, 0);
  }
}

// A curve without details, whose questions take long: 2^22 + 1 places.
class Interrupt : public testing::Test {
 protected:
  void SetUp() override {
    const double polygon[] = {0, 0, 1, 2, 3, 0};
    const ifsm_curve curve{polygon, 3, 2, 0};
    ifsm_filter filter{};
    WORKS(ifsm_filter_named("casteljau", IFSM_TOPOLOGY_JOINED, 3, 2, &filter));
    WORKS(ifsm_model_from_polygon(filter, &curve, 21, &model_));
    WORKS(ifsm_filter_destroy(filter));
  }
  void TearDown() override {
    WORKS(ifsm_set_interrupt(nullptr, nullptr));
    WORKS(ifsm_model_destroy(model_));
  }
  static int32_t at_once(void* asked) { return ++*static_cast<int*>(asked) > 0; }
  static int32_t never(void* asked) {
    ++*static_cast<int*>(asked);
    return 0;
  }

  ifsm_model model_{};
  int asked_ = 0;
};

TEST_F(Interrupt, EndsCallsThatTakeNoCancelToken) {
  WORKS(ifsm_set_interrupt(at_once, &asked_));
  ifsm_model refined{};
  FAILS(ifsm_model_refine(model_, nullptr, &refined), IFSM_ERROR_CANCELLED, "");
  EXPECT_EQ(refined.id, 0u);
  EXPECT_EQ(asked_, 1);
  int64_t count = -1;
  std::vector<double> parameters(1 << 22, 7.0);
  FAILS(ifsm_model_spaced(model_, 1 << 22, 0, parameters.data(), 1 << 22, &count), IFSM_ERROR_CANCELLED, "");
  EXPECT_EQ(count, -1);
  EXPECT_EQ(parameters, std::vector<double>(1 << 22, 7.0)) << "nothing is half-written";
}

TEST_F(Interrupt, IsAskedOfCallsOfItsOwnThreadAlone) {
  WORKS(ifsm_set_interrupt(at_once, &asked_));
  std::thread([&] {
    double length = 0;
    WORKS(ifsm_model_length(model_, 0, 1, &length));
    EXPECT_GT(length, 3);
  }).join();
  EXPECT_EQ(asked_, 0);
}

TEST_F(Interrupt, ThatSaysGoOnChangesNothing) {
  double alone = 0, asked = 0;
  WORKS(ifsm_model_length(model_, 0, 1, &alone));
  WORKS(ifsm_set_interrupt(never, &asked_));
  for (int k = 0; asked_ == 0 && k < 1000; ++k) WORKS(ifsm_model_length(model_, 0, 1, &asked));
  EXPECT_GT(asked_, 0);
  EXPECT_EQ(asked, alone);
}

}  // namespace
