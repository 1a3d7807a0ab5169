// Each child plants one fault; the sanitizer has to end it with its report.
#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>
#include <vector>

namespace {

TEST(SanitizerDeathTest, AddressReportsAUseAfterFree) {
  EXPECT_DEATH(
      {
        auto* values = new std::vector<int>(16, 1);
        const volatile int* first = values->data();
        delete values;
        std::exit(*first);
      },
      "AddressSanitizer: heap-use-after-free");
}

TEST(SanitizerDeathTest, AddressReportsAReadBehindTheEnd) {
  EXPECT_DEATH(
      {
        const std::vector<int> values(16, 1);
        const volatile int* data = values.data();
        std::exit(data[16]);
      },
      "AddressSanitizer: heap-buffer-overflow");
}

TEST(SanitizerDeathTest, UndefinedReportsASignedOverflow) {
  EXPECT_DEATH(
      {
        volatile int value = std::numeric_limits<int>::max();
        value = value + 1;
        std::exit(value);
      },
      "signed integer overflow");
}

TEST(SanitizerDeathTest, LeaksAreReportedAtTheEnd) {
  EXPECT_EXIT(
      {
        // The only pointer goes out of reach before the child ends.
        volatile auto* lost = static_cast<char*>(std::malloc(1234));
        lost[0] = 1;
        lost = nullptr;
        std::exit(0);
      },
      [](int status) { return status != 0; }, "LeakSanitizer: detected memory leaks");
}

}  // namespace
