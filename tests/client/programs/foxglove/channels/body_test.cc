// Goal:   each kind of body is drawn as what it is.
// Method: sizes and places by hand; surfaces against the solid's own inequality.
#include "client/programs/foxglove/channels/body.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "client/programs/foxglove/channels/solid_surface.h"

namespace collision::client {
namespace {

using Point = std::array<double, 3>;

foxglove::SceneEntity Drawn(const SolidContent& solid) {
  foxglove::SceneEntity entity;
  EXPECT_TRUE(AddShape({.vertices = {}, .triangles = {}, .solids = {solid}}, {}, &entity));
  return entity;
}

/// Six times the volume inside, positive if the triangles look outward.
double Volume(const ShapeContent& surface) {
  double six = 0;
  for (const auto& [i, j, k] : surface.triangles) {
    const Point &a = surface.vertices[i], &b = surface.vertices[j], &c = surface.vertices[k];
    six += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  return six / 6;
}

TEST(Body, AMeshIsDrawnAsItsTriangles) {
  foxglove::SceneEntity entity;
  const ShapeContent mesh{.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}}, .triangles = {{2, 1, 0}}};
  ASSERT_TRUE(AddShape(mesh, {}, &entity));
  ASSERT_EQ(entity.triangles_size(), 1);
  EXPECT_EQ(entity.triangles(0).points(2).y(), 2);
  EXPECT_EQ(entity.triangles(0).indices(0), 2u);
  EXPECT_EQ(entity.triangles(0).pose().orientation().w(), 1);
  const ShapeContent broken{.vertices = mesh.vertices, .triangles = {{0, 1, 3}}};
  EXPECT_FALSE(AddShape(broken, {}, &entity)) << "a vertex that is not there";
  EXPECT_FALSE(AddShape({}, {}, &entity));
}

TEST(Body, SolidsAreFoxglovesOwnForms) {
  const auto box = Drawn({.kind = SolidKind::kBox,
                          .position = {1, 2, 3},
                          .orientation = {0.5, 0.1, 0.7, 0.5},
                          .half_extents = {1, 2, 3}});
  ASSERT_EQ(box.cubes_size(), 1);
  EXPECT_EQ(box.cubes(0).size().z(), 6);
  EXPECT_EQ(box.cubes(0).pose().position().y(), 2);
  EXPECT_EQ(box.cubes(0).pose().orientation().w(), 0.5);
  EXPECT_EQ(box.cubes(0).pose().orientation().y(), 0.7);
  const auto ball = Drawn({.kind = SolidKind::kBall, .rounding = 2});
  EXPECT_EQ(ball.spheres(0).size().x(), 4);
  const auto egg = Drawn({.kind = SolidKind::kEllipsoid, .half_extents = {1, 2, 3}});
  EXPECT_EQ(egg.spheres(0).size().y(), 4);
  const auto cylinder = Drawn({.kind = SolidKind::kCylinder, .half_extents = {1, 1, 3}});
  EXPECT_EQ(cylinder.cylinders(0).size().z(), 6);
  EXPECT_EQ(cylinder.cylinders(0).top_scale(), 1);
  const auto cone = Drawn({.kind = SolidKind::kCone, .half_extents = {1, 1, 3}});
  EXPECT_EQ(cone.cylinders(0).bottom_scale(), 1);
  EXPECT_EQ(cone.cylinders(0).top_scale(), 0);
}

TEST(Body, ACapsuleHasItsCapsAtItsEnds) {
  // A quarter turn about y: its axis is the body's x.
  const auto capsule = Drawn({.kind = SolidKind::kCapsule,
                              .position = {10, 0, 0},
                              .orientation = {std::sqrt(0.5), 0, std::sqrt(0.5), 0},
                              .half_extents = {0, 0, 2},
                              .rounding = 0.5});
  EXPECT_EQ(capsule.cylinders(0).size().x(), 1);
  ASSERT_EQ(capsule.spheres_size(), 2);
  EXPECT_NEAR(capsule.spheres(0).pose().position().x(), 12, 1e-12);
  EXPECT_NEAR(capsule.spheres(1).pose().position().x(), 8, 1e-12);
  EXPECT_NEAR(capsule.spheres(0).pose().position().z(), 0, 1e-12);
}

TEST(Body, AHullIsTriangulatedWhereItLies) {
  const auto hull =
      Drawn({.kind = SolidKind::kHull,
             .position = {5, 0, 0},
             .points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.1, 0.1, 0.1}}});
  ASSERT_EQ(hull.triangles_size(), 1);
  EXPECT_EQ(hull.triangles(0).points_size(), 4) << "not the point inside";
  for (const auto& p : hull.triangles(0).points()) EXPECT_GE(p.x(), 5);
}

TEST(SolidSurface, OfAHullIsTheHull) {
  const SolidContent cube{
      .kind = SolidKind::kHull,
      .points = {
          {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}}};
  const ShapeContent surface = SolidSurface(cube);
  EXPECT_EQ(surface.vertices.size(), 8u);
  EXPECT_NEAR(Volume(surface), 1, 1e-12);
}

TEST(SolidSurface, OfRoundedSolidsLiesOnTheirSurface) {
  const double pi = std::acos(-1.0);
  // A box of 2 x 4 x 6 with edges rounded by 1: the box, a slab on each face, quarters of cylinders
  // along the edges, a ball at the corners.
  const ShapeContent box =
      SolidSurface({.kind = SolidKind::kBox, .half_extents = {1, 2, 3}, .rounding = 1});
  for (const Point& p : box.vertices) {
    const double x = std::max(0.0, std::abs(p[0]) - 1), y = std::max(0.0, std::abs(p[1]) - 2),
                 z = std::max(0.0, std::abs(p[2]) - 3);
    EXPECT_NEAR(std::hypot(x, y, z), 1, 1e-12);
  }
  const double exact = 48 + 2 * (8 + 12 + 24) + pi * (2 + 4 + 6) + 4 * pi / 3;
  EXPECT_LE(Volume(box), exact);
  EXPECT_GE(Volume(box), 0.98 * exact);
  // A cylinder of radius 1 and length 4, rounded by 1/2: Steiner's formula with V = 4 π, S = 10 π
  // and the integral of the mean curvature, 4 π + π².
  const ShapeContent cylinder =
      SolidSurface({.kind = SolidKind::kCylinder, .half_extents = {1, 1, 2}, .rounding = 0.5});
  const double whole = 4 * pi + 10 * pi / 2 + (4 * pi + pi * pi) / 4 + pi / 6;
  EXPECT_LE(Volume(cylinder), whole);
  EXPECT_GE(Volume(cylinder), 0.98 * whole);
}

TEST(SolidSurface, OfARoundedConeHasItsTip) {
  double top = 0, bottom = 0, radius = 0;
  const ShapeContent cone =
      SolidSurface({.kind = SolidKind::kCone, .half_extents = {1, 1, 2}, .rounding = 0.5});
  for (const Point& p : cone.vertices) {
    top = std::max(top, p[2]);
    bottom = std::min(bottom, p[2]);
    radius = std::max(radius, std::hypot(p[0], p[1]));
  }
  EXPECT_NEAR(top, 2.5, 1e-12);
  EXPECT_NEAR(bottom, -2.5, 1e-12);
  EXPECT_NEAR(radius, 1.5, 1e-12);
}

TEST(Body, AHalfSpaceIsAPlateThatLiesInside) {
  foxglove::SceneEntity entity;
  AddHalfSpace({0, 1, 0}, 5, {}, &entity);
  const foxglove::CubePrimitive& plate = entity.cubes(0);
  EXPECT_NEAR(plate.pose().position().y() + plate.size().z() / 2, 5, 1e-12);
  EXPECT_EQ(plate.size().x(), kPlateSide);
  const foxglove::Quaternion& q = plate.pose().orientation();
  EXPECT_NEAR(q.x(), -std::sqrt(0.5), 1e-12) << "from +z to +y";
  EXPECT_NEAR(q.w(), std::sqrt(0.5), 1e-12);
}

TEST(TurnOf, TurnsTheAxisIntoTheDirection) {
  for (const Point& d : {Point{2. / 7, 3. / 7, 6. / 7}, Point{-1, 0, 0}, Point{1, 0, 0}}) {
    const foxglove::Quaternion q = TurnOf(0, d);
    // The image of +x.
    EXPECT_NEAR(1 - 2 * (q.y() * q.y() + q.z() * q.z()), d[0], 1e-12);
    EXPECT_NEAR(2 * (q.x() * q.y() + q.w() * q.z()), d[1], 1e-12);
    EXPECT_NEAR(2 * (q.x() * q.z() - q.w() * q.y()), d[2], 1e-12);
  }
}

}  // namespace
}  // namespace collision::client
