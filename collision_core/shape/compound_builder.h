// One sphere tree over convex solids and a surface.
#pragma once

#include <span>

#include "collision_core/geometry/mesh/triangle_mesh.h"
#include "collision_core/shape/convex_solid.h"
#include "collision_core/sphere_tree/sphere_tree.h"

namespace collision::shape {

/// Builds one tree over convex solids and a surface. Every solid is a leaf of its own, whose only
/// element is `triangles` + its number; the surface's tree (of `triangles` triangles; null: none)
/// hangs below as it is. Above them up to eight near balls at a time are gathered into one. The
/// signed distance of a gathering is that of its best child, plus the way between the two centres;
/// the union is at least as near.
///
/// O(n log n) for n solids, plus the copy of the surface's tree. Requires a solid.
sphere_tree::SphereTree BuildCompound(const sphere_tree::SphereTree* surface,
                                      std::uint32_t triangles, std::span<const ConvexSolid> solids);

/// Extends the facts of a surface (as constructed, if there is none) by those of solids.
void AddSolids(std::span<const ConvexSolid> solids, geometry::MeshFacts* facts);

}  // namespace collision::shape
