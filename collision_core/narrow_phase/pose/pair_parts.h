// Parts of a pair of bodies: which body, which two nodes, which two elements.
#pragma once

#include <compare>

#include "collision_core/base/ids.h"

namespace collision::narrow_phase {

/// One of the two bodies of a pair.
enum class PairMember { kA, kB };

/// A node of A's sphere tree and one of B's.
struct NodePair {
  NodeIndex a, b;

  friend auto operator<=>(const NodePair&, const NodePair&) = default;
};

/// An element (a triangle or a convex solid) of A and one of B. A body that is a ball has none: its
/// index is not read.
struct ElementPair {
  ElementIndex a, b;

  friend auto operator<=>(const ElementPair&, const ElementPair&) = default;
};

}  // namespace collision::narrow_phase
