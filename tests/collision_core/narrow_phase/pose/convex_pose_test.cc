// Sets in another body's frame, and fronts in motion.
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
