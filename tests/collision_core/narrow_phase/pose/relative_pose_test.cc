// Goal:   the relative pose of two bodies is off by no more than it says, in rounding and in
//         motion, and its bounds are not much wider than needed.
// Method: the same pose in long double, near and far from the origin; motions with the greatest
//         accelerations.
#include "collision_core/narrow_phase/pose/relative_pose.h"

#include <gtest/gtest.h>

#include "collision_core/narrow_phase/pose/segment_pose.h"
#include "tests/support/meshes.h"
#include "tests/support/truth/true_motion.h"

namespace collision::narrow_phase {
namespace {

const Instant kBase = Instant::FromNanoseconds(0);

std::shared_ptr<const shape::Shape> UnitCube() {
  static const std::shared_ptr<const shape::Shape> cube = shape::Shape::Build(Cube(1));
  return cube;
}

BodySegment Forward(const motion::SpaceTimeBound& bound,
                    std::shared_ptr<const shape::Shape> shape = UnitCube()) {
  BodySegment segment;
  segment.shape = std::move(shape);
  segment.ball.radius = bound.limits.radius;
  segment.ball.bounds.push_back(ForwardBall(bound, kBase));
  if (segment.shape) segment.turns.push_back(ForwardRotation(bound, kBase));
  return segment;
}

motion::SpaceTimeBound RandomBound(Random& random, double from_origin) {
  motion::SpaceTimeBound bound;
  bound.state.stamp = kBase;
  bound.state.p_WA = from_origin * Eigen::Vector3d(1, 0.5, 0.25) + 10 * random.UnitVector();
  bound.state.v_WA = random.LogUniform(1e-3, 100) * random.UnitVector();
  bound.state.w_WB = random.LogUniform(1e-3, 10) * random.UnitVector();
  const Quaternion q = RandomTurn(random);
  const double scale = random.LogUniform(0.5, 2);  // a quaternion need not be a unit one
  bound.state.q_WB = Eigen::Quaterniond(scale * double(q.w()), scale * double(q.x()),
                                        scale * double(q.y()), scale * double(q.z()));
  bound.limits.angular_acceleration_max = 0;
  bound.limits.radius = UnitCube()->facts().radius;
  return bound;
}

TruePose PoseOf(const motion::SpaceTimeBound& bound, Real t) {
  TruePose pose;
  pose.p = bound.state.p_WA.cast<Real>() + t * bound.state.v_WA.cast<Real>();
  const Vector turn = t * bound.state.w_WB.cast<Real>();
  const Quaternion start = bound.state.q_WB.cast<Real>().normalized();
  pose.q = Exponential(turn) * start;
  return pose;
}

TEST(RelativePose, RoundingIsWithinItsBound) {
  Random random(3);
  for (const double from_origin : {0.0, 1e3, 1e12}) {
    for (int i = 0; i < 200; ++i) {
      const motion::SpaceTimeBound a = RandomBound(random, from_origin),
                                   b = RandomBound(random, from_origin);
      const BodySegment of_a = Forward(a), of_b = Forward(b);
      const double delta = i % 4 == 0 ? 0 : random.Uniform(0, 2);
      const RelativePose pose = PoseAt(of_a, of_b, {0, 0, true}, delta);
      const TruePose true_a = PoseOf(a, delta), true_b = PoseOf(b, delta);
      EXPECT_EQ(pose.chord_A, 0);
      EXPECT_EQ(pose.chord_B, 0);
      EXPECT_EQ(pose.translation, 0);
      EXPECT_LT(pose.matrix_error, 1e-13);
      EXPECT_LT(pose.offset_error, 1e-11);  // far away, too: differences come first
      const Eigen::Vector3d x = 2 * random.UnitVector();
      // Differences first here as well: long double has 64 bits.
      const Vector d = (b.state.p_WA - a.state.p_WA).cast<Real>() +
                       Real(delta) * (b.state.v_WA.cast<Real>() - a.state.v_WA.cast<Real>());
      const Vector x_A = true_a.q.conjugate() * Vector(d + true_b.q * x.cast<Real>().eval());
      const double allowed = pose.offset_error + pose.matrix_error * x.norm();
      EXPECT_LE((pose.ToA(x).cast<Real>() - x_A).norm(), allowed);
      EXPECT_LE((pose.ToB(pose.ToA(x)) - x).norm(), 4 * allowed);
      const Vector in_world =
          pose.p_WA.cast<Real>() + pose.R_WA.cast<Real>() * x.cast<Real>().eval();
      EXPECT_LE((in_world - true_a.p - true_a.q * x.cast<Real>().eval()).norm(),
                2 * pose.error_A + 1e-4 * (from_origin > 1e6));
    }
  }
}

// Both reference points in one place: nothing but the matrix errs.
TEST(RelativePose, RoundingOfTheMatrixAloneIsWithinItsBound) {
  Random random(5);
  for (int i = 0; i < 1000; ++i) {
    const motion::SpaceTimeBound a = RandomBound(random, 0);
    motion::SpaceTimeBound b = RandomBound(random, 0);
    b.state.p_WA = a.state.p_WA;
    b.state.v_WA = a.state.v_WA;
    const double delta = random.Uniform(0, 2);
    const RelativePose pose = PoseAt(Forward(a), Forward(b), {0, 0, true}, delta);
    const TruePose true_a = PoseOf(a, delta), true_b = PoseOf(b, delta);
    EXPECT_LT(pose.offset_error, 1e-30);
    const Eigen::Vector3d x = random.UnitVector();
    const Vector turned = true_b.q * x.cast<Real>().eval();
    const Vector x_A = true_a.q.conjugate() * turned;
    EXPECT_LE((pose.ToA(x).cast<Real>() - x_A).norm(), pose.matrix_error + pose.offset_error);
  }
}

TEST(RelativePose, TurningMovesAPointByAtMostTheChord) {
  Random random(4);
  for (int i = 0; i < 300; ++i) {
    motion::SpaceTimeBound a = RandomBound(random, 0), b = RandomBound(random, 0);
    const double alpha = random.LogUniform(1e-3, 8);
    a.limits.angular_acceleration_max = b.limits.angular_acceleration_max = alpha;
    const double delta = random.Uniform(0, 1);
    const RelativePose pose = PoseAt(Forward(a), Forward(b), {0, 0, true}, delta);
    const double angle = 0.5 * alpha * delta * delta;
    const double chord = angle < std::numbers::pi ? 2 * std::sin(angle / 2) : 2;
    EXPECT_GE(pose.chord_A, chord * (1 - 1e-12));
    EXPECT_LE(pose.chord_A, chord * 1.001 + 1e-12);
    EXPECT_EQ(pose.chord_A, pose.chord_B);
  }
  motion::SpaceTimeBound unknown = RandomBound(random, 0);
  unknown.limits.angular_acceleration_max = -1;
  const RelativePose pose =
      PoseAt(Forward(unknown), Forward(RandomBound(random, 0)), {0, 0, true}, 0.5);
  EXPECT_EQ(pose.chord_A, 2);
  EXPECT_EQ(pose.chord_B, 0);
}

// Then it may be turned any way, and where it is is known all the same.
TEST(RelativePose, TurnsBeyondAllMeasureAreNotKnown) {
  Random random(6);
  motion::SpaceTimeBound a = RandomBound(random, 0), b = RandomBound(random, 0);
  for (const double turn : {0.5 * numeric::kRotationAngleMax, 2 * numeric::kRotationAngleMax,
                            1e12 * numeric::kRotationAngleMax}) {
    a.state.w_WB = turn * random.UnitVector();
    const RelativePose pose = PoseAt(Forward(a), Forward(b), {0, 0, true}, 1);
    EXPECT_EQ(pose.chord_A, turn > numeric::kRotationAngleMax ? 2 : 0);
    EXPECT_LT(pose.matrix_error, 1e-9);
    EXPECT_LT(pose.offset_error, 1e-8);
    const Eigen::Vector3d apart = b.state.p_WA + b.state.v_WA - a.state.p_WA - a.state.v_WA;
    EXPECT_NEAR(pose.p_AB.norm(), apart.norm(), 1e-9 * apart.norm());
  }
}

TEST(RelativePose, ABallDoesNotTurn) {
  Random random(5);
  motion::SpaceTimeBound a = RandomBound(random, 0), b = RandomBound(random, 0);
  a.limits.angular_acceleration_max = -1;
  const RelativePose pose = PoseAt(Forward(a, nullptr), Forward(b), {0, 0, true}, 1);
  EXPECT_EQ(pose.chord_A, 0);
  EXPECT_EQ(TurningReachOf(Forward(a, nullptr)), 0);
}

// Near the next state its bound is the better one; of each body by itself.
TEST(RelativePose, TheLeastUncertainBoundsAreTaken) {
  motion::SpaceTimeBound a;
  a.state.stamp = kBase;
  a.limits.acceleration_max = 1;
  a.limits.angular_acceleration_max = 1;
  motion::SpaceTimeBound next = a;
  next.state.stamp = Instant::FromNanoseconds(1000000000);
  BodySegment both = Forward(a);
  both.ball.bounds.push_back(BackwardBall(next, kBase));
  both.turns.push_back(BackwardRotation(next, kBase));
  const BodySegment first = Forward(a);
  const BoundChoice early = BestBounds(both, first, 0.25), late = BestBounds(first, both, 0.75);
  EXPECT_EQ(early.of_a, 0u);
  EXPECT_EQ(late.of_a, 0u);
  EXPECT_EQ(late.of_b, 1u);
  EXPECT_TRUE(late.certain);
  EXPECT_NEAR(PoseAt(first, both, late, 0.75).translation, 0.5 * (0.75 * 0.75 + 0.25 * 0.25),
              1e-12);
  EXPECT_FALSE(BestBounds(BodySegment(), first, 0).certain);
}

}  // namespace
}  // namespace collision::narrow_phase
