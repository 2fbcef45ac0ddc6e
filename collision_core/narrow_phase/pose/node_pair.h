// The descent of two sphere trees at once: which node of a pair is opened next.
#pragma once

#include "collision_core/narrow_phase/pose/body_tree.h"
#include "collision_core/narrow_phase/pose/pair_parts.h"

namespace collision::narrow_phase {

/// Replaces a pair of nodes by smaller pairs: the node with the larger ball is opened, A's if both
/// are equal, and a leaf is never opened. Calls `visit(NodePair)` for each pair in the order of the
/// opened node's children. Returns false, without a visit, if both nodes are leaves.
///
/// Opening the larger node keeps the balls of a pair about equally large, so that their distance
/// tells about as much of one body as of the other. SeparationSearch, which opens packs of eight
/// children of both nodes in one step of wide vectors, has a rule of its own.
template <typename Visit>
bool OpenLarger(const BodyTree& tree_a, const BodyTree& tree_b, NodePair pair, Visit visit) {
  const sphere_tree::SphereNode& a = tree_a.node(pair.a);
  const sphere_tree::SphereNode& b = tree_b.node(pair.b);
  if (a.is_leaf() && b.is_leaf()) return false;
  if (b.is_leaf() || (!a.is_leaf() && a.radius >= b.radius)) {
    for (std::uint32_t i = 0; i < a.children; ++i) visit(NodePair{a.child(i), pair.b});
  } else {
    for (std::uint32_t i = 0; i < b.children; ++i) visit(NodePair{pair.a, b.child(i)});
  }
  return true;
}

}  // namespace collision::narrow_phase
