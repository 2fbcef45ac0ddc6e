// Sets in another body's frame, half-spaces, and fronts in motion.
#include "collision_core/narrow_phase/pose/convex_pose.h"

#include <gtest/gtest.h>

#include "collision_core/narrow_phase/convex_pair/convex_front.h"
#include "tests/collision_core/narrow_phase/convex_cases.h"

namespace collision::narrow_phase {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

/// The corners of the set, exactly as its numbers say, seen from the frame's origin.
ExactPoints CornersOf(const geometry::ConvexSet& set) {
  const ExactPlacement placement = PlacementOf(set.generators, set.centre);
  ExactPoints corners;
  const auto add = [&](double x, double y, double z) {
    corners.push_back(placement(ExactVector(x, y, z)));
  };
  if (set.core == geometry::ConvexCore::kPoint) add(0, 0, 0);
  for (const int i : {-1, 1}) {
    if (set.core == geometry::ConvexCore::kSegment) add(i, 0, 0);
    for (const int j : {-1, 1}) {
      for (const int k : {-1, 1}) {
        if (set.core == geometry::ConvexCore::kBox) add(i, j, k);
      }
    }
  }
  for (std::uint32_t i = 0; set.core == geometry::ConvexCore::kHull && i < set.points->size();
       ++i) {
    corners.push_back(placement(ExactVector((*set.points)[i])));
  }
  return corners;
}

/// Each point of one lies within `error` of a corner of the other.
bool AreWithin(const ExactPoints& x, const ExactPoints& y, double error) {
  for (const ExactVector& p : x) {
    bool found = false;
    for (const ExactVector& q : y) {
      found = found || Square(p - q) <= Exact(error) * Exact(error);
    }
    if (!found) return false;
  }
  return true;
}

// Goal:   a solid in its body, and posed in another body's frame, is off from the exact one by no
//         more than it says, which is little.
// Method: exact corners; quaternions of any length; places up to 1e7 m from the reference points.
TEST(ConvexPose, ErrorsAreCounted) {
  Random random(331);
  for (int i = 0; i < 400; ++i) {
    const double size = random.LogUniform(1e-4, 1e4);
    shape::ConvexDescription d = RandomPolytope(random, size);
    d.q_BS.coeffs() *= random.LogUniform(1e-3, 1e3);
    d.p_BS = (i % 2 ? 1e7 : size) * random.UnitVector();
    const shape::ConvexSolid solid = shape::ConvexSolid::Build(d);
    const ExactPoints exact = ExactCorners(d);
    EXPECT_TRUE(AreWithin(CornersOf(solid.set()), exact, solid.set().error));
    EXPECT_TRUE(AreWithin(exact, CornersOf(solid.set()), solid.set().error));
    EXPECT_LE(solid.set().error, 1e-14 * (size + d.p_BS.norm()));
    const RelativePose pose =
        PoseOf(RotationOf(numeric::UnitQuaternion(RandomQuaternion(random))).matrix,
               random.LogUniform(1e-3, 1e6) * random.UnitVector());
    const geometry::ConvexSet posed = PosedB(solid.set(), pose);
    const ExactPoints there = Placed(exact, PlacementOf(pose.R_AB, pose.p_AB));
    EXPECT_TRUE(AreWithin(CornersOf(posed), there, posed.error));
    EXPECT_LE(posed.error, 2e-14 * (size + d.p_BS.norm() + pose.p_AB.norm()));
  }
}

// Goal:   what a body may be turned by counts with the distance from its reference point.
TEST(ConvexPose, TurningCounts) {
  shape::ConvexDescription d;
  d.rounding = 1;
  d.p_BS = {3, 4, 0};
  const shape::ConvexSolid ball = shape::ConvexSolid::Build(d);
  RelativePose pose;
  pose.chord_A = 0.5;
  pose.chord_B = 0.25;
  EXPECT_GE(PosedA(ball.set(), pose).error, 2.5);
  EXPECT_GE(PosedB(ball.set(), pose).error, 1.25);
  EXPECT_LE(PosedA(ball.set(), pose).error, 2.5 * (1 + 1e-12));
  EXPECT_LE(PosedB(ball.set(), pose).error, 1.25 * (1 + 1e-12));
}

// Goal:   a solid over the ground: its height is contained and known to rounding, over and under
//         it.
// Method: a normal (2, 3, 6), 7 long, so that heights are rational; also half-spaces that are
//         turned.
TEST(ConvexPose, HalfSpaces) {
  Random random(332);
  for (int i = 0; i < 500; ++i) {
    const double size = random.LogUniform(1e-3, 1e3);
    const shape::ConvexDescription d = RandomPolytope(random, size);
    const shape::ConvexSolid solid = shape::ConvexSolid::Build(d);
    const shape::ConvexHalfSpace ground{{2, 3, 6}, size * random.UnitVector()};
    ASSERT_FALSE(RefusalOf(ground));
    const RelativePose still = PoseOf(Eigen::Matrix3d::Identity(), {0, 0, 0});
    const ConvexSeparation found = SeparationOf(solid.set(), PosedB(ground, still));
    const ExactPoints corners = ExactCorners(d);
    const ExactVector n(2, 3, 6);
    Exact least = Dot(n, corners[0] - ExactVector(ground.point));
    for (const ExactVector& x : corners) {
      least = std::min(least, Dot(n, x - ExactVector(ground.point)));
    }
    const Exact height = least / 7 - Exact(d.rounding);
    EXPECT_TRUE(Contains(found.separation, height)) << i;
    EXPECT_LT(found.separation.width(), 1e-13 * size) << i;
    EXPECT_NEAR((found.b - found.a).norm(), std::max(0.0, found.separation.upper),
                2 * found.point_error + found.separation.width());
  }
}

TEST(ConvexPose, EllipsoidOverTheGround) {
  Random random(333);
  for (int i = 0; i < 300; ++i) {
    shape::ConvexDescription d = RandomBox(random, 1);
    d.core = geometry::ConvexCore::kEllipsoid;
    d.p_BS = 3 * random.UnitVector();
    const ExactVector n(2, 3, 6);
    Exact square = 0;
    for (const ExactPlacement& placement : {PlacementOf(d.q_BS, d.p_BS)}) {
      for (int axis = 0; axis < 3; ++axis) {
        Vector3d half = Vector3d::Zero();
        half[axis] = d.half[axis];
        const Exact along = Dot(n, placement(ExactVector(half)) - placement.offset);
        square += along * along;
      }
    }
    const RelativePose still = PoseOf(Eigen::Matrix3d::Identity(), {0, 0, 0});
    const numeric::Interval found =
        SeparationOf(shape::ConvexSolid::Build(d).set(),
                     PosedA(shape::ConvexHalfSpace{{2, 3, 6}, {0, 0, 0}}, still))
            .separation;
    // (n·c − √square) / 7 lies in the interval.
    const Exact centre = Dot(n, ExactVector(d.p_BS));
    EXPECT_TRUE(IsAtLeast(0, Exact(0), centre - 7 * Exact(found.lower)));
    EXPECT_LE(square, (centre - 7 * Exact(found.lower)) * (centre - 7 * Exact(found.lower)));
    EXPECT_GE(square, (centre - 7 * Exact(found.upper)) * (centre - 7 * Exact(found.upper)));
    EXPECT_LT(found.width(), 1e-13);
  }
}

// Goal:   a half-space of a body that is turned in any way: the height of what lies far away is
//         contained.
TEST(ConvexPose, TurnedHalfSpaces) {
  Random random(334);
  for (int i = 0; i < 300; ++i) {
    shape::ConvexDescription ball;
    ball.rounding = 1;
    ball.p_BS = random.LogUniform(1, 1e6) * random.UnitVector();
    const shape::ConvexHalfSpace ground{{0, 0, random.LogUniform(1e-9, 1e9)}, random.UnitVector()};
    const RelativePose pose =
        PoseOf(RotationOf(numeric::UnitQuaternion(RandomQuaternion(random))).matrix,
               100 * random.UnitVector());
    const numeric::Interval found =
        SeparationOf(shape::ConvexSolid::Build(ball).set(), PosedB(ground, pose)).separation;
    const ExactPlacement placement = PlacementOf(pose.R_AB, pose.p_AB);
    const ExactVector n(pose.R_AB(0, 2), pose.R_AB(1, 2), pose.R_AB(2, 2));
    const ExactVector from = ExactVector(ball.p_BS) - placement(ExactVector(ground.point));
    const Exact height = Dot(n, from);  // times |n|, which is 1 to within a few roundings
    const Exact slack = Exact(1e-15) * abs(height);
    EXPECT_LE(Exact(found.lower), height - 1 + slack);
    EXPECT_GE(Exact(found.upper), height - 1 - slack);
    EXPECT_LT(found.width(), 1e-13 * (ball.p_BS.norm() + 100));
  }
}

// Goal:   a half-space that may be turned is uncertain by that times how far away the solid is.
TEST(ConvexPose, UncertainHalfSpaces) {
  shape::ConvexDescription ball;
  ball.rounding = 1;
  ball.p_BS = {100, 0, 3};
  const shape::ConvexSolid solid = shape::ConvexSolid::Build(ball);
  for (const bool of_A : {false, true}) {
    RelativePose pose;
    (of_A ? pose.chord_A : pose.chord_B) = 0.01;
    const shape::ConvexHalfSpace ground{{0, 0, 1}, {0, 0, 0}};
    const numeric::Interval found =
        SeparationOf(solid.set(), of_A ? PosedA(ground, pose) : PosedB(ground, pose)).separation;
    EXPECT_LE(found.lower, 2 - 1);
    EXPECT_GE(found.upper, 2 + 1);
    EXPECT_LT(found.width(), 2.2);
  }
}

// Goal:   no corner of a set that moves along its tangents passes the front, and one nearly reaches
//         it; the fastest is not passed and nearly reached.
// Method: exact corners of boxes and hulls, exact velocities.
TEST(ConvexFront, ContainsMovingCorners) {
  Random random(335);
  for (int i = 0; i < 500; ++i) {
    const double size = random.LogUniform(1e-3, 1e3);
    shape::ConvexDescription d = i % 2 ? RandomBox(random, size) : RandomHull(random, size, 8);
    d.p_BS = random.LogUniform(1e-2, 1e4) * random.UnitVector();
    const shape::ConvexSolid solid = shape::ConvexSolid::Build(d);
    TangentMotion motion;
    motion.velocity = random.LogUniform(1e-2, 1e4) * random.UnitVector();
    motion.spin = random.LogUniform(1e-3, 10) * random.UnitVector();
    motion.about = random.LogUniform(1e-2, 1e2) * random.UnitVector();
    const Vector3d n = random.UnitVector(), origin = d.p_BS + size * random.UnitVector();
    const double h = i % 5 == 0 ? 0 : random.LogUniform(1e-3, 10);
    const MovingFront found = FrontOf(solid.set(), motion, n, origin, h);
    const ExactVector exact_n(n);
    Exact front = -Exact(1e30), fastest = front;
    for (const ExactVector& x : ExactCorners(d)) {
      const ExactVector v = ExactVector(motion.velocity) +
                            Cross(ExactVector(motion.spin), x - ExactVector(motion.about));
      front = std::max(front, Dot(exact_n, x + Exact(h) * v - ExactVector(origin)));
      fastest = std::max(fastest, Dot(exact_n, v));
    }
    EXPECT_LE(front, Exact(found.front));
    EXPECT_LE(fastest, Exact(found.fastest));
    const double places = 4 * size + 1e-9 * d.p_BS.norm();
    const double speeds =
        motion.velocity.norm() + motion.spin.norm() * (d.p_BS.norm() + motion.about.norm() + size);
    EXPECT_LE(Exact(found.front) - front, Exact(1e-6 * places + 3e-14 * h * speeds));
    EXPECT_LE(Exact(found.fastest) - fastest, Exact(3e-14 * speeds));
  }
}

// Goal:   the ball about a core turns with it: it reaches as far in every direction.
TEST(ConvexFront, RoundedSets) {
  shape::ConvexDescription d;
  d.core = geometry::ConvexCore::kSegment;
  d.half.z() = 2;
  d.rounding = 0.5;
  const shape::ConvexSolid capsule = shape::ConvexSolid::Build(d);
  TangentMotion motion;
  motion.spin = {0, 1, 0};  // z turns towards +x: points at z = 2 move at 2 m/s along x.
  const MovingFront front = FrontOf(capsule.set(), motion, {1, 0, 0}, {0, 0, 0}, 1);
  EXPECT_NEAR(front.fastest, 2.5, 1e-12);
  EXPECT_NEAR(front.front, 2 + 0.5 * std::sqrt(2), 1e-12);
}

}  // namespace
}  // namespace collision::narrow_phase
