#include "collision/shape.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <unordered_map>
#include <utility>

#include "client/library/shape/core_mesh.h"
#include "client/library/shape/solid_check.h"
#include "client/library/validation.h"
#include "idl/shape_bytes.h"

namespace collision::client {
namespace {

struct PositionHash {
  std::size_t operator()(const Vector3& position) const {
    std::uint64_t hash = 0;
    for (const double value : position) {
      std::uint64_t bits = 0;
      std::memcpy(&bits, &value, sizeof bits);
      hash = (hash ^ bits) * 0x9e3779b97f4a7c15u;
      hash ^= hash >> 32;
    }
    return hash;
  }
};

/// Each position that a triangle uses, once, in the order of use.
Triangles Compact(const geometry::TriangleMesh& mesh) {
  Triangles compact;
  compact.indices.reserve(mesh.triangles.size());
  std::unordered_map<Vector3, std::uint32_t, PositionHash> seen;
  for (const geometry::Triangle& triangle : mesh.triangles) {
    geometry::Triangle& indices = compact.indices.emplace_back();
    for (int i = 0; i < 3; ++i) {
      const auto& v = mesh.vertices[triangle[i]];
      const Vector3 position{v.x() + 0.0, v.y() + 0.0, v.z() + 0.0};  // -0 becomes 0.
      const auto next = static_cast<std::uint32_t>(compact.vertices_m.size());
      const auto [found, is_new] = seen.try_emplace(position, next);
      if (is_new) compact.vertices_m.push_back(position);
      indices[i] = found->second;
    }
  }
  return compact;
}

void RequireFitMesh(const geometry::TriangleMesh& mesh) {
  if (const auto refusal = RefusalOf(mesh, kShapeTrianglesMax)) {
    throw std::invalid_argument(*refusal);
  }
}

/// The triangles with an area; throws if there is none.
geometry::TriangleMesh Repaired(const Triangles& triangles, std::size_t* dropped) {
  geometry::TriangleMesh mesh = ToCore(triangles);
  RequireFitMesh(mesh);
  *dropped = DropDegenerate(&mesh);
  if (!mesh.triangles.empty()) return mesh;
  throw std::invalid_argument("triangles: all " + std::to_string(*dropped) +
                              " are degenerate, allowed: 1 to " +
                              std::to_string(kShapeTrianglesMax) + " with an area");
}

}  // namespace

std::shared_ptr<const Shape> Shape::Make(Triangles triangles) {
  return Make(Geometry{std::move(triangles), {}});
}

std::shared_ptr<const Shape> Shape::Make(Geometry geometry) {
  const std::shared_ptr<Shape> shape(new Shape);
  shape->closed_ = true;
  const Triangles& given = geometry.triangles;
  if (geometry.solids.empty() || !given.vertices_m.empty() || !given.indices.empty()) {
    shape->geometry_.triangles = Compact(Repaired(given, &shape->dropped_));
    const geometry::TriangleMesh mesh = ToCore(shape->geometry_.triangles);
    RequireFitMesh(mesh);  // Without its unused vertices the mesh may be too small.
    const geometry::MeshFacts facts = FactsOf(mesh);
    shape->radius_m_ = facts.radius;
    shape->closed_ = facts.closed;
  }
  shape->geometry_.solids = Canonical(std::move(geometry.solids));
  shape->radius_m_ = std::max(shape->radius_m_, RadiusOf(shape->geometry_.solids));
  shape->bytes_ = EncodeShape({shape->triangles().vertices_m, shape->triangles().indices,
                               ContentOf(shape->geometry_.solids)});
  shape->hash_ = Sha256(shape->bytes_);
  return shape;
}

std::string HexText(const std::string& bytes) {
  constexpr const char* kDigits = "0123456789abcdef";
  std::string text;
  for (const unsigned char byte : bytes) text += {kDigits[byte >> 4], kDigits[byte & 15]};
  return text;
}

}  // namespace collision::client
