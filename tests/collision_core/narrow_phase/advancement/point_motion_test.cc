// Goal:   the velocities of two bodies' points are those of rigid motion, no two points are faster
//         than is said, and everything that is uncertain counts into what may be used up.
// Method: two turning bodies with dyadic velocities; random points of theirs; each uncertainty
//         alone.
#include "collision_core/narrow_phase/advancement/point_motion.h"

#include <gtest/gtest.h>

#include "tests/support/meshes.h"
#include "tests/support/truth/true_distance.h"

namespace collision::narrow_phase {
namespace {

class PointMotionTest : public testing::Test {
 protected:
  PointMotionTest() {
    swept_.pose.p_AB = {4, 0, 0};
    swept_.velocity = {-1, 0.5, 0};
    swept_.spin_A = {0, 0, 2};
    swept_.spin_B = {0, -1, 0};
  }

  PointMotion Motion() const { return PointMotion({a_, b_, swept_}); }

  const BodySegment segment_ = BodyOf(shape::Shape::Build(Cube(1)));
  const BodyTree a_{segment_}, b_{segment_};
  SweptPose swept_;
};

TEST_F(PointMotionTest, VelocitiesAreThoseOfRigidBodies) {
  EXPECT_EQ(Motion().VelocityOfA({1, 0, 0}), Eigen::Vector3d(0, 2, 0));
  EXPECT_EQ(Motion().VelocityOfB({4, 0, 0}), swept_.velocity);
  EXPECT_EQ(Motion().VelocityOfB({5, 0, 0}), Eigen::Vector3d(-1, 0.5, 1));
}

TEST_F(PointMotionTest, NoTwoPointsAreFaster) {
  const PointMotion motion = Motion();
  Random random(1);
  double most = 0;
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3d x = a_.reach() * random.UnitVector();
    const Eigen::Vector3d y = swept_.pose.p_AB + b_.reach() * random.UnitVector();
    most = std::max(most, (motion.VelocityOfB(y) - motion.VelocityOfA(x)).norm());
  }
  EXPECT_LE(most, motion.fastest());
  EXPECT_GE(most, 0.8 * motion.fastest()) << "not idle";
}

TEST_F(PointMotionTest, OnlyRoundingIsUsedUpWhereNothingIsUncertain) {
  const SweptPose::Growth used = Motion().UsedUp();
  EXPECT_GT(used.c0, 0);
  EXPECT_LT(used.c0, 1e-13);
  EXPECT_GT(used.c1, 0);
  EXPECT_LT(used.c1, 1e-13);
  EXPECT_EQ(used.c2, 0);
}

TEST_F(PointMotionTest, EachUncertaintyCounts) {
  swept_.translation = {0.5, 0.25, 0.125};
  swept_.turning_A = {1, 2, 4};
  swept_.turning_B = {8, 16, 32};
  swept_.velocity_error = 64;
  const SweptPose::Growth used = Motion().UsedUp(100, 2, 0.5);
  EXPECT_NEAR(used.c0, 100 + 0.5 + 2 * 1 + 0.5 * 8, 1e-9);
  EXPECT_NEAR(used.c1, 64 + 0.25 + 2 * 2 + 0.5 * 16, 1e-9);
  EXPECT_NEAR(used.c2, 0.125 + 2 * 4 + 0.5 * 32, 1e-9);
}

TEST_F(PointMotionTest, AnyTwoPointsAreAsFarAsTheBodiesReach) {
  swept_.turning_A = {1, 0, 0};
  swept_.turning_B = {2, 0, 0};
  EXPECT_NEAR(Motion().UsedUp().c0, a_.reach() + 2 * b_.reach(), 1e-9);
}

}  // namespace
}  // namespace collision::narrow_phase
