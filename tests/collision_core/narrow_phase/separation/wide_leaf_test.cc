// Goal:   a body above a closed landscape does not pay for the large triangles below it.
// Method: a plain over a floor that is a fan about its middle: every one of its balls holds the
//         body.
#include <gtest/gtest.h>

#include "collision_core/narrow_phase/contact/shape_contact.h"
#include "tests/collision_core/narrow_phase/contact_cases.h"

namespace collision::narrow_phase {
namespace {

// 100 m wide, flat above at z = 0, 8 m high; n cells along an edge.
geometry::TriangleMesh Landscape(std::uint32_t n) {
  geometry::TriangleMesh mesh;
  const std::uint32_t row = n + 1;
  for (std::uint32_t j = 0; j <= n; ++j) {
    for (std::uint32_t i = 0; i <= n; ++i) {
      mesh.vertices.push_back({100.0 * i / n - 50, 100.0 * j / n - 50, 0});
    }
  }
  for (std::uint32_t j = 0; j < n; ++j) {
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = j * row + i;
      mesh.triangles.push_back({a, a + 1, a + row + 1});
      mesh.triangles.push_back({a, a + row + 1, a + row});
    }
  }
  std::vector<std::uint32_t> rim;
  for (std::uint32_t i = 0; i < n; ++i) rim.push_back(i);
  for (std::uint32_t j = 0; j < n; ++j) rim.push_back(j * row + n);
  for (std::uint32_t i = n; i > 0; --i) rim.push_back(n * row + i);
  for (std::uint32_t j = n; j > 0; --j) rim.push_back(j * row);
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const std::uint32_t above : rim) {
    mesh.vertices.push_back(mesh.vertices[above] - Vector3d(0, 0, 8));
  }
  const auto middle = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.push_back({0, 0, -8});
  const auto count = static_cast<std::uint32_t>(rim.size());
  for (std::uint32_t k = 0; k < count; ++k) {
    const std::uint32_t next = (k + 1) % count;
    mesh.triangles.push_back({rim[k], first + k, first + next});
    mesh.triangles.push_back({rim[k], first + next, rim[next]});
    mesh.triangles.push_back({middle, first + next, first + k});
  }
  return mesh;
}

TEST(WideLeaf, TheFloorBelowCostsLittle) {
  const Body ground{
      shape::Shape::Build(Landscape(64), {.builder = sphere_tree::TreeBuilder::kMedianSplit})};
  ASSERT_TRUE(ground.shape->closed());
  Body cube{shape::Shape::Build(Subdivided(Cube(0.25), 2)), 0, {1.125, 2.0625, 1.25}, {0, 0, -1}};
  for (const bool swapped : {false, true}) {
    const ContactTolerance tolerance{.absolute = 1e-6};
    const TimeOfContactResult found = swapped ? Find(cube, ground, 2, Result::kAtStart, tolerance)
                                              : Find(ground, cube, 2, Result::kAtStart, tolerance);
    EXPECT_EQ(found.status, ContactStatus::kContact);
    EXPECT_LE(found.begin.lower, 1);
    EXPECT_GE(found.begin.upper, 1);
    EXPECT_LE(found.begin.width(), 1e-6);
    EXPECT_LT(found.work, 100'000u);
  }
}

}  // namespace
}  // namespace collision::narrow_phase
