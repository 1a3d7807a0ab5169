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

}  // namespace
