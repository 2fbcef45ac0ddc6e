#include "collision_core/sphere_tree/tree_cut.h"

#include <algorithm>
#include <queue>

namespace collision::sphere_tree {
namespace {

double OvershootOf(const SphereNode& node) { return node.radius + node.signed_distance; }

}  // namespace

std::vector<NodeIndex> CutOfCount(const SphereTree& tree, std::size_t count) {
  const auto later = [&tree](NodeIndex x, NodeIndex y) {
    const double of_x = OvershootOf(tree.node(x)), of_y = OvershootOf(tree.node(y));
    return of_x != of_y ? of_x < of_y : x > y;
  };
  std::priority_queue<NodeIndex, std::vector<NodeIndex>, decltype(later)> worst(later);
  std::vector<NodeIndex> cut;
  worst.push(SphereTree::kRoot);
  while (!worst.empty()) {
    const SphereNode& node = tree.node(worst.top());
    const std::size_t others = cut.size() + worst.size() - 1;
    if (node.is_leaf() || others + node.children > count) {
      cut.push_back(worst.top());
      worst.pop();
      continue;
    }
    worst.pop();
    for (std::uint32_t i = 0; i < node.children; ++i) worst.push(node.child(i));
  }
  std::sort(cut.begin(), cut.end());
  return cut;
}

Overshoot OvershootOf(const SphereTree& tree, std::span<const NodeIndex> cut) {
  Overshoot overshoot;
  for (const NodeIndex index : cut) {
    const double of_node = OvershootOf(tree.node(index));
    overshoot.max = std::max(overshoot.max, of_node);
    overshoot.mean += of_node / static_cast<double>(cut.size());
  }
  return overshoot;
}

}  // namespace collision::sphere_tree
