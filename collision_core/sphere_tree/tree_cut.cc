#include "collision_core/sphere_tree/tree_cut.h"

#include <algorithm>
#include <queue>

namespace collision::sphere_tree {
namespace {

double OvershootOf(const SphereNode& node) { return node.radius + node.signed_distance; }

}  // namespace

std::vector<std::uint32_t> CutOfCount(const SphereTree& tree, std::size_t count) {
  const auto later = [&tree](std::uint32_t x, std::uint32_t y) {
    const double of_x = OvershootOf(tree.nodes[x]), of_y = OvershootOf(tree.nodes[y]);
    return of_x != of_y ? of_x < of_y : x > y;
  };
  std::priority_queue<std::uint32_t, std::vector<std::uint32_t>, decltype(later)> worst(later);
  std::vector<std::uint32_t> cut;
  worst.push(0);
  while (!worst.empty()) {
    const SphereNode& node = tree.nodes[worst.top()];
    const std::size_t others = cut.size() + worst.size() - 1;
    if (node.children == 0 || others + node.children > count) {
      cut.push_back(worst.top());
      worst.pop();
      continue;
    }
    worst.pop();
    for (std::uint32_t i = 0; i < node.children; ++i) worst.push(node.first_child + i);
  }
  std::sort(cut.begin(), cut.end());
  return cut;
}

Overshoot OvershootOf(const SphereTree& tree, std::span<const std::uint32_t> cut) {
  Overshoot overshoot;
  for (const std::uint32_t index : cut) {
    const double of_node = OvershootOf(tree.nodes[index]);
    overshoot.max = std::max(overshoot.max, of_node);
    overshoot.mean += of_node / static_cast<double>(cut.size());
  }
  return overshoot;
}

}  // namespace collision::sphere_tree
