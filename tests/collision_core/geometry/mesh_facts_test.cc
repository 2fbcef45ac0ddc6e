// Goal:   closed and open meshes are distinguished, pieces are counted, sizes are known.
// Method: surfaces that differ in one triangle, one index or the sign of a zero.
#include <gtest/gtest.h>

#include "tests/collision_core/sphere_tree/meshes.h"
#include "tests/support/truth/exact.h"

namespace collision::geometry {
namespace {

using Eigen::Vector3d;

TriangleMesh UnitBox() { return Box({0, 0, 0}, {1, 1, 1}); }

/// Every triangle with vertices of its own, as exporters of normals and texture write them.
TriangleMesh Unshared(const TriangleMesh& mesh) {
  TriangleMesh result;
  for (const Triangle& t : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(result.vertices.size());
    for (const std::uint32_t corner : t) result.vertices.push_back(mesh.vertices[corner]);
    result.triangles.push_back({first, first + 1, first + 2});
  }
  return result;
}

TEST(MeshFacts, ABoxIsClosedUntilATriangleIsMissingOrTurned) {
  EXPECT_TRUE(FactsOf(UnitBox()).closed);
  for (std::size_t i = 0; i < 12; ++i) {
    TriangleMesh missing = UnitBox(), turned = UnitBox(), twice = UnitBox();
    missing.triangles.erase(missing.triangles.begin() + static_cast<std::ptrdiff_t>(i));
    std::swap(turned.triangles[i][0], turned.triangles[i][1]);
    twice.triangles.push_back(twice.triangles[i]);
    EXPECT_FALSE(FactsOf(missing).closed);
    EXPECT_FALSE(FactsOf(turned).closed);
    EXPECT_FALSE(FactsOf(twice).closed);
  }
}

TEST(MeshFacts, VerticesAtOnePositionAreOne) {
  TriangleMesh mesh = Unshared(UnitBox());
  EXPECT_TRUE(FactsOf(mesh).closed);
  EXPECT_EQ(FactsOf(mesh).components, 1u);
  // The two zeros are one position; the next double is another.
  for (auto& p : mesh.vertices) p.x() = p.x() == 0 ? -0.0 : p.x();
  mesh.vertices[0].x() = 0.0;
  EXPECT_TRUE(FactsOf(mesh).closed);
  mesh.vertices[0].x() = 5e-324;
  EXPECT_FALSE(FactsOf(mesh).closed);
}

TEST(MeshFacts, ComponentsAndTheirOutermostPoints) {
  const TriangleMesh two = Joined(UnitBox(), Moved(UnitBox(), {-5, 0, 0}));
  EXPECT_EQ(FactsOf(two).components, 2u);
  EXPECT_TRUE(FactsOf(two).closed);
  EXPECT_EQ(ComponentPoints(two), (std::vector<Vector3d>{{1, 1, 1}, {-4, 1, 1}}));
  // Two that touch in a vertex are one.
  EXPECT_EQ(FactsOf(Joined(UnitBox(), Moved(UnitBox(), {1, 1, 1}))).components, 1u);
}

TEST(MeshFacts, AMoebiusStripIsOpen) {
  TriangleMesh strip;
  strip.vertices = {{0, 0, 0}, {1, 0, 0}, {2, 1, 0}, {1, 2, 1}, {0, 2, 1}};
  for (std::uint32_t i = 0; i < 5; ++i) strip.triangles.push_back({i, (i + 1) % 5, (i + 2) % 5});
  EXPECT_FALSE(FactsOf(strip).closed);
}

TEST(MeshFacts, RadiusAndBoxAreOfWhatTrianglesUse) {
  TriangleMesh mesh = Box({-2, -3, -6}, {1, 1, 1});
  mesh.vertices.push_back({100, 100, 100});
  const MeshFacts facts = FactsOf(mesh);
  EXPECT_EQ(facts.radius, 7);
  EXPECT_EQ(facts.lower, Vector3d(-2, -3, -6));
  EXPECT_EQ(facts.upper, Vector3d(1, 1, 1));
  EXPECT_EQ(facts.components, 1u);
}

// In exact arithmetic: the radius is not less than any vertex is away, and by a few units at most.
TEST(MeshFacts, TheRadiusIsRoundedUp) {
  Random random(52);
  for (int i = 0; i < 1000; ++i) {
    const double size = random.LogUniform(1e-6, 1e6);
    const Vector3d p = size * random.UnitVector();
    const double radius = FactsOf(Box(p.cwiseMin(-p), p.cwiseMax(-p))).radius;
    const Exact x = p.x(), y = p.y(), z = p.z(), r = radius, less = radius * (1 - 0x1p-50);
    ASSERT_GE(r * r, x * x + y * y + z * z);
    ASSERT_LE(less * less, x * x + y * y + z * z);
  }
}

TEST(MeshFacts, FramesStarsAndTanglesAreClosed) {
  Random random(51);
  EXPECT_TRUE(FactsOf(Frame()).closed);
  EXPECT_TRUE(FactsOf(Star(2, random)).closed);
  EXPECT_TRUE(FactsOf(Tangle(2, random)).closed);
}

}  // namespace
}  // namespace collision::geometry
