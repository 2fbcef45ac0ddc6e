// Goal:   a stated precondition that does not hold throws, and leaves no wrong bound behind.
// Method: each call is made once with what it does not accept.
#include <gtest/gtest.h>

#include "collision_core/base/check.h"
#include "collision_core/motion/contract.h"
#include "collision_core/motion/contract_between.h"
#include "collision_core/motion/contract_cap.h"
#include "collision_core/motion/speed_cap.h"

namespace collision::motion {
namespace {

TEST(MotionPreconditions, ABoundWithoutACapHasNoCappedBall) {
  const SpaceTimeBound bound;
  EXPECT_THROW(CappedSpeed(bound), CheckFailure);
  EXPECT_THROW(CapStartOf(bound), CheckFailure);
  EXPECT_THROW(FaceCapStartOf(bound, {0, 1}, 1), CheckFailure);
  EXPECT_THROW(CappedBallOf(bound), CheckFailure);
  EXPECT_THROW(CappedFaceOf(bound, {0, 1}, 1), CheckFailure);
  EXPECT_THROW(CheckCap(bound, bound.state), CheckFailure);
}

TEST(MotionPreconditions, AStateIsNotComparedWithALaterOne) {
  SpaceTimeBound before;
  before.limits.speed_max = 1;
  MotionState next = before.state;
  next.stamp = Instant::FromNanoseconds(before.state.stamp.nanoseconds() - 1);
  EXPECT_THROW(CheckContract(before, next, OrientationUse::kIgnored), CheckFailure);
  EXPECT_THROW(CheckCap(before, next), CheckFailure);
  EXPECT_THROW(GapBetween(before, next), CheckFailure);
}

}  // namespace
}  // namespace collision::motion
