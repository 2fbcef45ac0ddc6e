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

/// Why nobody may use this tree with this mesh, as a sentence; nullopt: it has the structure that
/// sphere_tree.h states, every number is finite, every index in range, and its leaves hold every
/// triangle. So no traversal can leave it or fail to end. Whether the balls contain their parts,
/// and how far their centres are from the surface, would cost what building costs: that is not
/// looked at, and must be known otherwise. Linear in time.
std::optional<std::string> RefusalOf(const SphereTree& tree, const TriangleMesh& mesh);

}  // namespace collision
