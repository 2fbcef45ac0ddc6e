// One sphere tree over convex solids and a surface.
#pragma once

#include <span>

#include "collision_core/shape/convex_solid.h"
#include "collision_core/shape/sphere_tree.h"
#include "collision_core/shape/triangle_mesh.h"

namespace collision {

/// Every solid is a leaf of its own, with the element `triangles` + its number as its only one; the
/// surface's tree (of `triangles` triangles; null: none) hangs below as it is. Above them up to eight
/// balls at a time are gathered, near ones together. A signed distance is that to one of the union,
/// which the union is no further from: of a solid to a ball inside it.
///
/// Requires a solid. Takes n log n for n of them, and the copy of the surface's tree.
SphereTree BuildCompound(const SphereTree* surface, std::uint32_t triangles,
                         std::span<const ConvexSolid> solids);

/// Of a surface (or nothing: facts as constructed) and solids together.
void AddSolids(std::span<const ConvexSolid> solids, MeshFacts* facts);

}  // namespace collision
