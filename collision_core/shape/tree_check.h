// Whether a sphere tree from outside can be one of a mesh.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "collision_core/shape/sphere_tree.h"
#include "collision_core/shape/triangle_mesh.h"

namespace collision {

/// A tree is laid out in packs of so many siblings.
inline constexpr std::uint32_t kNodeChildrenMax = 8;

/// Of nodes, and of triangles in leaves: so that they can be numbered in less than 32 bits.
inline constexpr std::size_t kTreeSizeMax = std::size_t{1} << 28;

/// Levels below the root and it: an octant halved so often is smaller than what doubles tell apart.
inline constexpr std::uint32_t kTreeDepthMax = 64;

/// Why nobody may use this tree with this mesh, as a sentence; nullopt: it has the structure that
/// sphere_tree.h states, every number is finite, every index in range, and its leaves hold every
/// triangle. No node has a single child, no triangle stands twice in a leaf, no two leaves share a
/// list, and all leaves together hold PiecesMax() triangles at most: so no traversal can leave the
/// tree, fail to end, or take more steps than a tree of this mesh may have. Whether the balls contain
/// their parts, and how far their centres are from the surface, would cost what building costs: that
/// is not looked at, and must be known otherwise. Linear in time, however the tree was made.
std::optional<std::string> RefusalOf(const SphereTree& tree, const TriangleMesh& mesh);

}  // namespace collision
