// The better builder of sphere trees: balls fitted to the surface from inside.
#pragma once

#include "collision_core/shape/shape_options.h"
#include "collision_core/shape/sphere_tree.h"
#include "collision_core/shape/triangle_mesh.h"

namespace collision {

/// A whole tree, with certified radii and signed distances. Requires a mesh that passed RefusalOf();
/// `closed`: it is (MeshFacts). Deterministic. In time about n log n.
///
/// A ball inside a solid that touches the surface all over its part overshoots it by nothing, one
/// that touches it in the middle of a patch of width w by w² / 8R: so centres are sought inside,
/// where r + s is least. See CoverSearch; the surface of an open mesh has balls about the surface
/// itself.
///
/// A node's part is whole triangles and pieces of large ones (FittedPieces), each in one child; so
/// nothing is taken apart in vain where many triangles meet in one corner or lie upon each other.
SphereTree BuildFitted(const TriangleMesh& mesh, const ShapeOptions& options, bool closed);

}  // namespace collision
