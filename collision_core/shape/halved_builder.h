// A builder of sphere trees that is quick: for until a better tree is there.
#pragma once

#include "collision_core/shape/shape_options.h"
#include "collision_core/shape/sphere_tree.h"
#include "collision_core/shape/triangle_mesh.h"

namespace collision {

/// Centres, radii, levels and leaves; every signed_distance is left at the radius, which is an upper
/// bound of the distance (the ball contains some of the surface). Requires a mesh that passed
/// RefusalOf(). The same for the same mesh, whatever the library. Takes n log n, 2 µs a triangle.
///
/// A node's part is whole triangles. They are halved three times for its children, at the median of
/// their middles along the axis in which these reach furthest, so that all leaves lie about as deep.
SphereTree BuildHalved(const TriangleMesh& mesh, const ShapeOptions& options);

}  // namespace collision
