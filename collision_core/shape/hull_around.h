// The outer hull of all that a shape is made of.
#pragma once

#include "collision_core/shape/convex_solid.h"
#include "collision_core/shape/outer_hull.h"
#include "collision_core/shape/triangle_mesh.h"

namespace collision {

/// Around triangles and solids together: corners, and what they are rounded by where that is the
/// same for all; otherwise a solid's box. Of ellipsoids the box about their axes. Requires either.
OuterHull HullAround(const TriangleMesh& mesh, std::span<const ConvexSolid> solids);

}  // namespace collision
