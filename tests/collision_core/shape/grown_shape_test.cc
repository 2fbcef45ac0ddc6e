// Goal:   a grown shape is the body and all points within its margin: distances are less by the two
//         margins, contact begins where they are used up, and the inside stays inside.
// Method: surfaces and solids at random poses, whose distance without margins is certified; a cube
//         of triangles beside the same cube as a solid.
#include "collision_core/shape/grown_shape.h"

#include <gtest/gtest.h>

#include "collision_core/narrow_phase/separation/separation.h"
#include "tests/support/meshes.h"
#include "tests/support/random.h"

namespace collision::shape {
namespace {

using Eigen::Vector3d;

std::shared_ptr<const Shape> SolidCube(double half) {
  return Shape::Compound(nullptr, {ConvexSolid::Build({.core = geometry::ConvexCore::kBox,
                                                       .half = {half, half, half},
                                                       .points = {}})});
}

std::shared_ptr<const Shape> Capsule() {
  return Shape::Compound(nullptr, {ConvexSolid::Build({.core = geometry::ConvexCore::kSegment,
                                                       .half = {0, 0, 1},
                                                       .points = {},
                                                       .rounding = 0.25})});
}

numeric::Interval Between(const std::shared_ptr<const Shape>& a,
                          const std::shared_ptr<const Shape>& b,
                          const narrow_phase::RelativePose& pose) {
  narrow_phase::BodySegment of_a, of_b;
  of_a.shape = a, of_b.shape = b;
  const narrow_phase::BodyTree tree_a(of_a), tree_b(of_b);
  WorkBudget work(1'000'000);
  const auto found = narrow_phase::BracketSeparation({tree_a, tree_b, pose}, {}, &work);
  return {found.lower, found.upper};
}

bool Touch(const std::shared_ptr<const Shape>& a, const std::shared_ptr<const Shape>& b,
           const narrow_phase::RelativePose& pose) {
  narrow_phase::BodySegment of_a, of_b;
  of_a.shape = a, of_b.shape = b;
  const narrow_phase::BodyTree tree_a(of_a), tree_b(of_b);
  WorkBudget work(1'000'000);
  return narrow_phase::DecideAt({tree_a, tree_b, pose}, &work).verdict ==
         narrow_phase::Verdict::kTouching;
}

TEST(GrownShape, DistancesAreLessByBothMargins) {
  Random random(5);
  const std::shared_ptr<const Shape> shapes[] = {Shape::Build(LShape()), Shape::Build(Sheet(1, 4)),
                                                 SolidCube(0.5), Capsule()};
  int apart = 0, touching = 0;
  for (int i = 0; i < 400; ++i) {
    const auto &a = shapes[random.Below(4)], &b = shapes[random.Below(4)];
    const double margin_a = random.LogUniform(1e-3, 1), margin_b = random.LogUniform(1e-3, 1);
    narrow_phase::RelativePose pose;
    pose.p_AB = random.UnitVector() * random.Uniform(1.5, 4);
    const numeric::Interval plain = Between(a, b, pose);
    const auto grown_a = GrownShape(a, margin_a), grown_b = GrownShape(b, margin_b);
    const numeric::Interval grown = Between(grown_a, grown_b, pose);
    const double both = margin_a + margin_b, slack = 1e-12;
    if (plain.lower > both + 1e-9) {
      ++apart;
      EXPECT_LE(grown.lower, plain.upper - both + slack) << i;
      EXPECT_GE(grown.upper, plain.lower - both - slack) << i;
      EXPECT_FALSE(Touch(grown_a, grown_b, pose)) << i;
    } else if (plain.upper < both - 1e-9) {
      ++touching;
      EXPECT_TRUE(Touch(grown_a, grown_b, pose)) << i;
      EXPECT_LE(grown.lower, 0) << i;
    }
  }
  EXPECT_GT(apart, 50);
  EXPECT_GT(touching, 50);
}

TEST(GrownShape, WhatIsInsideStaysInside) {
  const auto cube = Shape::Build(Cube(2));
  narrow_phase::RelativePose inside;
  EXPECT_TRUE(Touch(GrownShape(cube, 0.1), SolidCube(0.1), inside));
  EXPECT_FALSE(Touch(GrownShape(Shape::Build(HollowCube(2, 1.5)), 0.1), SolidCube(0.1), inside));
}

TEST(GrownShape, FactsContainTheGrownBodyAndNotMuchMore) {
  for (const auto& shape : {Shape::Build(LShape()), SolidCube(0.5), Capsule()}) {
    const auto grown = GrownShape(shape, 0.25);
    EXPECT_GE(grown->facts().radius, shape->facts().radius + 0.25);
    EXPECT_LE(grown->facts().radius, (shape->facts().radius + 0.25) * (1 + 1e-12));
    EXPECT_EQ(grown->closed(), shape->closed());
  }
  const ConvexSolid ball = ConvexSolid::Build({.points = {}, .rounding = 1});
  const ConvexSolid grown = ball.Grown(0.5);
  EXPECT_EQ(grown.set().rounding, 1.5);
  const ConvexFacts& facts = grown.facts();
  for (const double reach : {facts.radius, facts.ball_radius, facts.upper.x(), -facts.lower.z()}) {
    EXPECT_GE(reach, 1.5);
    EXPECT_LE(reach, 1.5 + 1e-12);
  }
  EXPECT_LE(facts.inradius, 1.5);
  EXPECT_GE(facts.inradius, 1.5 - 1e-12);
}

TEST(GrownShape, TwinsStayTwins) {
  const auto coarse = Shape::Build(LShape(), {.builder = sphere_tree::TreeBuilder::kMedianSplit});
  const auto fine = Shape::Build(LShape(), {}, coarse.get());
  const auto grown = GrownShape(coarse, 0.1);
  EXPECT_TRUE(GrownShape(fine, 0.1, grown.get())->IsSameBodyAs(*grown));
  EXPECT_FALSE(GrownShape(fine, 0.1)->IsSameBodyAs(*grown));
}

TEST(GrownShape, OnlyShapesOfFewElementsGrow) {
  EXPECT_TRUE(CanGrow(*Shape::Build(LShape())));
  EXPECT_TRUE(CanGrow(*Shape::Build(Sheet(1, 45))));   // 2 · 45² = 4050 triangles
  EXPECT_FALSE(CanGrow(*Shape::Build(Sheet(1, 46))));  // 4232
}

}  // namespace
}  // namespace collision::shape
