// Goal:   the ground is closed, has the requested number of triangles, lies within its square and
//         relief, is solid below and empty above, and is the same on every machine.
#include "client/programs/simulators/terrain/terrain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "client/checker/shape/mesh.h"

namespace collision::client {
namespace {

checker::Mesh CheckerMesh(const Triangles& triangles) {
  std::vector<checker::Vector> vertices;
  for (const Vector3& p : triangles.vertices_m) vertices.push_back({p[0], p[1], p[2]});
  return checker::Mesh(std::move(vertices), triangles.indices);
}

TEST(Terrain, HasAtMostTheRequestedTrianglesAndHardlyFewer) {
  for (const std::size_t asked : {50u, 51u, 1000u, 99'999u, 300'000u}) {
    const Triangles mesh = TerrainMesh({.triangles = asked});
    EXPECT_LE(mesh.indices.size(), asked);
    EXPECT_GE(static_cast<double>(mesh.indices.size()),
              static_cast<double>(asked) - 4 * std::sqrt(2.0 * static_cast<double>(asked)) - 20);
  }
}

TEST(Terrain, IsASolidBlockWithHills) {
  for (const std::uint64_t seed : {1u, 2u, 7u}) {
    const TerrainOptions options{.triangles = 2000, .size_m = 160, .relief_m = 24, .seed = seed};
    const Triangles triangles = TerrainMesh(options);
    const checker::Mesh mesh = CheckerMesh(triangles);
    EXPECT_EQ(mesh.triangles().size(), triangles.indices.size()) << "none is without area";
    EXPECT_TRUE(mesh.closed());
    EXPECT_EQ(mesh.part_points().size(), 1u);
    double lowest = 1e9, highest = -1e9;
    for (const Vector3& p : triangles.vertices_m) {
      EXPECT_LE(std::max(std::abs(p[0]), std::abs(p[1])), 80);
      EXPECT_GE(p[2], -6);
      EXPECT_LE(p[2], 24);
      if (p[2] > -6) lowest = std::min(lowest, p[2]);
      highest = std::max(highest, p[2]);
    }
    EXPECT_LT(lowest, 6) << "there are valleys";
    EXPECT_GT(highest, 12) << "there are summits";
    for (const double x : {-79.0, -31.5, 0.25, 60.0}) {
      EXPECT_EQ(mesh.WindingNumber({x, 0.5 * x, -3}), 1) << "inside, faces outward";
      EXPECT_EQ(mesh.WindingNumber({x, 0.5 * x, 25}), 0);
    }
  }
}

// Goal:   processes on different machines agree about the ground, and each seed has its own.
// Method: a golden hash of the bytes.
TEST(Terrain, IsTheSameEverywhere) {
  const auto hash = [](std::uint64_t seed) {
    return HexText(Shape::Make(TerrainMesh({.triangles = 5000, .seed = seed}))->hash());
  };
  EXPECT_EQ(hash(1).substr(0, 16), "b0b22e777d614c7e");
  EXPECT_NE(hash(1), hash(2));
}

}  // namespace
}  // namespace collision::client
