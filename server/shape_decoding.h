// From a shape's bytes to the body that they describe.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "collision_core/geometry/mesh/triangle_mesh.h"
#include "collision_core/shape/convex_solid.h"

namespace collision::server {

/// Points of all hulls of one shape together: they take memory beside the bytes that brought them.
inline constexpr std::size_t kSolidPointsMax = std::size_t{1} << 20;

/// Ready to be built: a surface, convex solids, or both.
struct DecodedShape {
  geometry::TriangleMesh mesh;  ///< Without degenerate triangles; without any: there is no surface.
  std::vector<shape::ConvexSolid> solids;
  std::size_t dropped = 0;  ///< Degenerate triangles.
};

/// Decodes, validates and repairs (degenerate triangles are dropped). nullopt, with the reason in
/// *refusal: which solid, field, value, allowed range. The bytes are gone afterwards: shapes are
/// large.
std::optional<DecodedShape> DecodeAndCheck(std::string bytes, std::size_t triangles_max,
                                           std::string* refusal);

}  // namespace collision::server
