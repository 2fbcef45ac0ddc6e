// From the bytes of a shape to the body that they describe.
//
//   what            allowed                                               else refused as BAD_SHAPE
//   format          version 1 or 2 of idl/shape_bytes.h, complete
//   surface         1 to `triangles_max` triangles with an area (others are dropped and counted),
//                   or none beside solids; finite vertices, indices in range, a box of 1e-6 to
//                   1e7 m
//   convex solid    a known kind; measures of 0 to 1e7 m, and 0 where the kind has none; a position
//                   within 1e7 m; a quaternion of any length but 0; a size of 1e-6 to 1e7 m;
//                   1 to 65536 points in a hull and none in other kinds
//   all solids      at most 65536, with at most 2^20 points in all hulls (idl/limits.h)
//
// A refusal of a solid names its number, kind, field and value. Whether the bytes have the hash
// that they claim is checked before (shape_store.h), whether the shape fits its agent behind
// (intake/agent_shapes.h).
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "collision_core/geometry/mesh/triangle_mesh.h"
#include "collision_core/shape/convex_solid.h"

namespace collision::server {

/// Ready to be built: a surface, convex solids, or both.
struct DecodedShape {
  geometry::TriangleMesh
      mesh;  ///< Has no degenerate triangles; with none at all there is no surface.
  std::vector<shape::ConvexSolid> solids;
  std::size_t dropped = 0;  ///< Degenerate triangles.
};

/// Decodes, validates and repairs. nullopt, with the reason in *refusal. The bytes are freed as
/// soon as they are decoded: shapes are large.
std::optional<DecodedShape> DecodeAndCheck(std::string bytes, std::size_t triangles_max,
                                           std::string* refusal);

}  // namespace collision::server
