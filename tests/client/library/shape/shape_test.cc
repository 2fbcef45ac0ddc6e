// Goal:   a shape contains the given mesh, is checked as the service checks it, and two equal
//         meshes are one shape.
// Method: a tetrahedron and damaged variants; bytes and hash against idl/shape_bytes.h.
#include "collision/shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "client/library/validation.h"
#include "idl/shape_bytes.h"

namespace collision::client {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

Triangles Tetrahedron() {
  return {{{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {0, 0, 6}},
          {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
}

std::string Refusal(Triangles triangles) {
  try {
    Shape::Make(std::move(triangles));
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(Shape, KeepsWhatItWasGiven) {
  const auto shape = Shape::Make(Tetrahedron());
  EXPECT_EQ(shape->triangles().indices.size(), 4u);
  EXPECT_EQ(shape->triangles().vertices_m.size(), 4u);
  EXPECT_TRUE(shape->closed());
  EXPECT_EQ(shape->dropped(), 0u);
  EXPECT_GE(shape->radius_m(), 6);
  EXPECT_LE(shape->radius_m(), 6 * (1 + 1e-12));
  EXPECT_EQ(shape->bytes(),
            EncodeShape({shape->triangles().vertices_m, shape->triangles().indices}));
  EXPECT_EQ(shape->hash(), Sha256(shape->bytes()));
  EXPECT_EQ(HexText(shape->hash()).size(), 64u);
  EXPECT_EQ(HexText(std::string("\x00\xaf", 2)), "00af");
}

TEST(Shape, AnOpenSurfaceIsRecognised) {
  Triangles triangles = Tetrahedron();
  triangles.indices.pop_back();
  EXPECT_FALSE(Shape::Make(triangles)->closed());
}

// Formats without indices repeat each corner: the same surface must not travel three times as
// large, nor under another hash.
TEST(Shape, EachPositionTravelsOnce) {
  const Triangles one = Tetrahedron();
  Triangles soup;
  soup.vertices_m.push_back({99, 99, 99});  // of no face
  for (const auto& triangle : one.indices) {
    std::array<std::uint32_t, 3> corners{};
    for (int i = 0; i < 3; ++i) {
      corners[i] = static_cast<std::uint32_t>(soup.vertices_m.size());
      soup.vertices_m.push_back(one.vertices_m[triangle[i]]);
    }
    soup.indices.push_back(corners);
  }
  soup.vertices_m[1][0] = -0.0;
  const auto shape = Shape::Make(soup);
  EXPECT_EQ(shape->triangles().vertices_m.size(), 4u);
  EXPECT_EQ(shape->hash(), Shape::Make(one)->hash());
  EXPECT_LE(shape->radius_m(), 6.1) << "a vertex of no face is not part of it";
  Triangles other = one;
  other.vertices_m[3][2] = std::nextafter(6.0, 7.0);
  EXPECT_NE(Shape::Make(other)->hash(), shape->hash());
}

TEST(Shape, DegenerateTrianglesAreDroppedAndCounted) {
  Triangles triangles = Tetrahedron();
  triangles.vertices_m.push_back({1, 0, 0});
  triangles.indices.push_back({0, 1, 4});  // on a line
  triangles.indices.push_back({2, 2, 3});
  const auto shape = Shape::Make(triangles);
  EXPECT_EQ(shape->dropped(), 2u);
  EXPECT_EQ(shape->hash(), Shape::Make(Tetrahedron())->hash());
}

TEST(Shape, RefusesWhatTheServiceWouldRefuse) {
  EXPECT_NE(Refusal({}), "");
  Triangles damaged = Tetrahedron();
  damaged.vertices_m[1][2] = kNaN;
  EXPECT_NE(Refusal(damaged).find("nan"), std::string::npos) << Refusal(damaged);
  damaged = Tetrahedron();
  damaged.indices[2][1] = 4;
  EXPECT_NE(Refusal(damaged).find("vertex 4"), std::string::npos) << Refusal(damaged);
  damaged = Tetrahedron();
  for (Vector3& p : damaged.vertices_m) p = {p[0] * 1e-9, p[1] * 1e-9, p[2] * 1e-9};
  EXPECT_NE(Refusal(damaged), "");
  for (Vector3& p : damaged.vertices_m) p = {p[0] * 1e18, p[1] * 1e18, p[2] * 1e18};
  EXPECT_NE(Refusal(damaged), "");
  damaged = Tetrahedron();
  damaged.indices = {{0, 0, 1}, {1, 1, 1}};
  EXPECT_NE(Refusal(damaged).find("2 are degenerate"), std::string::npos) << Refusal(damaged);
}

TEST(Shape, TooManyTrianglesAreRefusedBeforeAnythingIsMadeOfThem) {
  Triangles many = Tetrahedron();
  many.indices.assign(kShapeTrianglesMax + 1, {0, 2, 1});
  EXPECT_NE(Refusal(many).find(std::to_string(kShapeTrianglesMax)), std::string::npos);
}

TEST(Shape, MustLieWithinItsAgentsBall) {
  AgentDescription description{.name = "ship",
                               .radius_m = 6,
                               .acceleration_max_m_s2 = 0,
                               .shape = Shape::Make(Tetrahedron())};
  EXPECT_NO_THROW(Validate(description));
  description.radius_m = 6 * (1 - 0.9 * kShapeRadiusTolerance);
  EXPECT_NO_THROW(Validate(description)) << "what rounding makes of a radius is no reason";
  description.radius_m = 6 * (1 - 1.1 * kShapeRadiusTolerance);
  try {
    Validate(description);
    FAIL() << "the shape stands out of the ball";
  } catch (const std::invalid_argument& error) {
    EXPECT_EQ(std::string(error.what()).rfind("radius_m: 5.99999999", 0), 0u) << error.what();
    EXPECT_NE(std::string(error.what()).find("allowed: >= 6, the radius of its shape"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace collision::client
