#include "collision_core/sphere_tree/tree_check.h"

#include <cmath>

namespace collision::sphere_tree {
namespace {

/// No ball about a mesh that passed RefusalOf() is as far or as large [m].
constexpr double kBallReachMax = 16 * geometry::kMeshReachMax;

std::string At(std::size_t node, const std::string& what) {
  return "node " + std::to_string(node) + ": " + what;
}

bool IsWithin(double value) { return std::abs(value) <= kBallReachMax; }

/// Returns false for NaN as well.
bool HasBall(const SphereNode& node) {
  return IsWithin(node.centre.x()) && IsWithin(node.centre.y()) && IsWithin(node.centre.z()) &&
         IsWithin(node.radius) && node.radius >= 0 && IsWithin(node.signed_distance);
}

/// The children of all nodes stand one after the other, in the order of their parents: so each node
/// but the root has one parent, which stands before it.
std::optional<std::string> RefusalOfNodes(const SphereTree& tree) {
  std::size_t next_child = 1;
  std::uint32_t levels = 0;
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const SphereNode& node = tree.nodes[i];
    if (!HasBall(node)) return At(i, "no ball");
    if (i == 0 && node.level != 0) return At(i, "the root is on level 0");
    levels = node.level + 1;
    if (levels > kTreeDepthMax) {
      return At(i, "level " + std::to_string(node.level) + "; allowed: less than " +
                       std::to_string(kTreeDepthMax));
    }
    if (node.children == 0) continue;
    if (node.children == 1 || node.children > kNodeChildrenMax) {
      return At(i, std::to_string(node.children) + " children; allowed: 0, or 2 to " +
                       std::to_string(kNodeChildrenMax));
    }
    if (node.first_child != next_child || node.first_child <= i) {
      return At(i, "its children do not stand where they belong");
    }
    if (node.children > tree.nodes.size() - next_child) return At(i, "children beyond the last");
    for (const SphereNode& child : tree.ChildrenOf(node)) {
      if (child.level != node.level + 1) return At(i, "a child on another level than the next");
    }
    next_child += node.children;
  }
  if (next_child != tree.nodes.size()) return "nodes without a parent";
  if (tree.levels != levels) return "another number of levels";
  return std::nullopt;
}

/// The leaves' lists stand one after the other, in the order of the leaves, and each names a
/// triangle once: so all of them together are no longer than `elements`.
std::optional<std::string> RefusalOfTriangles(const SphereTree& tree,
                                              const geometry::TriangleMesh& mesh) {
  std::vector<bool> held(mesh.triangles.size());
  std::size_t next_triangle = 0;
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const SphereNode& node = tree.nodes[i];
    if (node.children > 0) {
      if (node.elements > 0) return At(i, "triangles of its own beside children");
      continue;
    }
    if (node.elements == 0) return At(i, "a leaf without triangles");
    if (node.first_element != next_triangle) {
      return At(i, "its triangles do not stand where they belong");
    }
    if (node.elements > tree.elements.size() - next_triangle) {
      return At(i, "triangles beyond the last");
    }
    std::size_t least = 0;
    for (const ElementIndex element : tree.ElementsOf(node)) {
      const std::size_t triangle = element.value();
      if (triangle >= held.size()) return At(i, "a triangle that the mesh does not have");
      if (triangle < least) return At(i, "its triangles do not ascend");
      least = triangle + 1;
      held[triangle] = true;
    }
    next_triangle += node.elements;
  }
  if (next_triangle != tree.elements.size()) return "triangles that no leaf has";
  for (std::size_t triangle = 0; triangle < held.size(); ++triangle) {
    if (!held[triangle]) return "triangle " + std::to_string(triangle) + " is in no leaf";
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> RefusalOf(const SphereTree& tree, const geometry::TriangleMesh& mesh) {
  const std::size_t nodes = tree.nodes.size(), triangles = tree.elements.size();
  if (nodes == 0 || nodes > kTreeSizeMax || triangles > kTreeSizeMax) {
    return std::to_string(nodes) + " nodes with " + std::to_string(triangles) +
           " triangles; allowed: 1 to " + std::to_string(kTreeSizeMax);
  }
  if (const std::size_t most = PiecesMax(mesh.triangles.size()); triangles > most) {
    return std::to_string(triangles) + " triangles in leaves; allowed: " + std::to_string(most);
  }
  if (auto refusal = RefusalOfNodes(tree)) return refusal;
  return RefusalOfTriangles(tree, mesh);
}

}  // namespace collision::sphere_tree
