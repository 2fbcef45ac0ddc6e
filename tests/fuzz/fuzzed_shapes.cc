#include "tests/fuzz/fuzzed_shapes.h"

#include "collision_core/geometry/mesh/triangle_mesh.h"
#include "tests/server/shapes/shapes.h"

namespace collision::fuzz {
namespace {

constexpr double kReach = 1e7;

client::Vector3 FuzzedPoint(FuzzedData* data) {
  return {data->Wild(kReach), data->Wild(kReach), data->Wild(kReach)};
}

client::Solid FuzzedSolid(FuzzedData* data) {
  client::Solid solid;
  solid.kind = static_cast<client::Solid::Kind>(data->Below(7));
  for (std::size_t i = 0; i < 3; ++i) {
    const bool counts =
        solid.kind == client::Solid::Kind::kBox || solid.kind == client::Solid::Kind::kEllipsoid ||
        solid.kind == client::Solid::Kind::kCylinder || solid.kind == client::Solid::Kind::kCone ||
        (solid.kind == client::Solid::Kind::kCapsule && i == 2);
    if (counts || data->Byte() == 255) solid.half_extents_m[i] = std::abs(data->Wild(kReach));
  }
  const bool turned =
      solid.kind == client::Solid::Kind::kCylinder || solid.kind == client::Solid::Kind::kCone;
  if (turned && data->Byte() != 255) solid.half_extents_m[1] = solid.half_extents_m[0];
  solid.rounding_m = data->Byte() == 255 ? data->Wild(kReach) : data->UpTo(kReach);
  if (solid.kind == client::Solid::Kind::kHull) {
    for (std::size_t i = data->Below(12); i > 0; --i) solid.points_m.push_back(FuzzedPoint(data));
  }
  if (data->Flag()) solid.position_m = FuzzedPoint(data);
  if (data->Flag()) {
    for (double& component : solid.orientation) component = data->Wild(1e200);
  }
  return solid;
}

std::shared_ptr<const shape::Shape> Built(const ShapeContent& content) {
  geometry::TriangleMesh mesh;
  for (const auto& [x, y, z] : content.vertices) mesh.vertices.emplace_back(x, y, z);
  mesh.triangles = content.triangles;
  return shape::Shape::Build(std::move(mesh), {.builder = sphere_tree::TreeBuilder::kFitted});
}

std::shared_ptr<const shape::Shape> Solids() {
  const shape::ConvexDescription capsule{.core = geometry::ConvexCore::kSegment,
                                         .half = {0, 0, 0.5},
                                         .points = {},
                                         .rounding = 0.25,
                                         .p_BS = {0.5, 0, 0}};
  const shape::ConvexDescription box{
      .core = geometry::ConvexCore::kBox, .half = {0.5, 0.25, 0.125}, .points = {}};
  return shape::Shape::Compound(
      nullptr, {shape::ConvexSolid::Build(capsule), shape::ConvexSolid::Build(box)});
}

}  // namespace

client::Geometry FuzzedGeometry(FuzzedData* data) {
  client::Geometry geometry;
  client::Triangles& triangles = geometry.triangles;
  const std::size_t vertices = data->Below(24);
  for (std::size_t i = 0; i < vertices; ++i) triangles.vertices_m.push_back(FuzzedPoint(data));
  const std::size_t count = vertices == 0 ? 0 : data->Below(40);
  for (std::size_t i = 0; i < count; ++i) {
    std::array<std::uint32_t, 3>& triangle = triangles.indices.emplace_back();
    for (std::uint32_t& corner : triangle) {
      corner = static_cast<std::uint32_t>(data->Below(vertices + (data->Byte() == 255 ? 1 : 0)));
    }
  }
  const std::size_t solids = data->Byte() < 128 ? 0 : data->Below(6);
  for (std::size_t i = 0; i < solids; ++i) geometry.solids.push_back(FuzzedSolid(data));
  return geometry;
}

std::shared_ptr<const shape::Shape> FuzzedBody(FuzzedData* data) {
  static const std::shared_ptr<const shape::Shape> kBodies[] = {
      nullptr, Built(server::Cube(1)), Built(server::FineCube(2)),
      Built({.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, .triangles = {{0, 1, 2}}}), Solids()};
  return data->OneOf(kBodies);
}

}  // namespace collision::fuzz
