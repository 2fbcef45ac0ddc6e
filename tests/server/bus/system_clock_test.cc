#include "server/bus/system_clock.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

namespace collision::server {
namespace {

// Goal:   the steady reading starts near 0 and never goes backward; the wall reading is of this
//         century; both belong to one moment, so that they differ by the same all the time.
// Method: many readings. The machine may interrupt some, so most of the differences count.
TEST(SystemClock, ReadsBothClocks) {
  constexpr int kReadings = 1000;
  constexpr std::int64_t kApart = 100'000;  // [ns]
  SystemClock clock;
  ClockReading before;
  int close = 0;
  for (int i = 0; i < kReadings; ++i) {
    const ClockReading now = clock.Read();
    EXPECT_GE(now.monotonic_ns, before.monotonic_ns);
    EXPECT_GT(now.wall_ns, 1'577'836'800'000'000'000) << "2020";
    EXPECT_LT(now.monotonic_ns, now.wall_ns);
    const std::int64_t change =
        (now.wall_ns - before.wall_ns) - (now.monotonic_ns - before.monotonic_ns);
    close += std::abs(change) <= kApart;
    before = now;
  }
  EXPECT_GT(close, kReadings / 2);
}

// Goal:   a clock that nobody sets calls nobody, and ends at once.
TEST(SystemClock, SaysNothingWhereTheClockIsNotSet) {
  constexpr int kClocks = 100;
  for (int i = 0; i < kClocks; ++i) {
    bool called = false;
    {
      SystemClock clock([&called] { called = true; });
      EXPECT_FALSE(clock.Read().wall_was_set);
    }
    EXPECT_FALSE(called);
  }
}

}  // namespace
}  // namespace collision::server
