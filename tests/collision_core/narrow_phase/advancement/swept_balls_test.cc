// Goal:   a time up to which two growing, moving balls are apart is never late, and is exact where
//         the answer is linear.
// Method: head-on flights with dyadic numbers; balls that grow quadratically against a fine scan of
//         the gap; balls that overlap, and balls that never meet.
#include "collision_core/narrow_phase/advancement/swept_balls.h"

#include <gtest/gtest.h>

#include "collision_core/numeric/rounding.h"

namespace collision::narrow_phase {
namespace {

constexpr double kDuration = 4;

numeric::QuickBall HeadOn(double gap, double speed, double growth) {
  return {{gap + 2, 0, 0}, {-speed, 0, 0}, 2, 0, growth};
}

double GapAt(const numeric::QuickBall& difference, double h) {
  const Eigen::Vector3d d(difference.c), w(difference.v);
  return (d + h * w).norm() - (difference.s0 + h * (difference.s1 + h * difference.s2));
}

TEST(SweptBalls, HeadOnIsExactAndNeverLate) {
  const double h = SweptBallsTouch(HeadOn(8, 4, 0), kDuration, 0);
  EXPECT_LE(h, 2.0);
  EXPECT_GE(h, 2.0 * (1 - 1e-9));
}

TEST(SweptBalls, StayApartUpToTheTimeWhateverTheyGrowBy) {
  for (const double growth : {0.0, 0.25, 1.0, 3.0}) {
    const numeric::QuickBall balls{{6, 1, 0}, {-3, 0.5, 0.25}, 2, 0.125, growth};
    const double h = SweptBallsTouch(balls, kDuration, 0);
    const double until = h < kDuration ? h : kDuration;
    for (int k = 0; k < 1000; ++k) EXPECT_GE(GapAt(balls, until * k / 1000), 0) << growth;
    if (growth >= 1) {
      EXPECT_LT(h, kDuration);
      EXPECT_LT(GapAt(balls, h + 0.25), 0) << "not idle: they touch soon after";
    }
  }
}

TEST(SweptBalls, OverlapIsNowAndPartingBallsNeverTouch) {
  EXPECT_EQ(SweptBallsTouch(HeadOn(-1, 1, 0), kDuration, 0), 0);
  EXPECT_EQ(SweptBallsTouch(HeadOn(1, -1, 0), kDuration, 0), numeric::kInfinity);
}

}  // namespace
}  // namespace collision::narrow_phase
