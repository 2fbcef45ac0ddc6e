// Goal:   the answer for one solid inside another holds whatever the budget is, and the budget
//         holds.
// Method: a small box in the wall of a hollow cube, where the surfaces are apart and the solids
//         overlap as deep as is known in closed form; a cloud of 1,000 parts in a cavity.
#include <gtest/gtest.h>

#include "collision_core/narrow_phase/contact/shape_contact.h"
#include "collision_core/narrow_phase/separation/refinement.h"
#include "tests/collision_core/narrow_phase/posed_body.h"

namespace collision::narrow_phase {
namespace {

using Eigen::Vector3d;

geometry::TriangleMesh Hollow(const Vector3d& outside, const Vector3d& inside) {
  return Joined(Box(-outside, outside), Reversed(Box(-inside, inside)));
}

class ContainmentTest : public testing::TestWithParam<sphere_tree::TreeBuilder> {
 protected:
  static BodySegment Segment(const geometry::TriangleMesh& mesh, const Vector3d& at) {
    sphere_tree::ShapeOptions options;
    options.builder = GetParam();
    Posed posed;
    posed.shape = shape::Shape::Build(mesh, options);
    posed.radius = posed.shape->facts().radius;
    posed.pose.p = at.cast<Real>();
    return posed.Segment();
  }
};

INSTANTIATE_TEST_SUITE_P(Builders, ContainmentTest,
                         testing::Values(sphere_tree::TreeBuilder::kOctree,
                                         sphere_tree::TreeBuilder::kFitted,
                                         sphere_tree::TreeBuilder::kMedianSplit));

// The box of half-lengths h stands 1 - y - h below the cube's upper side, and as much as it is wide
// takes it out that way; the way into the cavity is longer or as long.
TEST_P(ContainmentTest, InAWallTheBracketIsInOrderAndHoldsTheDepth) {
  const Vector3d half(0.05, 0.006, 0.003);
  const BodySegment box = Segment(Box(-half, half), {0.2, 0.75, 0.1});
  const BodySegment wall = Segment(Hollow({1, 1, 1}, {0.96, 0.54, 0.95}), {0, 0, 0});
  const double depth = 0.75 + half.y() - 0.54;  // into the cavity
  const double apart = 0.75 - half.y() - 0.54;  // the surfaces
  int certain = 0;
  for (std::uint64_t units = 1; units < 1500; units += 7) {
    WorkBudget work(units);
    const numeric::Interval found = ShapeProximity(box, wall, 0, &work).separation;
    EXPECT_LE(found.lower, -depth) << units;
    EXPECT_GE(found.upper, -depth) << units;
    certain += found.upper <= 0;
    WorkBudget judging(units);
    const SegmentResult balls = EvaluateBallSegment(box.ball, wall.ball, 1);
    const ShapeSegmentResult verdict = EvaluateShapeSegment(box, wall, 1, balls, &judging);
    EXPECT_LE(verdict.times.free_until, 0);
    if (verdict.examined) {
      EXPECT_LE(verdict.nearest.separation.lower, -depth) << units;
      EXPECT_GE(verdict.nearest.separation.upper, -depth) << units;
    }
  }
  EXPECT_GT(certain, 100);
  WorkBudget all(100000);
  const BodyTree a(box), b(wall);
  const RelativePose pose = PoseAt(box, wall, {0, 0, true}, 0);
  EXPECT_LE(QuerySeparation({a, b, pose}, Goal::kNearest, &all).lower, apart);
  EXPECT_EQ(DecideAt({a, b, pose}, &all).verdict, Verdict::kTouching);
  Refinement refinement(RefinementOrder::kLargestFirst);
  refinement.Add({a, b, pose}, 1, Goal::kNearest, {}, &all);
  refinement.Refine(&all);
  EXPECT_GE(refinement.TotalWidth(), 0);
  EXPECT_LE(refinement.TotalWidth(), 1e-12);
}

// Testing for each part whether it is in the wall would cost 100 units: beyond the budget.
// Two parts of one body, far apart: one in the wall, where no spheres tell, one beyond the box.
TEST_P(ContainmentTest, APartInsideIsFoundThoughAnotherIsFarOutside) {
  const Vector3d half(0.05, 0.006, 0.003), away(0, 5, 0);
  const BodySegment parts =
      Segment(Joined(Box(-half, half), Box(away - half, away + half)), {0.2, 0.75, 0.1});
  const BodySegment wall = Segment(Hollow({1, 1, 1}, {0.96, 0.54, 0.95}), {0, 0, 0});
  WorkBudget work(100'000);
  const numeric::Interval found = ShapeProximity(parts, wall, 0, &work).separation;
  EXPECT_LE(found.upper, 0);
}

TEST_P(ContainmentTest, ManyPartsStayWithinTheBudget) {
  geometry::TriangleMesh dust;
  for (int i = 0; i < 1000; ++i) {
    const Vector3d lower((i % 10 - 4.5) / 10, (i / 10 % 10 - 4.5) / 10, (i / 100 - 4.5) / 10);
    const Vector3d upper = lower + Vector3d(0.01, 0.01, 0.01);
    const auto first = static_cast<std::uint32_t>(dust.vertices.size());
    for (const Vector3d& p :
         {lower, Vector3d(upper.x(), lower.y(), lower.z()),
          Vector3d(lower.x(), upper.y(), lower.z()), Vector3d(lower.x(), lower.y(), upper.z())}) {
      dust.vertices.push_back(p);
    }
    for (const auto& [i0, i1, i2] :
         {std::array{0u, 2u, 1u}, {0u, 1u, 3u}, {1u, 2u, 3u}, {2u, 0u, 3u}}) {
      dust.triangles.push_back({first + i0, first + i1, first + i2});
    }
  }
  const BodySegment cube = Segment(Hollow({2, 2, 2}, {1.5, 1.5, 1.5}), {0, 0, 0});
  const BodySegment cloud = Segment(dust, {0, 0, 0});
  const RelativePose pose = PoseAt(cube, cloud, {0, 0, true}, 0);
  constexpr std::uint64_t kBatch = 500;
  for (const std::uint64_t units : {0u, 100u, 3000u, 20000u}) {
    WorkBudget work(units);
    const Decision decision = DecideAt({BodyTree(cube), BodyTree(cloud), pose}, &work);
    EXPECT_EQ(decision.verdict, Verdict::kUndecided);
    EXPECT_TRUE(decision.bracket.exhausted);
    EXPECT_LE(work.spent(), units + kBatch);
  }
  WorkBudget enough(1000000);
  EXPECT_EQ(DecideAt({BodyTree(cube), BodyTree(cloud), pose}, &enough).verdict, Verdict::kApart);
}

}  // namespace
}  // namespace collision::narrow_phase
