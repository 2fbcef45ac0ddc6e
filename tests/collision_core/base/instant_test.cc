#include <gtest/gtest.h>

#include "collision_core/numeric/seconds.h"
#include "tests/support/random.h"
#include "tests/support/truth/exact.h"

namespace collision {
namespace {

Instant AnyInstant(Random& random) {
  const auto ns = static_cast<std::int64_t>(random.Next() >> random.Below(64) >> 1);
  return Instant::FromNanoseconds(random.Chance(0.5) ? ns / 2 : -(ns / 2));
}

// Goal:   differences contain the exact quotient and are tight, centuries apart or one nanosecond.
// Method: exact rationals.
TEST(Instant, SecondsBetweenContainsTheExactQuotient) {
  Random random(21);
  for (int i = 0; i < 50000; ++i) {
    const Instant from = AnyInstant(random), to = AnyInstant(random);
    const numeric::Interval seconds = numeric::SecondsBetween(from, to);
    ASSERT_TRUE(Contains(seconds, ExactSeconds(from, to)));
    ASSERT_LE(seconds.width(), 4 * 0x1p-53 * std::abs(seconds.upper));
  }
  const Instant last = Instant::FromNanoseconds(std::numeric_limits<std::int64_t>::max() - 1);
  const Instant first = Instant::FromNanoseconds(std::numeric_limits<std::int64_t>::min() + 1);
  EXPECT_TRUE(Contains(numeric::SecondsBetween(first, last), ExactSeconds(first, last)));
  EXPECT_EQ(numeric::SecondsBetween(Instant(), Instant::FromNanoseconds(1500000000)).width(), 0);
}

// Goal:   rounded down (up) is the last (first) nanosecond not later (earlier) than the exact sum.
// Method: exact floor and ceiling; negative seconds, whole nanoseconds and their neighbours too.
TEST(Instant, AdditionRoundsTheStatedWay) {
  Random random(22);
  for (int i = 0; i < 50000; ++i) {
    const Instant from = AnyInstant(random);
    double seconds = random.LogUniform(1e-20, 4e9) * (random.Chance(0.5) ? 1 : -1);
    if (random.Chance(0.3)) seconds = static_cast<double>(random.Below(1000)) / 1e9;
    if (random.Chance(0.2)) seconds = numeric::NextDown(seconds);
    const Exact exact = Exact(seconds) * 1000000000 + from.nanoseconds();
    const Instant down = numeric::AddRoundedDown(from, seconds),
                  up = numeric::AddRoundedUp(from, seconds);
    if (!down.is_never() && down != Instant::Always()) {
      ASSERT_LE(Exact(down.nanoseconds()), exact) << seconds;
      ASSERT_GT(Exact(down.nanoseconds()) + 1, exact) << seconds;
    }
    if (!up.is_never() && up != Instant::Always()) {
      ASSERT_GE(Exact(up.nanoseconds()), exact) << seconds;
      ASSERT_LT(Exact(up.nanoseconds()) - 1, exact) << seconds;
    }
  }
}

// Goal:   infinity and sums past the range are Never; Never and Always stay what they are.
TEST(Instant, SaturatesAtNever) {
  const Instant late = Instant::FromNanoseconds(std::numeric_limits<std::int64_t>::max() - 5);
  EXPECT_TRUE(numeric::AddRoundedDown(Instant(), numeric::kInfinity).is_never());
  EXPECT_TRUE(numeric::AddRoundedUp(Instant(), numeric::kInfinity).is_never());
  EXPECT_TRUE(numeric::AddRoundedDown(late, 1).is_never());
  EXPECT_TRUE(numeric::AddRoundedUp(late, 1e300).is_never());
  EXPECT_TRUE(numeric::AddRoundedDown(Instant::Never(), -1).is_never());
  EXPECT_EQ(numeric::AddRoundedDown(Instant::Always(), 1), Instant::Always());
  EXPECT_EQ(numeric::AddRoundedUp(Instant(), -numeric::kInfinity), Instant::Always());
}

}  // namespace
}  // namespace collision
