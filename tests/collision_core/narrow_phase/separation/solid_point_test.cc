// Goal:   a point within both bodies bounds how far they overlap, however little that is, and no
//         point does where they are apart.
// Method: cubes that overlap by 1e-15 to 1 in exact steps, posed anywhere; random points of random
//         bodies in long double.
#include "collision_core/narrow_phase/separation/solid_point.h"

#include <gtest/gtest.h>

#include "collision_core/narrow_phase/contact/contact_candidates.h"
#include "tests/collision_core/narrow_phase/promise_scene.h"
#include "tests/support/solids.h"

namespace collision::narrow_phase {
namespace {

using Eigen::Vector3d;

constexpr std::uint64_t kPlenty = 10'000'000;

TEST(SolidPoint, TellsHowDeepToTheLastBits) {
  const BodySegment cube = BodyOf(shape::Shape::Build(Cube(0.5)));
  const BodyTree surface(cube);
  for (const double depth : {0x1p-1, 0x1p-20, 0x1p-40, 0x1p-46}) {
    const RelativePose pose = PoseOf(Eigen::Matrix3d::Identity(), {1 - depth, 0.25, 0});
    WorkBudget work(kPlenty);
    const SolidPoint of_A = PointOfA(surface, {0.5, 0.125, 0}, &work);
    const SolidPoint of_B = PointOfB(surface, {-0.5, -0.125, 0}, &work);
    for (const SolidPoint& point : {of_A, of_B}) {
      const double upper = UpperBy(point, {surface, surface, pose}, &work);
      const double exact = -std::min(depth, 0.375);  // its side may be nearer than its face
      EXPECT_GE(upper, exact);
      EXPECT_LE(upper, exact + 1e-14);
    }
    EXPECT_GE(work.spent(), 4 * kPointUnits);
  }
}

TEST(SolidPoint, NeverDeeperThanItIs) {
  int deep = 0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const double size = random.LogUniform(0.01, 100);
    const BodySegment a = BodyOf(RandomShape(random, size), size),
                      b = BodyOf(RandomShape(random, size), size);
    RelativePose pose = PoseOf(RandomTurn(random).cast<double>().toRotationMatrix(),
                               size * random.Uniform(0, 2) * random.UnitVector());
    pose.chord_A = random.Chance(0.5) ? 0 : 0.01;
    pose.chord_B = random.Chance(0.5) ? 0 : 0.01;
    const BodyTree of_a(a), of_b(b);
    WorkBudget work(kPlenty);
    const Vector3d x = size * random.Uniform(0, 1) * random.UnitVector();
    const bool from_A = random.Chance(0.5);
    const SolidPoint point = from_A ? PointOfA(of_a, x, &work) : PointOfB(of_b, x, &work);
    const double upper = UpperBy(point, {of_a, of_b, pose}, &work);
    deep += upper < 0;
    // Both bodies turned by as much as they may have.
    TruePose pose_A, pose_B;
    pose_A.q = Exponential(pose.chord_A * RandomUnit(random));
    const Quaternion q_B(Eigen::Matrix<Real, 3, 3>(pose.R_AB.cast<Real>()));
    pose_B.q = Exponential(pose.chord_B * RandomUnit(random)) * q_B.normalized();
    pose_B.p = pose.p_AB.cast<Real>();
    const TrueBody true_a(a.shape.get(), a.ball.radius, pose_A),
        true_b(b.shape.get(), b.ball.radius, pose_B);
    if (upper >= 0) {
      EXPECT_LE(SolidDistance(true_a, true_b), upper + 1e-12 * size);
      continue;
    }
    for (int i = 0; i < 6; ++i) {
      const Vector by = Vector::Unit(i / 2) * ((i % 2 ? 1 : -1) * -upper * 0.999L);
      EXPECT_EQ(SolidDistance(true_a, true_b.Moved(by)), 0) << upper;
    }
  }
  EXPECT_GT(deep, 40);
}

TEST(SolidPoint, OpenSurfacesHaveNoInside) {
  const BodySegment sheet = BodyOf(shape::Shape::Build(Sheet(1, 2)));
  const BodySegment cube = BodyOf(shape::Shape::Build(Cube(0.5)));
  WorkBudget work(kPlenty);
  EXPECT_GE(SignedDistanceTo(BodyTree(sheet), {0.1, 0.1, 0}, &work), 0);
  EXPECT_LE(SignedDistanceTo(BodyTree(cube), {0.1, 0.1, 0}, &work), -0.4 + 1e-15);
  EXPECT_LE(SignedDistanceTo(BodyTree(BodyOf(nullptr, 2)), {0.5, 0, 0}, &work), -1.5 + 1e-15);
}

// The depth that the best of the proposed points shows when B has come nearer by `step`.
double DepthAfter(const BodySegment& a, const BodySegment& b, const Eigen::Matrix3d& matrix,
                  Vector3d offset, const Vector3d& step) {
  const BodyTree of_a(a), of_b(b);
  WorkBudget work(kPlenty);
  const auto candidates =
      FindContactCandidates({of_a, of_b, PoseOf(matrix, offset)}, 1e-9, {}, &work);
  const RelativePose after = PoseOf(matrix, offset + step);
  double upper = numeric::kInfinity;
  for (const ContactCandidate& candidate : candidates) {
    upper = std::min(upper, UpperBy(candidate.point, {of_a, of_b, after}, &work));
  }
  return -upper;
}

TEST(FindContactCandidates, PointsWhereFacesEdgesAndCornersOverlapSoon) {
  const BodySegment a = BodyOf(shape::Shape::Build(Cube(0.5)));
  const BodySegment fine = BodyOf(shape::Shape::Build(Subdivided(Cube(0.5), 3)));
  const Vector3d step(-1e-6, 0, 0);
  const double root = std::sqrt(0.5);
  const auto turned = [](double angle, const Vector3d& axis) {
    return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
  };
  const double quarter = std::numbers::pi / 4;
  for (const BodySegment* b : {&a, &fine}) {
    const Eigen::Matrix3d same = Eigen::Matrix3d::Identity();
    EXPECT_GT(DepthAfter(a, *b, same, {1, 0, 0}, step), 0.99e-6);
    EXPECT_GT(DepthAfter(*b, a, same, {1, 0.3, -0.2}, step), 0.99e-6);
    EXPECT_GT(DepthAfter(a, *b, same, {1, 0.9999, 0.9999}, step), 0.99e-6);
    // An edge goes into the face by as much; the ball about its point does not reach its sides.
    EXPECT_GT(DepthAfter(a, *b, turned(quarter, {0, 0, 1}), {0.5 + root, 0, 0}, step), 0.9e-6);
    EXPECT_GT(DepthAfter(a, *b, turned(quarter, {0, 0, 1}), {0.5 + root, 0.5, 0}, step), 0.3e-6);
  }
  // Edges that coincide, to the last bits, and edges that cross.
  const Vector3d bit(-0x1p-40, -0x1p-40, 0);
  EXPECT_GE(DepthAfter(a, a, Eigen::Matrix3d::Identity(), {1, 1, 0}, bit), 0.99 * 0x1p-40);
  EXPECT_GE(DepthAfter(a, a, Eigen::Matrix3d::Identity(), {1, 1, 0.3}, bit), 0.99 * 0x1p-40);
  const Eigen::Matrix3d back = turned(-quarter, {0, 1, 0});
  EXPECT_GT(DepthAfter(a, a, back * turned(quarter, {0, 0, 1}), back * Vector3d(2 * root, 0, 0),
                       back * step),
            0.4e-6);
  // Nothing is near.
  WorkBudget work(kPlenty);
  EXPECT_TRUE(FindContactCandidates(
                  {BodyTree(a), BodyTree(a), PoseOf(Eigen::Matrix3d::Identity(), {1.1, 0, 0})},
                  1e-9, {}, &work)
                  .empty());
}

// With very many solids the search visits no more than the budget allows; its answer is still an
// upper bound.
TEST(SolidPoint, ManySolidsStayWithinTheBudget) {
  std::vector<shape::ConvexSolid> solids;
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3d at(0.01 * i, 0, 0), half(0.004, 0.004, 0.004);
    solids.push_back(SolidBox(at - half, at + half));
  }
  BodySegment segment;
  segment.shape = shape::Shape::Compound(nullptr, std::move(solids));
  segment.ball.radius = segment.shape->facts().radius;
  const BodyTree surface(segment);
  for (const std::uint64_t allowed : {0, 10, 500}) {
    WorkBudget work(allowed);
    const double distance = SignedDistanceTo(surface, {0, 1, 0}, &work);
    EXPECT_LT(work.spent(), allowed + kBatchUnits);
    EXPECT_GE(distance, 1 - 0.004);
  }
}

}  // namespace
}  // namespace collision::narrow_phase
