// What every test of the C ABI says: a call that works, and a call that fails in one particular way.
#pragma once

#include <gtest/gtest.h>
#include <ifsm.h>

#include <string>

inline ifsm_error last_error() {
  ifsm_error error{};
  error.struct_size = sizeof error;
  EXPECT_EQ(ifsm_last_error(&error), IFSM_OK);
  return error;
}

// EXPECT_EQ(IFSM_OK, …) with the library's own words.
#define WORKS(call) ASSERT_EQ(call, IFSM_OK) << last_error().message

// The call fails with `expected` and the record blames `blamed` of that very function.
#define FAILS(call, expected, blamed)                                                              \
  do {                                                                                             \
    ASSERT_EQ(call, expected) << #call;                                                            \
    const ifsm_error told = last_error();                                                          \
    EXPECT_EQ(told.status, expected);                                                              \
    EXPECT_STREQ(told.argument, blamed) << told.message;                                           \
    EXPECT_EQ(std::string(#call).rfind(std::string(told.function) + "(", 0), 0u) << told.function; \
    EXPECT_EQ(std::string(told.message).back(), '.') << told.message;                              \
  } while (false)
