// The quick builder of sphere trees, for the time until a better tree is built.
#pragma once

#include "collision_core/geometry/mesh/triangle_mesh.h"
#include "collision_core/sphere_tree/sphere_tree.h"
#include "collision_core/sphere_tree/tree_options.h"

namespace collision::sphere_tree {

/// Builds a coarse tree of whole triangles: they are halved three times for a node's children, at
/// the median of their middles along the axis in which these reach furthest, so that all leaves lie
/// about as deep. Every signed_distance is left at the radius, which is an upper bound of the
/// distance (the ball contains some of the surface); the caller measures the first 1024 balls.
/// Deterministic: the same mesh gives the same bits with every standard library. O(n log n), 2 µs a
/// triangle. Requires IsWellFormed(mesh).
SphereTree BuildMedianSplit(const geometry::TriangleMesh& mesh, const ShapeOptions& options);

}  // namespace collision::sphere_tree
