#include "server/bus/system_clock.h"

#include <gtest/gtest.h>

namespace collision::server {
namespace {

// Goal:   the monotonic reading starts near 0 and never goes backward; the wall reading is of this
// century.
TEST(SystemClock, ReadsBothClocks) {
  SystemClock clock;
  ClockReading before;
  for (int i = 0; i < 1000; ++i) {
    const ClockReading now = clock.Read();
    EXPECT_GE(now.monotonic_ns, before.monotonic_ns);
    EXPECT_GT(now.wall_ns, 1'577'836'800'000'000'000) << "2020";
    EXPECT_LT(now.monotonic_ns, now.wall_ns);
    before = now;
  }
}

}  // namespace
}  // namespace collision::server
