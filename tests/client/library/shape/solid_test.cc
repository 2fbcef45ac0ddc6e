// Goal:   solids become a shape unchanged, are checked field by field as the service checks them,
//         and have equal hashes if they are equal.
// Method: each kind against its bytes and its radius in closed form; every field broken in turn,
//         against the core's own check; pairs that differ only in the sign of a zero.
#include "collision/solid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "client/library/validation.h"
#include "collision/shape.h"
#include "collision_core/shape/shape.h"
#include "idl/shape_bytes.h"
#include "tests/support/random.h"

namespace collision::client {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Triangles Tetrahedron() {
  return {{{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {0, 0, 6}},
          {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
}

std::vector<Solid> OfEachKind() {
  return {Solid::Ball(2), Solid::Capsule(1, 3), Solid::Box({2, 3, 6}), Solid::Ellipsoid({1, 2, 4}),
          Solid::Hull({{2, 3, 6}, {-2, 3, 6}, {0, 0, 0}, {1, 1, 1}})};
}

std::string Refusal(Geometry geometry) {
  try {
    Shape::Make(std::move(geometry));
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

// Goal:   the radius contains the solid and is tight: 2² + 3² + 6² = 7².
TEST(Solid, EachKindHasItsRadius) {
  const double radii[] = {2, 4, 7, 4, 7};
  const auto solids = OfEachKind();
  for (std::size_t i = 0; i < solids.size(); ++i) {
    for (const double rounding : {0.0, 0.5}) {
      const auto shape = Shape::Make({.solids = {solids[i].Rounded(rounding)}});
      EXPECT_GE(shape->radius_m(), radii[i] + rounding) << Name(solids[i].kind);
      EXPECT_LE(shape->radius_m(), (radii[i] + rounding) * (1 + 1e-9)) << Name(solids[i].kind);
      EXPECT_TRUE(shape->closed());
      EXPECT_TRUE(shape->triangles().indices.empty());
    }
  }
  const auto both = Shape::Make({.solids = {Solid::Ball(1).At({2, 3, 6}), Solid::Box({1, 1, 1})}});
  EXPECT_GE(both->radius_m(), 8);
  EXPECT_LE(both->radius_m(), 8 * (1 + 1e-9));
}

// Goal:   the bytes contain what was given, in the given order.
TEST(Solid, IsEncodedAsTheFormatSpecifies) {
  const Quaternion turned{0.5, 0.5, 0.5, 0.5};
  const auto shape =
      Shape::Make({.triangles = Tetrahedron(),
                   .solids = {Solid::Capsule(0.1, 0.4).At({1, 2, 3}, turned), Solid::Box({1, 2, 3}),
                              Solid::Hull({{4, 5, 6}, {7, 8, 9}}).Rounded(0.25).Rounded(0.25)}});
  std::string error;
  const auto content = DecodeShape(shape->bytes(), &error);
  ASSERT_TRUE(content) << error;
  EXPECT_EQ(content->triangles.size(), 4u);
  ASSERT_EQ(content->solids.size(), 3u);
  const auto& [capsule, box, hull] =
      std::tie(content->solids[0], content->solids[1], content->solids[2]);
  EXPECT_EQ(capsule.kind, SolidKind::kCapsule);
  EXPECT_EQ(capsule.position, (Vector3{1, 2, 3}));
  EXPECT_EQ(capsule.orientation, turned);
  EXPECT_EQ(capsule.half_extents, (Vector3{0, 0, 0.4}));
  EXPECT_EQ(capsule.rounding, 0.1);
  EXPECT_EQ(box.kind, SolidKind::kBox);
  EXPECT_EQ(box.half_extents, (Vector3{1, 2, 3}));
  EXPECT_EQ(hull.kind, SolidKind::kHull);
  EXPECT_EQ(hull.points, (std::vector<Vector3>{{4, 5, 6}, {7, 8, 9}}));
  EXPECT_EQ(hull.rounding, 0.5);
  EXPECT_EQ(shape->hash(), Sha256(shape->bytes()));
  EXPECT_EQ(shape->solids().size(), 3u);
  EXPECT_EQ(Shape::Make({.triangles = Tetrahedron()})->hash(), Shape::Make(Tetrahedron())->hash())
      << "a mesh alone is what it ever was";
  for (const Solid& solid : OfEachKind()) {
    const auto one = DecodeShape(Shape::Make({.solids = {solid}})->bytes(), &error);
    EXPECT_EQ(static_cast<std::uint32_t>(one->solids[0].kind),
              static_cast<std::uint32_t>(solid.kind) + 1);
  }
}

// Goal:   equal solids are one shape: the sign of a zero does not count.
TEST(Solid, TheSignOfAZeroIsNotInTheHash) {
  const auto hash = [](const Solid& solid) { return Shape::Make({.solids = {solid}})->hash(); };
  Solid box = Solid::Box({1, 0, 2});
  box.half_extents_m[1] = -0.0;
  box.rounding_m = -0.0;
  EXPECT_EQ(hash(box.At({-0.0, 0, 0}, {1, -0.0, 0, 0})), hash(Solid::Box({1, 0, 2})));
  EXPECT_NE(hash(box.At({1e-300, 0, 0})), hash(box));
  EXPECT_NE(hash(Solid::Hull({{1, 0, 0}, {0, 1, 0}})), hash(Solid::Hull({{0, 1, 0}, {1, 0, 0}})));
}

// Goal:   the first wrong solid is named with field, value and range.
TEST(Solid, ARefusalNamesSolidFieldValueAndRange) {
  const auto second = [](const Solid& solid) {
    return Refusal({.solids = {Solid::Ball(1), solid}});
  };
  EXPECT_EQ(second(Solid::Capsule(0.1, -2)),
            "solids[1] (capsule): half_extents_m.z: -2, allowed: 0 to 1e+07 m");
  EXPECT_EQ(second(Solid::Ball(kInfinity)),
            "solids[1] (ball): rounding_m: inf, allowed: 0 to 1e+07 m");
  EXPECT_EQ(second(Solid::Box({1, kNaN, 1})),
            "solids[1] (box): half_extents_m.y: nan, allowed: 0 to 1e+07 m");
  EXPECT_EQ(second(Solid::Ball(1).At({0, 0, 1e300})),
            "solids[1] (ball): position_m.z: 1e+300, allowed: finite values within ±1e+07 m");
  EXPECT_EQ(second(Solid::Ball(1).At({}, {0, 0, 0, 0})),
            "solids[1] (ball): orientation: length 0, allowed: 1e-100 to 1e+100");
  EXPECT_EQ(second(Solid::Hull({{1, 0, 0}, {0, -kInfinity, 0}})),
            "solids[1] (hull): points_m[1].y: -inf, allowed: finite values within ±1e+07 m");
  EXPECT_EQ(second(Solid::Hull({})), "solids[1] (hull): points_m: 0, allowed: 1 to 65536");
  EXPECT_EQ(second(Solid::Ellipsoid({1e-9, 1e-9, 1e-9})),
            "solids[1] (ellipsoid): its diameter: 2e-09 m, allowed: 1e-06 to 1e+07 m (most "
            "likely the unit is not the one meant)");
  Solid ball = Solid::Ball(1), capsule = Solid::Capsule(1, 2);
  ball.half_extents_m = {0, 0, 1};
  EXPECT_EQ(second(ball),
            "solids[1] (ball): half_extents_m.z: 1, allowed: 0, since a ball has none along z");
  capsule.half_extents_m[0] = kNaN;
  EXPECT_EQ(
      second(capsule),
      "solids[1] (capsule): half_extents_m.x: nan, allowed: 0, since a capsule has none along x");
  capsule = Solid::Capsule(1, 2);
  capsule.points_m = {{1, 2, 3}};
  EXPECT_EQ(second(capsule),
            "solids[1] (capsule): points_m: 1, allowed: 0, since a capsule has none");
  EXPECT_EQ(Refusal({.solids = std::vector<Solid>(17, Solid::Hull(std::vector<Vector3>(65536)))}),
            "solids: their hulls have 1114112 points, allowed: 0 to 1048576");
  EXPECT_NE(Refusal({.triangles = {{{1, 2, 3}}, {}}, .solids = {Solid::Ball(1)}}), "")
      << "vertices without triangles are a mesh that was lost";
  EXPECT_EQ(Refusal({.solids = std::vector<Solid>(kShapeSolidsMax + 1)}),
            "solids: 65537, allowed: 0 to 65536");
  EXPECT_EQ(kShapeSolidsMax, shape::kSolidsMax) << "the service's limit";
  Triangles broken = Tetrahedron();
  broken.indices[0][0] = 9;
  EXPECT_NE(Refusal({.triangles = broken, .solids = {Solid::Ball(1)}}).find("vertex 9"),
            std::string::npos);
}

}  // namespace
}  // namespace collision::client
