#include "collision_core/sphere_tree/sphere_tree.h"

namespace collision::sphere_tree {

std::vector<std::uint32_t> SphereTree::Cut(std::uint32_t level) const {
  std::vector<std::uint32_t> cut;
  for (std::uint32_t i = 0; i < nodes.size() && nodes[i].level <= level; ++i) {
    if (nodes[i].level == level || nodes[i].children == 0) cut.push_back(i);
  }
  return cut;
}

std::size_t SphereTree::bytes() const {
  return nodes.capacity() * sizeof(SphereNode) +
         triangle_indices.capacity() * sizeof(std::uint32_t);
}

}  // namespace collision::sphere_tree
