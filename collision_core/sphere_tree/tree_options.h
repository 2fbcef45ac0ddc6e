// How a sphere tree is to be built.
#pragma once

#include <cstddef>
#include <cstdint>

namespace collision::sphere_tree {

/// The builders of sphere trees.
enum class TreeBuilder : std::uint8_t {
  kOctree,      ///< The reference: octants of the bounding cube.
  kFitted,      ///< Balls fitted to the surface from inside, eight children a node: much tighter.
  kMedianSplit  ///< Quick, until another tree is built: only its first balls are measured.
};

/// Whether a surface has an inside (MeshFacts::closed).
enum class SurfaceKind : std::uint8_t { kOpen, kClosed };

/// Options of Shape::Build().
struct ShapeOptions {
  TreeBuilder builder = TreeBuilder::kOctree;
  std::uint32_t triangles_per_leaf = 4;  ///< A node with at most this many is not divided.
  /// The deepest level of a node; for the octree, the most times that the bounding cube is halved.
  std::uint32_t levels_max = 12;
  /// The most nodes of the tree; beyond, nodes become leaves with more triangles.
  std::size_t nodes_max = std::size_t{1} << 20;
};

}  // namespace collision::sphere_tree
