// Systems that the tests of the C ABI share, let go of at a test's end; and arrays as vectors.
#pragma once

#include <cstdint>
#include <vector>

#include "support.h"

// All of an array that a function tells: asks for the count, then for the values.
template <class T, class Call>
std::vector<T> all_of(const Call& call) {
  int64_t count = -1;
  EXPECT_EQ(call(nullptr, int64_t{0}, &count), IFSM_OK) << last_error().message;
  std::vector<T> values(static_cast<std::size_t>(count > 0 ? count : 0));
  EXPECT_EQ(call(values.data(), count, &count), IFSM_OK) << last_error().message;
  EXPECT_EQ(count, static_cast<int64_t>(values.size()));
  return values;
}

class WithSystems : public testing::Test {
 protected:
  void TearDown() override {
    for (const ifsm_system system : made_) WORKS(ifsm_system_destroy(system));
  }

  ifsm_system keep(ifsm_system system) {
    made_.push_back(system);
    return system;
  }
  ifsm_system named(const char* name) {
    ifsm_system system{};
    EXPECT_EQ(ifsm_system_named(name, &system), IFSM_OK) << last_error().message;
    return keep(system);
  }
  ifsm_system of(const std::vector<double>& maps, const std::vector<double>& probabilities = {},
                 int32_t dimension = 2) {
    ifsm_system system{};
    EXPECT_EQ(ifsm_system_create(dimension, maps.data(), static_cast<int64_t>(maps.size()), probabilities.data(),
                                 static_cast<int64_t>(probabilities.size()), &system),
              IFSM_OK)
        << last_error().message;
    return keep(system);
  }

  // Sierpinski's gasket with its corners at (0, 0), (1, 0), (0, 1).
  ifsm_system gasket() { return of({.5, 0, 0, 0, .5, 0, .5, 0, .5, 0, .5, 0, .5, 0, 0, 0, .5, .5}); }
  // A square, four maps to its quarters.
  ifsm_system square() {
    return of({.5, 0, 0, 0, .5, 0, .5, 0, .5, 0, .5, 0, .5, 0, 0, 0, .5, .5, .5, 0, .5, 0, .5, .5});
  }
  // One map, towards the origin.
  ifsm_system origin() { return of({.5, 0, 0, 0, .5, 0}); }
  // Neither map grows in itself, the word of both does: the second one is map 2, a dummy lies between.
  ifsm_system growing() { return of({0, 2, 0, 0, 0, 0, 9, 0, 0, 0, 9, 0, 0, 0, 0, 2, 0, 1}, {1, 0, 1}); }

  int64_t count = 0;

 private:
  std::vector<ifsm_system> made_;
};
