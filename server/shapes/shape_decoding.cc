#include "server/shapes/shape_decoding.h"

#include <spdlog/fmt/fmt.h>

#include <cmath>
#include <string_view>
#include <utility>

#include "collision_core/shape/shape.h"
#include "idl/limits.h"
#include "idl/shape_bytes.h"

namespace collision::server {
namespace {

/// Why a shape is refused; nullopt: it is not.
using Reason = std::optional<std::string>;

static_assert(shape::kSolidsMax == wire::kShapeSolidsMax,
              "the core takes as many solids as the wire");

/// What the number means that stands for a kind on the wire.
struct Kind {
  SolidKind kind;
  const char* name;
  geometry::ConvexCore core;
  bool uses_half[3];  ///< Which of half_extents count.
};

constexpr Kind kKinds[] = {
    {SolidKind::kBall, "ball", geometry::ConvexCore::kPoint, {false, false, false}},
    {SolidKind::kCapsule, "capsule", geometry::ConvexCore::kSegment, {false, false, true}},
    {SolidKind::kBox, "box", geometry::ConvexCore::kBox, {true, true, true}},
    {SolidKind::kEllipsoid, "ellipsoid", geometry::ConvexCore::kEllipsoid, {true, true, true}},
    {SolidKind::kHull, "hull", geometry::ConvexCore::kHull, {false, false, false}},
    {SolidKind::kCylinder, "cylinder", geometry::ConvexCore::kCylinder, {true, true, true}},
    {SolidKind::kCone, "cone", geometry::ConvexCore::kCone, {true, true, true}},
};

const Kind* FindKind(SolidKind kind) {
  for (const Kind& known : kKinds) {
    if (known.kind == kind) return &known;
  }
  return nullptr;
}

geometry::TriangleMesh MeshOf(const ShapeContent& content) {
  geometry::TriangleMesh mesh;
  mesh.vertices.reserve(content.vertices.size());
  for (const auto& [x, y, z] : content.vertices) mesh.vertices.emplace_back(x, y, z);
  mesh.triangles.assign(content.triangles.begin(), content.triangles.end());
  return mesh;
}

shape::ConvexDescription DescriptionOf(const SolidContent& solid, const Kind& kind) {
  shape::ConvexDescription description;
  description.core = kind.core;
  description.half = {solid.half_extents[0], solid.half_extents[1], solid.half_extents[2]};
  description.rounding = solid.rounding;
  const auto& [w, x, y, z] = solid.orientation;
  description.q_BS = {w, x, y, z};
  description.p_BS = {solid.position[0], solid.position[1], solid.position[2]};
  description.points.reserve(solid.points.size());
  for (const auto& [px, py, pz] : solid.points) description.points.emplace_back(px, py, pz);
  return description;
}

/// A number that its kind does not use was most likely meant for something: the radius of a capsule
/// given as a half extent would make the solid too thin, and contacts would be missed.
Reason RefusalOfUnused(const SolidContent& solid, const Kind& kind) {
  for (int i = 0; i < 3; ++i) {
    if (kind.uses_half[i] || solid.half_extents[i] == 0) continue;
    return fmt::format("half_extents[{}] is {}; allowed is 0: a {} has none along {}", i,
                       solid.half_extents[i], kind.name, "xyz"[i]);
  }
  if (kind.core == geometry::ConvexCore::kHull || solid.points.empty()) return std::nullopt;
  return fmt::format("there are {} points; allowed are 0: a {} has none", solid.points.size(),
                     kind.name);
}

/// The other numbers are checked with their ranges by the core; of a quaternion it checks the
/// length.
Reason RefusalOfOrientation(const SolidContent& solid) {
  for (std::size_t i = 0; i < 4; ++i) {
    if (std::isfinite(solid.orientation[i])) continue;
    return fmt::format("orientation.{} is {}; allowed are finite values", "wxyz"[i],
                       solid.orientation[i]);
  }
  return std::nullopt;
}

/// The core's sentence, in the words of the wire.
std::string InWords(std::string sentence) {
  constexpr std::pair<std::string_view, std::string_view> kWords[] = {
      {"convex.half", "half_extents"},
      {"convex.q_BS", "orientation"},
      {"convex.p_BS", "position"},
      {"convex.", ""},
      {"convex: ", ""}};
  for (const auto& [core, wire] : kWords) {
    if (sentence.starts_with(core)) return std::string(wire) + sentence.substr(core.size());
  }
  return sentence;
}

Reason RefusalOfSolid(const SolidContent& solid) {
  const Kind* kind = FindKind(solid.kind);
  if (kind == nullptr) {
    return fmt::format(
        "kind is {}; allowed are 1 (ball), 2 (capsule), 3 (box), 4 (ellipsoid), 5 (hull), 6 "
        "(cylinder) and 7 (cone)",
        static_cast<std::uint32_t>(solid.kind));
  }
  if (auto refusal = RefusalOfUnused(solid, *kind)) return refusal;
  if (auto refusal = RefusalOfOrientation(solid)) return refusal;
  auto refusal = RefusalOf(DescriptionOf(solid, *kind));
  if (refusal) *refusal = InWords(std::move(*refusal));
  return refusal;
}

std::string NameOf(const ShapeContent& content, std::size_t i) {
  const Kind* kind = FindKind(content.solids[i].kind);
  return fmt::format("solids[{}] of {}{}", i, content.solids.size(),
                     kind ? fmt::format(" ({})", kind->name) : "");
}

Reason RefusalOfSolids(const ShapeContent& content) {
  if (content.solids.size() > shape::kSolidsMax) {
    return fmt::format("{} convex solids; allowed: 0 to {}", content.solids.size(),
                       shape::kSolidsMax);
  }
  std::size_t points = 0;
  for (const SolidContent& solid : content.solids) points += solid.points.size();
  if (points > wire::kShapeHullPointsMax) {
    return fmt::format("its hulls have {} points; allowed: 0 to {}", points,
                       wire::kShapeHullPointsMax);
  }
  for (std::size_t i = 0; i < content.solids.size(); ++i) {
    if (auto refusal = RefusalOfSolid(content.solids[i])) {
      return NameOf(content, i) + ": " + *refusal;
    }
  }
  return std::nullopt;
}

/// The surface, repaired and taken away; none at all is allowed beside solids.
Reason TakeMesh(ShapeContent* content, std::size_t triangles_max, DecodedShape* decoded) {
  geometry::TriangleMesh mesh = MeshOf(*content);
  content->vertices = {};
  content->triangles = {};
  const bool has_surface = !mesh.vertices.empty() || !mesh.triangles.empty();
  if (!has_surface && !content->solids.empty()) return std::nullopt;
  if (auto refusal = RefusalOf(mesh, triangles_max)) return refusal;
  const std::size_t triangles = mesh.triangles.size();
  decoded->dropped = DropDegenerate(&mesh);
  if (mesh.triangles.empty()) {
    return fmt::format("all of its {} triangles are degenerate; at least 1 with an area is needed",
                       triangles);
  }
  decoded->mesh = std::move(mesh);
  return std::nullopt;
}

}  // namespace

std::optional<DecodedShape> DecodeAndCheck(std::string bytes, std::size_t triangles_max,
                                           std::string* refusal) {
  std::optional<ShapeContent> content = DecodeShape(bytes, refusal);
  if (!content) return std::nullopt;
  std::string().swap(bytes);
  DecodedShape decoded;
  Reason found = RefusalOfSolids(*content);
  if (!found) found = TakeMesh(&*content, triangles_max, &decoded);
  if (found) {
    *refusal = std::move(*found);
    return std::nullopt;
  }
  decoded.solids.reserve(content->solids.size());
  for (const SolidContent& solid : content->solids) {
    decoded.solids.push_back(
        shape::ConvexSolid::Build(DescriptionOf(solid, *FindKind(solid.kind))));
  }
  return decoded;
}

}  // namespace collision::server
