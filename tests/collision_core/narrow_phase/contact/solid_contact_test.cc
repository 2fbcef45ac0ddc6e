// Goal:   solids that are round, alone and several together, meet when closed formulas say so; what
//         they are never touches late, whatever is around it.
// Method: balls, capsules, ellipsoids and compounds in motions with closed answers.
#include "tests/collision_core/narrow_phase/contact_cases.h"

namespace collision::narrow_phase {
namespace {

shape::ConvexDescription Round(geometry::ConvexCore core, const Vector3d& half, double rounding) {
  shape::ConvexDescription description;
  description.core = core;
  description.half = half;
  description.rounding = rounding;
  return description;
}

Body Of(std::vector<shape::ConvexDescription> descriptions) {
  std::vector<shape::ConvexSolid> solids;
  for (const shape::ConvexDescription& d : descriptions) {
    EXPECT_EQ(RefusalOf(d), std::nullopt);
    solids.push_back(shape::ConvexSolid::Build(d));
  }
  return {shape::Shape::Compound(nullptr, std::move(solids))};
}

Body Coming(Body body, const Vector3d& from = {5, 0, 0}) {
  body.p = from;
  body.v = {-10, 0, 0};
  return body;
}

const shape::ConvexDescription kBall = Round(geometry::ConvexCore::kPoint, {0, 0, 0}, 0.5);
const shape::ConvexDescription kCapsule = Round(geometry::ConvexCore::kSegment, {0, 0, 1}, 0.25);
const shape::ConvexDescription kEgg = Round(geometry::ConvexCore::kEllipsoid, {1, 0.5, 0.25}, 0);

TEST(SolidContact, RoundThingsHeadOn) {
  const Body ball = Of({kBall}), capsule = Of({kCapsule}), egg = Of({kEgg});
  Body lying = capsule;
  lying.q = Turn(90, {1, 0, 0});
  ExpectContact(Find(ball, Coming(ball), 1), 0.4L, 0.6L);
  ExpectContact(Find(ball, Coming({nullptr, 0.5}), 1), 0.4L, 0.6L);
  ExpectContact(Find(capsule, Coming(ball), 1), 0.425L, 0.575L);
  ExpectContact(Find(capsule, Coming(capsule), 1), 0.45L, 0.55L);
  ExpectContact(Find(capsule, Coming(lying), 1), 0.45L, 0.55L);
  ExpectContact(Find({UnitCube()}, Coming(capsule), 1), 0.425L, 0.575L);
  ExpectContact(Find({CubeOf(Made::kSolid)}, Coming(capsule), 1), 0.425L, 0.575L);
  ExpectContact(Find(egg, Coming(ball), 1), 0.35L, 0.65L);
  ExpectContact(Find(egg, Coming(egg), 1), 0.3L, 0.7L);
}

TEST(SolidContact, BallsThatPassBesideEachOther) {
  const Real half = std::sqrt(1 - 0.96L * 0.96L);
  const Body ball = Of({kBall});
  ExpectContact(Find(ball, Coming(ball, {5, 0.96, 0}), 1), (5 - half) / 10, (5 + half) / 10);
  EXPECT_EQ(Find(ball, Coming(ball, {5, 1.000001, 0}), 1).status, ContactStatus::kFree);
}

// A capsule of half-length 2 and radius 0.1 that turns meets a ball of 0.2 m as the bar does.
TEST(SolidContact, TurningCapsuleMeetsABall) {
  shape::ConvexDescription rod = Round(geometry::ConvexCore::kSegment, {0, 0, 2}, 0.1);
  rod.q_BS = Turn(90, {0, 1, 0});
  const Real begin = std::acos(Real(0.3));
  for (const bool other_too : {false, true}) {
    Body bar =
        other_too ? Of({rod, Round(geometry::ConvexCore::kPoint, {0, 0, 0}, 0.3)}) : Of({rod});
    bar.w = {0, 0, 1};
    ExpectContact(Find(bar, {nullptr, 0.2, {0, 1, 0}}, 2), begin, M_PIl - begin);
    Body ball = Of({Round(geometry::ConvexCore::kPoint, {0, 0, 0}, 0.2)});
    ball.p = {0, 1, 0};
    ExpectContact(Find(ball, bar, 2, Result::kAtBoth), begin, M_PIl - begin);
    bar.w = {0, 0, 350 * kPi / 180 / 0.25};
    const TimeOfContactResult found = Find(bar, ball, 0.25, Result::kAtBoth);
    ASSERT_EQ(found.status, ContactStatus::kContact);
    ExpectWithin(found.begin, begin / Real(bar.w.z()), 1e-12, "begin");
  }
}

// Wheels on a body over a mesh: what meets it first is a wheel, the left one.
TEST(SolidContact, CompoundOverTriangles) {
  shape::ConvexDescription wheel = Round(geometry::ConvexCore::kPoint, {0, 0, 0}, 0.25);
  std::vector<shape::ConvexDescription> parts = {
      Round(geometry::ConvexCore::kBox, {1, 0.5, 0.25}, 0.0625)};
  for (const double x : {-1, 1}) {
    for (const double y : {-0.5, 0.5}) {
      wheel.p_BS = {x, y, x == 1 && y == 0.5 ? -0.5 : -0.375};
      parts.push_back(wheel);
    }
  }
  Body rover = Of(parts);
  rover.p = {0, 0, 2};
  rover.v = {0, 0, -1};
  const Body sheet{shape::Shape::Build(Sheet(4, 8))};
  const TimeOfContactResult found = Find(sheet, rover, 2);
  ASSERT_EQ(found.status, ContactStatus::kContact);
  ExpectWithin(found.begin, 1.25L, 1e-12, "begin");
  const Body ground{BoxOf(Made::kTriangles, {-4, -4, -1}, {4, 4, 0})};
  const TimeOfContactResult landed = Find(ground, rover, 2);
  ASSERT_EQ(landed.status, ContactStatus::kContact);
  ExpectWithin(landed.begin, 1.25L, 1e-12, "begin");
}

// All of it within a hollow of triangles, and within solid triangles.
TEST(SolidContact, SolidsInsideMeshes) {
  const Body big{shape::Shape::Build(Cube(4))};
  Body ball = Of({kBall, kCapsule});
  ball.p = {1, 1, 1};
  EXPECT_EQ(Find(big, ball, 1).begin.upper, 0);
  EXPECT_EQ(Find(ball, big, 1).status, ContactStatus::kContact);
  Body mesh{shape::Shape::Build(Cube(0.125))};
  const Body around = Of({Round(geometry::ConvexCore::kEllipsoid, {2, 2, 3}, 0)});
  EXPECT_EQ(Find(around, mesh, 1).begin.upper, 0);
  EXPECT_EQ(Find(mesh, around, 1).status, ContactStatus::kContact);
  ball.p = {9, 0, 0};
  EXPECT_EQ(Find(big, ball, 1).status, ContactStatus::kFree);
}

}  // namespace
}  // namespace collision::narrow_phase
