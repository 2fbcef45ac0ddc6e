// The outer hull of all that a shape is made of.
#pragma once

#include "collision_core/geometry/mesh/triangle_mesh.h"
#include "collision_core/shape/convex_solid.h"
#include "collision_core/shape/outer_hull.h"

namespace collision::shape {

/// The outer hull of triangles and solids together: of their corners, rounded by what all are
/// rounded by; a solid that is rounded otherwise counts by its box, an ellipsoid by the box about
/// its axes. Requires a triangle or a solid.
OuterHull HullAround(const geometry::TriangleMesh& mesh, std::span<const ConvexSolid> solids);

}  // namespace collision::shape
