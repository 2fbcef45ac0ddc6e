// One sphere tree over convex solids and a surface.
#pragma once

#include <span>

#include "collision_core/geometry/mesh/triangle_mesh.h"
#include "collision_core/shape/convex_solid.h"
#include "collision_core/sphere_tree/sphere_tree.h"

namespace collision::shape {

/// Builds one tree over convex solids and a surface. Every solid is a leaf of its own, whose only
/// element is `triangles` + its number; the surface's tree (of `triangles` triangles; null: none)
/// is a subtree, unchanged. Each node above them gathers up to eight near balls. The signed
/// distance of such a gathering is the least, over its children, of the child's plus the distance
/// between the two centres: an upper bound, because the union is at least as near as any child.
///
/// O(n log n) for n solids, plus the copy of the surface's tree. Requires a solid.
sphere_tree::SphereTree BuildCompound(const sphere_tree::SphereTree* surface,
                                      std::uint32_t triangles, std::span<const ConvexSolid> solids);

/// Extends the facts of a surface (as constructed, if there is none) by those of solids.
void AddSolids(std::span<const ConvexSolid> solids, geometry::MeshFacts* facts);

}  // namespace collision::shape
