#include "idl/tree_message.h"

namespace collision {
namespace {

bool IsOfOneLength(const v1::SphereTree& message) {
  const int nodes = message.radius_m_size();
  return message.centre_m_size() % 3 == 0 && message.centre_m_size() / 3 == nodes &&
         message.signed_distance_m_size() == nodes && message.level_size() == nodes &&
         message.first_child_size() == nodes && message.children_size() == nodes &&
         message.first_triangle_size() == nodes && message.triangles_size() == nodes;
}

v1::TreeRecipe::Builder BuilderOf(sphere_tree::TreeBuilder builder) {
  switch (builder) {
    case sphere_tree::TreeBuilder::kOctree:
      return v1::TreeRecipe::OCTREE;
    case sphere_tree::TreeBuilder::kFitted:
      return v1::TreeRecipe::FITTED;
    case sphere_tree::TreeBuilder::kMedianSplit:
      return v1::TreeRecipe::MEDIAN_SPLIT;
  }
  return v1::TreeRecipe::BUILDER_UNSET;
}

}  // namespace

v1::SphereTree ToMessage(const sphere_tree::SphereTree& tree) {
  v1::SphereTree message;
  message.set_levels(tree.levels);
  for (const sphere_tree::SphereNode& node : tree.nodes) {
    for (const double x : node.centre) message.add_centre_m(x);
    message.add_radius_m(node.radius);
    message.add_signed_distance_m(node.signed_distance);
    message.add_level(node.level);
    message.add_first_child(node.first_child);
    message.add_children(node.children);
    message.add_first_triangle(node.first_element);
    message.add_triangles(node.elements);
  }
  for (const ElementIndex triangle : tree.elements) {
    message.add_triangle_indices(triangle.value());
  }
  return message;
}

std::optional<sphere_tree::SphereTree> FromMessage(const v1::SphereTree& message) {
  if (!IsOfOneLength(message)) return std::nullopt;
  sphere_tree::SphereTree tree;
  tree.levels = message.levels();
  tree.nodes.resize(static_cast<std::size_t>(message.radius_m_size()));
  for (int i = 0; i < message.radius_m_size(); ++i) {
    sphere_tree::SphereNode& node = tree.nodes[static_cast<std::size_t>(i)];
    for (int axis = 0; axis < 3; ++axis) node.centre[axis] = message.centre_m(3 * i + axis);
    node.radius = message.radius_m(i);
    node.signed_distance = message.signed_distance_m(i);
    node.level = message.level(i);
    node.first_child = message.first_child(i);
    node.children = message.children(i);
    node.first_element = message.first_triangle(i);
    node.elements = message.triangles(i);
  }
  tree.elements.reserve(static_cast<std::size_t>(message.triangle_indices_size()));
  for (const std::uint32_t triangle : message.triangle_indices()) {
    tree.elements.emplace_back(triangle);
  }
  return tree;
}

v1::TreeRecipe RecipeOf(const sphere_tree::ShapeOptions& options) {
  v1::TreeRecipe recipe;
  recipe.set_builder(BuilderOf(options.builder));
  recipe.set_triangles_per_leaf(options.triangles_per_leaf);
  recipe.set_levels_max(options.levels_max);
  recipe.set_nodes_max(options.nodes_max);
  return recipe;
}

}  // namespace collision
