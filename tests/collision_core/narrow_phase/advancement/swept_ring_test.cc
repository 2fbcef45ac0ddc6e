// Goal:   what bodies sweep in all their turns is never left too late, and tells at once of bodies
//         that turn about without meeting.
// Method: bodies that turn and move with constant velocities, in long double, at many instants up
//         to the time that was said; closed cases about one axis.
#include "collision_core/narrow_phase/advancement/swept_ring.h"

#include <gtest/gtest.h>

#include "tests/collision_core/narrow_phase/promise_scene.h"
#include "tests/support/solids.h"

namespace collision::narrow_phase {
namespace {

constexpr std::uint64_t kPlenty = 10'000'000;
constexpr double kPi = std::numbers::pi;

struct Case {
  BodySegment a, b;
  SweptPose swept;
  Quaternion q_AB = Quaternion::Identity();
  double duration = 1;

  double Touch(std::uint64_t units = kPlenty) const {
    WorkBudget work(units);
    return SweptRingBound({BodyTree(a), BodyTree(b), swept}, duration, &work);
  }

  // However far either has turned by then.
  Real Distance(Real h, Real turned_A, Real turned_B) const {
    TruePose pose_A, pose_B;
    pose_A.q = Exponential(turned_A * swept.spin_A.cast<Real>().eval());
    pose_B.q = Exponential(turned_B * swept.spin_B.cast<Real>().eval()) * q_AB;
    pose_B.p = swept.pose.p_AB.cast<Real>() + h * swept.velocity.cast<Real>();
    return SurfaceDistance(TrueBody(a.shape.get(), a.ball.radius, pose_A),
                           TrueBody(b.shape.get(), b.ball.radius, pose_B));
  }
};

Case RandomCase(Random& random) {
  Case c;
  const double size = random.LogUniform(0.01, 100);
  c.a = BodyOf(RandomShape(random, size), 0.7 * size);
  c.b = BodyOf(RandomShape(random, size * random.LogUniform(0.1, 4)), 0.4 * size);
  if (!c.a.shape && !c.b.shape) c.b = BodyOf(shape::Shape::Build(Scaled(LShape(), size)));
  c.q_AB = RandomTurn(random).cast<double>().cast<Real>().normalized();
  const numeric::Rotation rotation = RotationOf(numeric::UnitQuaternion(c.q_AB.cast<double>()));
  c.swept.pose.R_AB = rotation.matrix;
  c.swept.pose.matrix_error = rotation.error + 0x1p-48;
  if (c.a.shape && random.Chance(0.7)) c.swept.spin_A = 100 * random.UnitVector();
  if (c.b.shape && random.Chance(0.7)) c.swept.spin_B = 30 * random.UnitVector();
  if (random.Chance(0.3)) c.swept.spin_B = -0.5 * c.swept.spin_A;  // about one axis
  if (!c.b.shape) c.swept.spin_B.setZero();
  if (c.swept.spin_A.isZero(0) && c.swept.spin_B.isZero(0)) {
    (c.a.shape ? c.swept.spin_A : c.swept.spin_B) = 10 * random.UnitVector();
  }
  const double reach = c.a.ball.radius + c.b.ball.radius;
  c.swept.pose.p_AB = reach * random.Uniform(0, 1.5) * random.UnitVector();
  c.swept.velocity = reach * random.Uniform(0, 1) * random.UnitVector();
  return c;
}

TEST(SweptRing, NeverLaterThanAnyTurnMayTouch) {
  int free = 0, partly = 0, none = 0;
  for (std::uint64_t seed = 1; seed <= 300 && !testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Case c = RandomCase(random);
    const double until = std::min(c.Touch(), c.duration);
    free += c.Touch() == numeric::kInfinity;
    partly += until > 0 && until < c.duration;
    none += until == 0;
    if (until == 0) continue;
    for (int i = 0; i < 12; ++i) {
      const Real h = i == 0 ? until * (1 - 1e-9) : until * random.Uniform(0, 1);
      const Real turned_A = random.Uniform(0, 1), turned_B = random.Uniform(0, 1);
      EXPECT_GT(c.Distance(h, turned_A, turned_B), 0) << static_cast<double>(h);
    }
    for (const std::uint64_t units : {1, 10, 100, 1000}) EXPECT_LE(c.Touch(units), c.Touch());
  }
  EXPECT_GT(free, 20);
  EXPECT_GT(partly, 20);
  EXPECT_GT(none, 20);
}

// A bar about z; what comes down on it from above meets its top at z = 0.1, wherever it is.
TEST(SweptRing, ExactAboutOneAxis) {
  Case c;
  c.a = BodyOf(shape::Shape::Build(Box({-2, -0.1, -0.1}, {2, 0.1, 0.1})));
  c.b = BodyOf(shape::Shape::Build(Cube(0.5)));
  c.swept.spin_A = {0, 0, 1000};
  c.swept.pose.p_AB = {0.5, 0.25, 1.1};
  c.swept.velocity = {0, 0, -1};
  EXPECT_LE(c.Touch(), 0.5);
  EXPECT_GE(c.Touch(), 0.5 - 1e-12);
  // About the same axis, or one that is nearly the same, the cube may turn as well.
  c.swept.spin_B = {0, 0, -30};
  EXPECT_GE(c.Touch(), 0.5 - 1e-12);
  EXPECT_LE(c.Touch(), 0.5);
  c.swept.spin_B = {0, 0.003, -30};
  EXPECT_LE(c.Touch(), 0.5 - 5e-5);
  EXPECT_GE(c.Touch(), 0.5 - 2e-4);
  c.swept.velocity = {0, 0, 0};
  EXPECT_EQ(c.Touch(), numeric::kInfinity);
}

// What is not known of the motion counts: 0.5 m are used up by 0.2 + 0.1 h + 0.2 h² at h = 1.
TEST(SweptRing, UncertaintyCounts) {
  Case c;
  c.a = BodyOf(shape::Shape::Build(Box({-2, -0.1, -0.1}, {2, 0.1, 0.1})));
  c.b = BodyOf(nullptr, 0.25);
  c.swept.spin_A = {0, 0, 1000};
  c.swept.pose.p_AB = {1, 0, 0.85};
  c.swept.translation = {0.2, 0.1, 0.2};
  c.duration = 2;
  EXPECT_LE(c.Touch(), 1);
  EXPECT_GE(c.Touch(), 1 - 1e-9);
}

// In the hole of a ring that turns about its axis.
TEST(SweptRing, InsideAHole) {
  Case c;
  c.a = BodyOf(shape::Shape::Build(Frame()));
  c.b = BodyOf(nullptr, 0.9);
  c.swept.spin_A = {0, 0, 50};
  EXPECT_EQ(c.Touch(), numeric::kInfinity);
  c.swept.velocity = {0.2, 0, 0};
  EXPECT_LE(c.Touch(), 0.5);
  EXPECT_GE(c.Touch(), 0.5 - 1e-9);
}

// Convex solids, boxes and hulls of their corners, tell the same as the boxes' triangles, and as
// soon.
TEST(SweptRing, SolidsAreNoFartherThanTheirTriangles) {
  int free = 0, partly = 0;
  for (std::uint64_t seed = 1; seed <= 300 && !testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const auto half = [&] { return Eigen::Vector3d(random.Uniform(0.1, 2), 0.3, 0.2); };
    const Eigen::Vector3d half_A = half(), half_B = half();
    Case meshes;
    meshes.a = BodyOf(shape::Shape::Build(Box(-half_A, half_A)));
    meshes.b = BodyOf(shape::Shape::Build(Box(-half_B, half_B)));
    meshes.swept.spin_A = 100 * random.UnitVector();
    if (random.Chance(0.5)) meshes.swept.spin_B = 30 * random.UnitVector();
    const double reach = meshes.a.ball.radius + meshes.b.ball.radius;
    meshes.swept.pose.p_AB = reach * random.Uniform(0.5, 1.5) * random.UnitVector();
    meshes.swept.velocity = reach * random.Uniform(0, 1) * random.UnitVector();
    Case solids = meshes;
    const bool hulls = random.Chance(0.5);
    solids.a.shape = shape::Shape::Compound(
        nullptr, {hulls ? HullBox(-half_A, half_A) : SolidBox(-half_A, half_A)});
    solids.b.shape = shape::Shape::Compound(nullptr, {SolidBox(-half_B, half_B)});
    const double until = std::min(solids.Touch(), 1.0);
    free += solids.Touch() == numeric::kInfinity;
    partly += until > 0 && until < 1;
    for (int i = 0; until > 0 && i < 12; ++i) {
      const Real h = i == 0 ? until * (1 - 1e-9) : until * random.Uniform(0, 1);
      EXPECT_GT(meshes.Distance(h, random.Uniform(0, 1), random.Uniform(0, 1)), 0);
    }
  }
  EXPECT_GT(free, 20);
  EXPECT_GT(partly, 20);
}

// The bar of ExactAboutOneAxis, as a box, a hull, a capsule and an ellipsoid.
TEST(SweptRing, SolidsAreExactAboutOneAxis) {
  shape::ConvexDescription capsule, ellipsoid;
  capsule.core = geometry::ConvexCore::kSegment;
  capsule.half = {0, 0, 1.9};
  capsule.rounding = 0.1;
  capsule.q_BS = Eigen::Quaterniond(Eigen::AngleAxisd(kPi / 2, Eigen::Vector3d::UnitY()));
  ellipsoid.core = geometry::ConvexCore::kEllipsoid;
  ellipsoid.half = {2, 0.1, 0.1};
  for (const shape::ConvexSolid& bar :
       {SolidBox({-2, -0.1, -0.1}, {2, 0.1, 0.1}), HullBox({-2, -0.1, -0.1}, {2, 0.1, 0.1}),
        shape::ConvexSolid::Build(capsule), shape::ConvexSolid::Build(ellipsoid)}) {
    Case c;
    c.a = BodyOf(shape::Shape::Compound(nullptr, {bar}));
    c.b = BodyOf(shape::Shape::Compound(nullptr, {SolidBox({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5})}));
    c.swept.spin_A = {0, 0, 1000};
    c.swept.pose.p_AB = {0.5, 0.25, 1.1};
    c.swept.velocity = {0, 0, -1};
    EXPECT_LE(c.Touch(), 0.5);
    EXPECT_GE(c.Touch(), 0.5 - 1e-9);
  }
}

}  // namespace
}  // namespace collision::narrow_phase
