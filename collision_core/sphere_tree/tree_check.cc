#include "collision_core/sphere_tree/tree_check.h"

#include <cmath>

namespace collision::sphere_tree {
namespace {

/// No ball about a mesh that passed RefusalOf(), or about the largest block of a half-space
/// (shape/fixed_half_space.cc), is as far or as large [m].
constexpr double kBallReachMax = 64 * geometry::kMeshReachMax;

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
std::optional<std::string> RefusalOfNodes(const SphereTree& tree, std::uint32_t levels_max) {
  std::size_t next_child = 1;
  std::uint32_t levels = 0;
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const SphereNode& node = tree.nodes[i];
    if (!HasBall(node)) return At(i, "no ball");
    if (i == 0 && node.level != 0) return At(i, "the root is on level 0");
    levels = node.level + 1;
    if (levels > levels_max) {
      return At(i, "level " + std::to_string(node.level) + "; allowed: less than " +
                       std::to_string(levels_max));
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

/// The leaves' lists stand one after the other, in the order of the leaves, and each names an
/// element once: so all of them together are no longer than `elements`. The solids' lists, of one
/// each, come after all lists of triangles.
std::optional<std::string> RefusalOfLeaves(const SphereTree& tree, const TreeElements& elements) {
  std::vector<bool> held(elements.triangles + elements.solids);
  const std::size_t pieces = tree.elements.size() - elements.solids;
  std::size_t next_piece = 0, next_solid = pieces;
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const SphereNode& node = tree.nodes[i];
    if (node.children > 0) {
      if (node.elements > 0) return At(i, "triangles of its own beside children");
      continue;
    }
    if (node.elements == 0) return At(i, "a leaf without triangles");
    const bool is_solid = node.first_element >= pieces;
    std::size_t& next = is_solid ? next_solid : next_piece;
    if (node.first_element != next) return At(i, "its triangles do not stand where they belong");
    if (node.elements > (is_solid ? tree.elements.size() : pieces) - next) {
      return At(i, "triangles beyond the last");
    }
    if (is_solid && node.elements > 1) return At(i, "a solid that is not alone in its leaf");
    const std::size_t end = is_solid ? held.size() : elements.triangles;
    std::size_t least = is_solid ? elements.triangles : 0;
    for (const ElementIndex index : tree.ElementsOf(node)) {
      const std::size_t element = index.value();
      if (element >= end) return At(i, "a triangle that the mesh does not have");
      if (element < least) return At(i, "its triangles do not ascend");
      least = element + 1;
      held[element] = true;
    }
    next += node.elements;
  }
  if (next_piece != pieces || next_solid != tree.elements.size())
    return "triangles that no leaf has";
  for (std::size_t element = 0; element < held.size(); ++element) {
    if (!held[element]) return "element " + std::to_string(element) + " is in no leaf";
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> RefusalOf(const SphereTree& tree, const TreeElements& elements) {
  const std::size_t nodes = tree.nodes.size(), held = tree.elements.size();
  if (nodes == 0 || nodes > kTreeSizeMax || held > kTreeSizeMax) {
    return std::to_string(nodes) + " nodes with " + std::to_string(held) +
           " triangles; allowed: 1 to " + std::to_string(kTreeSizeMax);
  }
  if (held < elements.solids) return "solids that no leaf has";
  const std::size_t pieces = held - elements.solids;
  if (const std::size_t most = PiecesMax(elements.triangles); pieces > most) {
    return std::to_string(pieces) + " triangles in leaves; allowed: " + std::to_string(most);
  }
  const std::uint32_t gathered = elements.solids > 0 ? kGatheredLevelsMax : 0;
  if (auto refusal = RefusalOfNodes(tree, kTreeDepthMax + gathered)) return refusal;
  return RefusalOfLeaves(tree, elements);
}

std::optional<std::string> RefusalOf(const SphereTree& tree, const geometry::TriangleMesh& mesh) {
  return RefusalOf(tree, TreeElements{.triangles = mesh.triangles.size()});
}

}  // namespace collision::sphere_tree
