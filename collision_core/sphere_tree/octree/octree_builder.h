// The reference builder of sphere trees: octants of the bounding cube.
#pragma once

#include <cstdint>

#include "collision_core/geometry/mesh/triangle_mesh.h"
#include "collision_core/sphere_tree/sphere_tree.h"
#include "collision_core/sphere_tree/tree_options.h"

namespace collision::sphere_tree {

/// Triangles that share one vertex (a fan) cannot be separated by dividing octants, so an octant
/// with only such triangles stays a leaf up to this many times triangles_per_leaf. With more it is
/// divided all the same.
inline constexpr std::uint32_t kFanFactor = 4;

/// Builds the reference tree: each node is an octant of its parent's cube, with a ball about the
/// part of the surface in it. Every signed_distance is left at the radius, which is an upper bound
/// of the distance (the ball contains some of the surface). Requires
/// IsWellFormed(mesh).
///
/// Cutting without error. A node's part is what of the surface lies in its octant. The cut of an
/// edge ab at an octant's face is *defined* as a + t (b − a) with the rounded t, which lies on the
/// edge exactly. So both pieces unite to the whole exactly, however t was rounded, and the plane
/// itself need not be met exactly. Only what is stored of that corner is rounded, by less than 10 ·
/// 2^-53 times the largest coordinate (kCutError); n cuts in a row lose n times as much. A ball
/// around the stored corners contains their hull; grown by the error it contains the hull of the
/// exact corners, which is the part.
///
/// The ball is the smaller of the octant's circumscribed ball and one by Bădoiu and Clarkson's
/// iteration. The second is nearly always smaller: a slice through a cube is smaller than the cube.
///
/// An octant whose surface lies in a single child is replaced by that child, so each level of the
/// tree has siblings, and a node's octant is at most the bounding cube halved `level` times.
/// Without the rule of kFanFactor every vertex of a fine mesh would be followed down to the last
/// level.
SphereTree BuildOctree(const geometry::TriangleMesh& mesh, const ShapeOptions& options);

/// The same octants, each in its circumscribed ball, as in Hubbard's paper (space_time_bound.h):
/// the measure to which the other builders are compared, by benchmarks and tests.
SphereTree BuildCircumscribedOctree(const geometry::TriangleMesh& mesh,
                                    const ShapeOptions& options);

}  // namespace collision::sphere_tree
