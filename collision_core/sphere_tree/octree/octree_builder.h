// The reference builder of sphere trees: octants of the bounding cube.
#pragma once

#include <cstdint>

#include "collision_core/geometry/mesh/triangle_mesh.h"
#include "collision_core/sphere_tree/sphere_tree.h"
#include "collision_core/sphere_tree/tree_options.h"

namespace collision::sphere_tree {

/// An octant with more triangles is divided even if they all meet in one corner, which no division
/// takes apart: this many times triangles_per_leaf.
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
/// An octant with a single child that has everything becomes that child, so a level is a step in
/// the tree, and a node's octant is at most the bounding cube halved `level` times. Triangles that
/// all meet in one corner cannot be taken apart: up to kFanFactor times the usual number they stay
/// a leaf. Without that rule every vertex of a fine mesh would be followed down to the last level.
SphereTree BuildOctree(const geometry::TriangleMesh& mesh, const ShapeOptions& options);

/// The same octants, each in its circumscribed ball, as in Hubbard's paper (space_time_bound.h):
/// the measure to which the other builders are compared.
SphereTree BuildCircumscribedOctree(const geometry::TriangleMesh& mesh,
                                    const ShapeOptions& options);

}  // namespace collision::sphere_tree
