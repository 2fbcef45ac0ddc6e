// How a sphere tree is to be built.
#pragma once

#include <cstddef>
#include <cstdint>

namespace collision {

enum class TreeBuilder : std::uint8_t {
  kOctree,  ///< The reference: octants of the bounding cube.
  kFitted,  ///< Balls fitted to the surface from inside, eight children a node: tighter by far.
  kHalved   ///< Quick, for until another tree is there: only its first balls are measured.
};

struct ShapeOptions {
  TreeBuilder builder = TreeBuilder::kOctree;
  std::uint32_t triangles_per_leaf = 4;  ///< A node with so few is not divided.
  std::uint32_t levels_max = 12;         ///< Octants are halved at most so often.
  /// The tree's nodes at most: beyond, nodes become leaves with more triangles.
  std::size_t nodes_max = std::size_t{1} << 20;
};

}  // namespace collision
