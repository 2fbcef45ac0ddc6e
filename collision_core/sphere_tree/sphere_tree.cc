#include "collision_core/sphere_tree/sphere_tree.h"

namespace collision::sphere_tree {

std::vector<NodeIndex> SphereTree::Cut(std::uint32_t level) const {
  std::vector<NodeIndex> cut;
  for (std::uint32_t i = 0; i < nodes.size() && nodes[i].level <= level; ++i) {
    if (nodes[i].level == level || nodes[i].is_leaf()) cut.emplace_back(i);
  }
  return cut;
}

std::size_t SphereTree::bytes() const {
  return nodes.capacity() * sizeof(SphereNode) + elements.capacity() * sizeof(ElementIndex);
}

}  // namespace collision::sphere_tree
