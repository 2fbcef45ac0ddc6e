// Goal:   the time for which the projections of two moving hulls stay apart is never late, and is
//         exact where all motion is along the direction.
// Method: points on a line with dyadic positions and speeds; a hull whose rear is faster than its
//         front; uncertainty that grows; directions without a length.
#include "collision_core/narrow_phase/advancement/swept_points.h"

#include <gtest/gtest.h>

namespace collision::narrow_phase {
namespace {

constexpr double kDuration = 16;
const Eigen::Vector3d kAlongX = Eigen::Vector3d::UnitX();

MovingPoints<1> PointAt(double x, double speed) {
  return {{Eigen::Vector3d(x, 0, 0)}, {Eigen::Vector3d(speed, 0, 0)}};
}

void ExpectJustBefore(double time, double exact) {
  EXPECT_LE(time, exact);
  EXPECT_GE(time, exact * (1 - 1e-9));
}

TEST(SweptPoints, TwoPointsThatMeetAreExactWhateverTheDirectionsLength) {
  const SweptPoints<1, 1> points{PointAt(0, 1), PointAt(8, -3), {}};
  for (const double length : {1.0, 1e-100, 1e100}) {
    ExpectJustBefore(ApartAlong(Eigen::Vector3d(length * kAlongX), points, 0, kDuration), 2);
  }
}

TEST(SweptPoints, CountsFromTheInstantAskedFor) {
  const SweptPoints<1, 1> points{PointAt(0, 1), PointAt(8, -3), {}};
  ExpectJustBefore(ApartAlong(kAlongX, points, 1.5, kDuration), 0.5);
  EXPECT_EQ(ApartAlong(kAlongX, points, 2, kDuration), 0);
}

TEST(SweptPoints, PartingPointsNeverMeet) {
  const SweptPoints<1, 1> points{PointAt(0, -1), PointAt(8, 3), {}};
  EXPECT_EQ(ApartAlong(kAlongX, points, 0, kDuration), numeric::kInfinity);
}

// Its front stands still 2 m away; its rear, 12 m away, comes at 4 m/s. As if all of it moved as
// fast as the rear, the gap would last for half a second only.
TEST(SweptPoints, AFastRearCountsFromWhereItIs) {
  const MovingPoints<2> hull{{Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(-10, 0, 0)},
                             {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(4, 0, 0)}};
  ExpectJustBefore(ApartAlong(kAlongX, SweptPoints<2, 1>{hull, PointAt(2, 0), {}}, 0, kDuration),
                   3);
}

TEST(SweptPoints, WhatIsUsedUpEndsTheGapEarlier) {
  const auto apart = [](const SweptPose::Growth& used) {
    return ApartAlong(kAlongX, SweptPoints<1, 1>{PointAt(0, 0), PointAt(8, -2), used}, 0,
                      kDuration);
  };
  ExpectJustBefore(apart({2, 0, 0}), 3);
  ExpectJustBefore(apart({0, 2, 0}), 2);
  ExpectJustBefore(apart({0, 0, 1}), 2);
  EXPECT_EQ(apart({8, 0, 0}), 0);
}

TEST(SweptPoints, ADirectionWithoutALengthShowsNothing) {
  const SweptPoints<1, 1> points{PointAt(0, 0), PointAt(8, 0), {}};
  for (const double length : {0.0, 1e-300, 1e300}) {
    EXPECT_EQ(ApartAlong(Eigen::Vector3d(length * kAlongX), points, 0, kDuration), 0) << length;
  }
}

}  // namespace
}  // namespace collision::narrow_phase
