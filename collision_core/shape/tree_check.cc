#include "collision_core/shape/tree_check.h"

#include <cmath>

namespace collision {
namespace {

/// No ball about a mesh that passed RefusalOf() is as far or as large [m].
constexpr double kBallReachMax = 16 * kMeshReachMax;

std::string At(std::size_t node, const std::string& what) {
  return "node " + std::to_string(node) + ": " + what;
}

bool IsWithin(double value) { return std::abs(value) <= kBallReachMax; }

/// Also of what is not a number.
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
    if (node.children == 0) continue;
    if (node.children > kNodeChildrenMax) {
      return At(i, std::to_string(node.children) + " children; allowed: 0 to " +
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

std::optional<std::string> RefusalOfTriangles(const SphereTree& tree, const TriangleMesh& mesh) {
  std::vector<bool> held(mesh.triangles.size());
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const SphereNode& node = tree.nodes[i];
    const std::size_t all = tree.triangle_indices.size();
    if (node.triangles > all || node.first_triangle > all - node.triangles) {
      return At(i, "triangles beyond the last");
    }
    if (node.children > 0) continue;
    if (node.triangles == 0) return At(i, "a leaf without triangles");
    for (const std::uint32_t triangle : tree.TrianglesOf(node)) {
      if (triangle >= held.size()) return At(i, "a triangle that the mesh does not have");
      held[triangle] = true;
    }
  }
  for (std::size_t triangle = 0; triangle < held.size(); ++triangle) {
    if (!held[triangle]) return "triangle " + std::to_string(triangle) + " is in no leaf";
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> RefusalOf(const SphereTree& tree, const TriangleMesh& mesh) {
  const std::size_t nodes = tree.nodes.size(), triangles = tree.triangle_indices.size();
  if (nodes == 0 || nodes > kTreeSizeMax || triangles > kTreeSizeMax) {
    return std::to_string(nodes) + " nodes with " + std::to_string(triangles) +
           " triangles; allowed: 1 to " + std::to_string(kTreeSizeMax);
  }
  if (auto refusal = RefusalOfNodes(tree)) return refusal;
  return RefusalOfTriangles(tree, mesh);
}

}  // namespace collision
