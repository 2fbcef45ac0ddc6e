// Whether a sphere tree from outside can be one of a mesh.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "collision_core/geometry/mesh/triangle_mesh.h"
#include "collision_core/sphere_tree/sphere_tree.h"

namespace collision::sphere_tree {

/// The most children of a node: a tree is laid out in packs of so many siblings.
inline constexpr std::uint32_t kNodeChildrenMax = 8;

/// The most nodes, and the most triangles in leaves, so that 28 bits number them.
inline constexpr std::size_t kTreeSizeMax = std::size_t{1} << 28;

/// The most levels, the root included: an octant halved so often is smaller than the spacing of
/// doubles.
inline constexpr std::uint32_t kTreeDepthMax = 64;

/// The most levels of gathered balls above the surface's tree and the solids of a compound, each of
/// which has an eighth of the one below: six for kSolidsMax (shape.h), and two more.
inline constexpr std::uint32_t kGatheredLevelsMax = 8;

/// How many elements the leaves of a tree hold, by their numbers (ElementIndex).
struct TreeElements {
  std::size_t triangles = 0;
  std::size_t solids = 0;  ///< Each alone in its leaf.
};

/// Why this tree must not be used with this mesh, as a sentence; nullopt: it has the structure that
/// sphere_tree.h states. Every number is finite, every index in range, and its leaves hold every
/// triangle. No node has a single child, no triangle stands twice in a leaf, no two leaves share a
/// list, and all leaves together hold PiecesMax() triangles at most. So no traversal can leave the
/// tree, fail to end, or take more steps than a tree of this mesh may have.
///
/// Not checked: whether the balls contain their parts, and how far their centres are from the
/// surface. That would cost what building costs and must be known otherwise (the cache stores a
/// hash). Linear in time, however the tree was made.
std::optional<std::string> RefusalOf(const SphereTree& tree, const geometry::TriangleMesh& mesh);

/// The same for a tree with these elements: with solids, the lists of the leaves of triangles come
/// first, and the tree may be deeper by kGatheredLevelsMax. No builder makes a tree that it
/// refuses, if the mesh passed RefusalOf().
std::optional<std::string> RefusalOf(const SphereTree& tree, const TreeElements& elements);

}  // namespace collision::sphere_tree
