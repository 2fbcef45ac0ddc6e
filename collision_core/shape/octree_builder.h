// The reference builder of sphere trees: octants of the bounding cube.
#pragma once

#include <cstdint>

#include "collision_core/shape/shape_options.h"
#include "collision_core/shape/sphere_tree.h"
#include "collision_core/shape/triangle_mesh.h"

namespace collision {

/// An octant with more triangles is divided even if they all meet in one corner, which no division
/// takes apart: this many times triangles_per_leaf.
inline constexpr std::uint32_t kFanFactor = 4;

/// Centres, radii, levels and leaves; every signed_distance is left at the radius, which is an upper
/// bound of the distance (the ball contains some of the surface). Requires a mesh that passed
/// RefusalOf().
///
/// A node's part is what of the surface lies in its octant, about: triangles are cut at the octants'
/// faces, and the two pieces are exactly the whole, because the cut is *defined* by its rounded
/// place on each edge. What the corners of a piece may be off is in the radius (kCutError).
SphereTree BuildOctree(const TriangleMesh& mesh, const ShapeOptions& options);

/// The same octants, each in its circumscribed ball, as in Hubbard's paper: what others are compared
/// with. BuildOctree() takes a smaller ball around the part wherever it finds one.
SphereTree BuildCircumscribedOctree(const TriangleMesh& mesh, const ShapeOptions& options);

}  // namespace collision
