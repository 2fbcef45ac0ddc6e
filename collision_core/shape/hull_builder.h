// The outer hull of a shape's triangles and solids.
#pragma once

#include "collision_core/geometry/mesh/triangle_mesh.h"
#include "collision_core/shape/convex_solid.h"
#include "collision_core/shape/outer_hull.h"

namespace collision::shape {

/// The outer hull of triangles and solids together. It is the hull of points, rounded by the least
/// rounding of all parts (0 for triangles). A solid with that rounding contributes the corners of
/// its core (an ellipsoid those of the box about its axes), a solid with a larger one the corners
/// of its bounding box. Requires at least one triangle or solid.
OuterHull HullAround(const geometry::TriangleMesh& mesh, std::span<const ConvexSolid> solids);

}  // namespace collision::shape
