// Goal:   time waits for a shape as long as allowed, and people are told.
#include "server/intake/shape_wait.h"

#include <gtest/gtest.h>

namespace collision::server {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

TEST(ShapeWait, HoldsUntilTheShapeIsThere) {
  ShapeWait wait(5 * kSecond);
  EXPECT_FALSE(wait.Holds(0));
  wait.Begin("hash", 10 * kSecond);
  wait.Begin("hash", 12 * kSecond);
  EXPECT_TRUE(wait.Holds(15 * kSecond - 1));
  wait.End("hash");
  EXPECT_FALSE(wait.Holds(11 * kSecond));
  EXPECT_FALSE(wait.NextDue());
}

TEST(ShapeWait, GoesOnWithoutItAtTheLimit) {
  ShapeWait wait(5 * kSecond);
  wait.Begin("hash", 10 * kSecond);
  EXPECT_EQ(wait.NextDue(), 10 * kSecond + kShapeWaitTold);
  EXPECT_TRUE(wait.TakeLines(10 * kSecond).empty());
  EXPECT_EQ(wait.TakeLines(10 * kSecond + kShapeWaitTold).size(), 1u);
  EXPECT_TRUE(wait.TakeLines(12 * kSecond).empty()) << "it is told once";
  EXPECT_EQ(wait.Waiting(12 * kSecond).size(), 1u);
  EXPECT_EQ(wait.NextDue(), 15 * kSecond);
  EXPECT_FALSE(wait.Holds(15 * kSecond));
  EXPECT_TRUE(wait.Waiting(15 * kSecond).empty());
  ASSERT_EQ(wait.TakeLines(15 * kSecond).size(), 1u);
  EXPECT_FALSE(wait.NextDue());
}

TEST(ShapeWait, ALimitOfNothingNeverHolds) {
  ShapeWait wait(0);
  wait.Begin("hash", 0);
  EXPECT_FALSE(wait.Holds(0));
}

}  // namespace
}  // namespace collision::server
