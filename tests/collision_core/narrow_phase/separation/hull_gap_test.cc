#include "collision_core/narrow_phase/separation/hull_gap.h"

#include <gtest/gtest.h>

#include "collision_core/narrow_phase/separation/containment.h"
#include "tests/collision_core/narrow_phase/posed_body.h"
#include "tests/support/random.h"

namespace collision::narrow_phase {
namespace {

constexpr std::uint64_t kUnlimited = std::uint64_t{1} << 60;

BodySegment At(std::shared_ptr<const shape::Shape> shape) {
  BodySegment body;
  body.shape = std::move(shape);
  return body;
}

double GapAt(const BodyTree& a, const BodyTree& b, const RelativePose& pose, double enough) {
  WorkBudget work(kUnlimited);
  const double gap = HullGapOf({a, b, pose}, enough, &work);
  EXPECT_LE(work.spent(), kHullDirectionsMax * kHullDirectionUnits);
  return gap;
}

/// An upper bound of the distance, by the trees alone.
double MostApart(const BodyTree& a, const BodyTree& b, const RelativePose& pose) {
  WorkBudget work(kUnlimited);
  return QuerySeparation({a, b, pose}, Goal::kNearest, &work).upper;
}

// Goal:   never more than the distance; and mostly it is seen that bodies are apart.
// Method: random bodies a little apart, the distance by their trees.
TEST(HullGap, NeverMoreThanTheDistance) {
  Random random(411);
  int apart = 0, seen = 0;
  for (int i = 0; i < 1500; ++i) {
    const double size = random.LogUniform(1e-3, 1e3);
    const Posed of_a = RandomBody(random, size, {0, 0, 0});
    const Posed of_b = RandomBody(random, size * random.LogUniform(0.1, 10),
                                  size * random.Uniform(0, 6) * random.UnitVector().cast<Real>());
    if (!of_a.shape && !of_b.shape) continue;
    const BodySegment segment_a = of_a.Segment(), segment_b = of_b.Segment();
    const BodyTree a(segment_a), b(segment_b);
    const RelativePose pose = PoseBetween(segment_a, segment_b);
    const double most = MostApart(a, b, pose);
    const double gap = GapAt(a, b, pose, i % 2 == 0 ? 0 : numeric::kInfinity);
    EXPECT_LE(gap, std::max(0.0, most) + pose.translation) << i;
    apart += most > 0.2 * size;
    seen += most > 0.2 * size && gap > 0;
  }
  EXPECT_GE(apart, 300);
  EXPECT_GE(seen, 0.9 * apart);
}

// Goal:   cubes face to face: the gap to within single precision, never more of it; where less than
//         that is left it is not claimed.
TEST(HullGap, CubesFaceToFace) {
  const BodySegment cube = At(shape::Shape::Build(Cube(1)));
  const BodyTree a(cube), b(cube);
  for (const double gap : {1e-9, 1e-6, 1e-3, 0.1, 5.0, 1e6}) {
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      for (const double sign : {-1.0, 1.0}) {
        Eigen::Vector3d offset(0.1, 0.2, -0.3);
        offset[axis] = sign * (2 + gap);
        const double found = GapAt(a, b, PoseOf(Eigen::Matrix3d::Identity(), offset), 0);
        EXPECT_LE(found, gap);
        if (gap <= 1e-6 || gap >= 0.1) {
          EXPECT_EQ(found > 0, gap >= 0.1);
        }
      }
    }
  }
}

// Goal:   along the line that is tried first all is known but rounding.
TEST(HullGap, NotIdle) {
  const BodySegment cube = At(shape::Shape::Build(Cube(1)));
  const BodyTree a(cube), b(cube);
  const RelativePose pose = PoseOf(Eigen::Matrix3d::Identity(), {2.5, 0, 0});
  EXPECT_GE(GapAt(a, b, pose, 0), 0.5 - 1e-3);
  RelativePose turning = pose;
  turning.chord_A = 0.01, turning.chord_B = 0.02;
  const double reach = a.reach();
  EXPECT_LE(GapAt(a, b, turning, 0), 0.5 - 0.03 * reach);
  EXPECT_GE(GapAt(a, b, turning, 0), 0.5 - 0.03 * reach - 1e-3);
}

// Goal:   what either body may be turned by is counted: however it really is turned, the distance
//         is no less than the reported one.
// Method: rods side by side, B turned by some of the angle that was allowed.
TEST(HullGap, HoldsForTurnedBodies) {
  Random random(412);
  const BodySegment rod = At(shape::Shape::Build(Rod(3, 0.1)));
  const BodyTree a(rod), b(rod);
  int positive = 0;
  for (int i = 0; i < 500; ++i) {
    RelativePose pose =
        PoseOf(Eigen::Matrix3d::Identity(), {random.Uniform(0, 0.1), random.Uniform(0.2, 1), 0});
    const double angle = random.LogUniform(1e-3, 0.5);
    const Eigen::AngleAxisd turn(angle, random.Chance(0.5) ? Eigen::Vector3d(0, 0, 1)
                                                           : Eigen::Vector3d(random.UnitVector()));
    const RelativePose turned = PoseOf(turn.toRotationMatrix(), pose.p_AB);
    pose.chord_B = 2 * std::sin(angle / 2) * (1 + 1e-12);
    const double gap = GapAt(a, b, pose, 0);
    EXPECT_LE(gap, std::max(0.0, MostApart(a, b, turned)));
    positive += gap > 0;
  }
  EXPECT_GE(positive, 50);
}

// Goal:   bodies within each other, interlocked, at one place, or far beyond single precision: no
//         gap is claimed that is not there, and no answer is not a number.
TEST(HullGap, NoGap) {
  const BodySegment hollow = At(shape::Shape::Build(HollowCube(1, 0.9)));
  const BodySegment small = At(shape::Shape::Build(Cube(0.2)));
  BodySegment ball;
  ball.ball.radius = 0.1;
  const BodyTree a(hollow), b(small), c(ball);
  for (const Eigen::Vector3d& offset :
       {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0.3, 0, 0), Eigen::Vector3d(0.5, 0.5, 0.5)}) {
    const RelativePose pose = PoseOf(Eigen::Matrix3d::Identity(), offset);
    EXPECT_LE(GapAt(a, b, pose, 0), 0);
    EXPECT_LE(GapAt(b, a, pose, 0), 0);
    EXPECT_LE(GapAt(a, c, pose, 0), 0);
    EXPECT_LE(GapAt(c, c, pose, 0), std::max(0.0, offset.norm() - 0.2));
  }
  const RelativePose far = PoseOf(Eigen::Matrix3d::Identity(), {1e200, 0, 0});
  EXPECT_EQ(GapAt(a, b, far, 0), -numeric::kInfinity);
}

// Goal:   what single precision loses of a long way is counted.
// Method: small balls a thousand times farther apart than they are large.
TEST(HullGap, BallsFarApart) {
  Random random(414);
  BodySegment ball;
  ball.ball.radius = 1;
  const BodyTree a(ball), b(ball);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d offset = random.Uniform(1e3, 1e4) * random.UnitVector();
    const double gap = GapAt(a, b, PoseOf(Eigen::Matrix3d::Identity(), offset), 0);
    EXPECT_LE(gap, offset.norm() - 2);
    EXPECT_GE(gap, (offset.norm() - 2) * (1 - 1e-4));
  }
}

// Goal:   nothing is spent that is not there.
TEST(HullGap, KeepsToItsBudget) {
  const BodySegment rod = At(shape::Shape::Build(Rod(3, 0.1)));
  const BodyTree a(rod), b(rod);
  const RelativePose pose = PoseOf(Eigen::Matrix3d::Identity(), {0.05, 0.15, 0});
  for (std::uint64_t allowed = 0; allowed < 10; ++allowed) {
    WorkBudget work(allowed);
    EXPECT_LE(HullGapOf({a, b, pose}, 0, &work), 0);
    EXPECT_LE(work.spent(), allowed);
  }
}

// Goal:   what is decided by the convex bodies is what the trees decide.
// Method: random bodies; the surfaces' distance and what is inside what.
TEST(HullGap, DecidesAsTheTreesDo) {
  Random random(413);
  int by_hull = 0;
  for (int i = 0; i < 1500; ++i) {
    const Posed of_a = RandomBody(random, 1, {0, 0, 0});
    const Posed of_b = RandomBody(random, random.LogUniform(0.1, 2),
                                  random.Uniform(0, 4) * random.UnitVector().cast<Real>());
    if (!of_a.shape && !of_b.shape) continue;
    const BodySegment segment_a = of_a.Segment(), segment_b = of_b.Segment();
    const BodyTree a(segment_a), b(segment_b);
    const RelativePose pose = PoseBetween(segment_a, segment_b);
    WorkBudget work(kUnlimited);
    const Decision decision = DecideAt({a, b, pose}, &work);
    if (decision.verdict != Verdict::kApart) continue;
    const SeparationBracket bracket = QuerySeparation({a, b, pose}, Goal::kNearest, &work);
    EXPECT_GT(bracket.upper, 0);
    EXPECT_LE(decision.bracket.lower, bracket.upper);
    EXPECT_LE(bracket.lower, decision.bracket.upper);
    EXPECT_TRUE(TestContainment({a, b, pose}, &work).neither);
    by_hull += GapAt(a, b, pose, pose.translation) > pose.translation;
  }
  EXPECT_GE(by_hull, 100);
}

}  // namespace
}  // namespace collision::narrow_phase
