#include "collision_core/sphere_tree/packed_tree.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "collision_core/base/check.h"
#include "collision_core/numeric/allowances.h"

namespace collision::sphere_tree {
namespace {

/// The least float that is at least x.
float FloatUp(double x) {
  const auto rounded = static_cast<float>(x);
  if (static_cast<double>(rounded) >= x) return rounded;
  return std::nextafter(rounded, std::numeric_limits<float>::infinity());
}

constexpr Eigen::Index kAxes = 3;

/// Relative to the lengths of a centre and of the origin: their difference is off by 2^-53 of each
/// coordinate; four times that.
constexpr double kDifferenceRounding = 0x1p-51;

/// A sum of two doubles is off by 2^-53 of itself; of the larger term, or of the sum of both
/// magnitudes, twice that.
constexpr double kSumRounding = 0x1p-52;

BallPack EmptyPack() {
  BallPack pack;
  for (std::uint32_t i = 0; i < kPackBalls; ++i) {
    pack.x[i] = pack.y[i] = pack.z[i] = kFarCoordinate;
    pack.radius[i] = -kFarDistance;
    pack.signed_distance[i] = kFarDistance;
    pack.link[i] = BallLink::kLeaf;
  }
  return pack;
}

/// The middle of the balls' box: coordinates seen from there lose the least.
Eigen::Vector3d MiddleOf(const SphereTree& tree) {
  CORE_CHECK(!tree.nodes.empty(), "a tree has a root");
  Eigen::Vector3d lower = tree.root().centre, upper = lower;
  for (const SphereNode& node : tree.nodes) {
    lower = lower.cwiseMin(node.centre), upper = upper.cwiseMax(node.centre);
  }
  return 0.5 * lower + 0.5 * upper;
}

}  // namespace

/// A ball, by its number, and the nodes that it holds: its children, or a part of them where they
/// are too many for a pack. None: a leaf.
struct PackedTree::PackSlot {
  NodeIndex node;
  std::uint32_t first, count;
};

struct PackedTree::PackSlots {
  std::array<PackSlot, kPackBalls> slot;
  std::uint32_t count = 0;

  void Add(const PackSlot& more) { slot[count++] = more; }
  void Add(const SphereTree& tree, NodeIndex node) {
    Add({node, tree.node(node).first_child, tree.node(node).children});
  }
};

PackedTree::PackedTree(const geometry::TriangleMesh& mesh, const SphereTree& tree)
    : origin_(MiddleOf(tree)) {
  PackSlots root;
  root.Add(tree, SphereTree::kRoot);
  std::vector<PackSlots> packs = {root};
  for (std::uint32_t next = 0; next < packs.size(); ++next) {
    const PackSlots slots = packs[next];
    packs_.push_back(EmptyPack());
    nodes_.resize(packs_.size() * kPackBalls);
    for (std::uint32_t i = 0; i < slots.count; ++i) {
      const PackSlot& slot = slots.slot[i];
      const SphereNode& node = tree.node(slot.node);
      nodes_[next * kPackBalls + i] = slot.node;
      SetBall(node, next * kPackBalls + i);
      if (slot.count == 0) {
        packs_[next].link[i] = AddLeaf(mesh, tree, node);
        continue;
      }
      const PackSlots inner = SlotsOf(tree, slot);
      packs_[next].link[i] = static_cast<std::uint32_t>(packs.size()) | (inner.count - 1)
                                                                            << BallLink::kIndexBits;
      packs.push_back(inner);
    }
  }
  FindExtremes(mesh);
}

// Replaces the node of the pack that overshoots its surface the most by its children, as long as
// there is room for them: a step opens a whole pack, whether it is full or not. If there are more
// nodes than a pack holds, they are shared out among slots with the parent's own ball.
PackedTree::PackSlots PackedTree::SlotsOf(const SphereTree& tree, const PackSlot& parent) {
  PackSlots slots;
  if (parent.count > kPackBalls) {
    const std::uint32_t wanted = std::min(kPackBalls, (parent.count + kPackBalls - 1) / kPackBalls);
    for (std::uint32_t first = 0; slots.count < wanted;) {
      const std::uint32_t left = wanted - slots.count;
      const std::uint32_t count = (parent.count - first + left - 1) / left;
      slots.Add({parent.node, parent.first + first, count});
      first += count;
    }
    return slots;
  }
  for (std::uint32_t i = 0; i < parent.count; ++i) slots.Add(tree, NodeIndex(parent.first + i));
  const auto overshoot = [&](const PackSlot& slot) {
    return tree.node(slot.node).radius + tree.node(slot.node).signed_distance;
  };
  for (;;) {
    PackSlot* widest = nullptr;
    for (std::uint32_t i = 0; i < slots.count; ++i) {
      PackSlot& slot = slots.slot[i];
      if (slot.count == 0 || slots.count - 1 + slot.count > kPackBalls) continue;
      if (widest == nullptr || overshoot(slot) > overshoot(*widest)) widest = &slot;
    }
    if (widest == nullptr) return slots;
    const PackSlot opened = *widest;
    *widest = slots.slot[--slots.count];
    for (std::uint32_t i = 0; i < opened.count; ++i) slots.Add(tree, NodeIndex(opened.first + i));
  }
}

// The centre moves by `moved` at most, which includes what the differences here are rounded by:
// each is off by 2^-53 of itself. A ball about the new centre that is larger by that contains the
// old one. A signed distance changes by no more than the point moves: of a ball within the solid
// the smaller one stays, and the surface is farther by no more than that.
void PackedTree::SetBall(const SphereNode& node, BallRef ball) {
  BallPack& pack = packs_[ball / kPackBalls];
  const std::uint32_t i = ball % kPackBalls;
  const Eigen::Vector3d seen = node.centre - origin_;
  const Eigen::Vector3f centre = seen.cast<float>();
  const double rounding = kDifferenceRounding * (node.centre.norm() + origin_.norm());
  const double moved = (seen - centre.cast<double>()).norm() * numeric::kFewRoundingsUp + rounding;
  pack.x[i] = centre.x(), pack.y[i] = centre.y(), pack.z[i] = centre.z();
  const double radius = node.radius + moved, distance = node.signed_distance + moved;
  pack.radius[i] = FloatUp(radius + kSumRounding * radius);
  pack.signed_distance[i] =
      FloatUp(distance + kSumRounding * (std::abs(node.signed_distance) + moved));
  const double widest = std::max<double>(pack.radius[i], std::abs(pack.signed_distance[i]));
  extent_ = std::max(extent_, (seen.norm() + moved + widest) * numeric::kFewRoundingsUp);
}

std::uint32_t PackedTree::AddLeaf(const geometry::TriangleMesh& mesh, const SphereTree& tree,
                                  const SphereNode& leaf) {
  const auto elements = tree.ElementsOf(leaf);
  const auto first = static_cast<std::uint32_t>(blocks_.size());
  for (std::size_t done = 0; done < elements.size(); done += kBlockTriangles) {
    TriangleBlock& block = blocks_.emplace_back();
    block.reach = 0;
    block.left = static_cast<std::uint32_t>(elements.size() - done);
    for (std::uint32_t i = 0; i < kBlockTriangles; ++i) {
      SetElement(mesh, elements[i < block.left ? done + i : done], i, &block);
    }
  }
  return first | BallLink::kLeaf;
}

void PackedTree::SetElement(const geometry::TriangleMesh& mesh, ElementIndex element,
                            std::uint32_t lane, TriangleBlock* block) {
  Eigen::Vector3d corners[3] = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(),
                                Eigen::Vector3d::Zero()};
  const bool is_solid = element.value() >= mesh.triangles.size();
  for (std::size_t k = 0; k < 3 && !is_solid; ++k) {
    const Eigen::Vector3d& vertex = mesh.vertices[mesh.triangles[element.value()][k]];
    block->reach = std::max(block->reach, FloatUp(vertex.norm() * numeric::kFewRoundingsUp));
    corners[k] = vertex - origin_;
    extent_ = std::max(extent_, corners[k].norm() * numeric::kFewRoundingsUp);
  }
  const Eigen::Vector3d across = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  const double length = across.norm();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  if (length > 0 && length < std::numeric_limits<double>::max()) normal = across / length;
  // As they are stored, so that `above` and `below` speak of them.
  const Eigen::Vector3f stored = normal.cast<float>();
  float above = -kFarDistance, below = kFarDistance;
  for (std::uint32_t k = 0; k < 4; ++k) {
    const Eigen::Vector3f place = k < 3 ? corners[k].cast<float>() : stored;
    const std::uint32_t at = kBlockTriangles * k + lane;
    block->x[at] = place.x(), block->y[at] = place.y(), block->z[at] = place.z();
    if (k == 3) continue;
    const auto height = static_cast<float>(stored.cast<double>().dot(place.cast<double>()));
    above = std::max(above, height), below = std::min(below, height);
  }
  block->above[lane] = above, block->below[lane] = below;
  block->element[lane] = element;
}

void PackedTree::FindExtremes(const geometry::TriangleMesh& mesh) {
  for (std::size_t which = 0; which < extremes_.size(); ++which) {
    Eigen::Vector3d direction = Eigen::Vector3d::Zero();
    if (which < 6) {
      direction[static_cast<Eigen::Index>(which / 2)] = which % 2 == 0 ? 1 : -1;
    } else {
      const std::size_t signs = which - 6;
      for (Eigen::Index axis = 0; axis < kAxes; ++axis) {
        direction[axis] = (signs >> axis & 1) == 0 ? 1 : -1;
      }
    }
    double farthest = -std::numeric_limits<double>::infinity();
    for (const geometry::Triangle& triangle : mesh.triangles) {
      for (const std::uint32_t vertex : triangle) {
        const double along = direction.dot(mesh.vertices[vertex] - origin_);
        if (along > farthest) farthest = along, extremes_[which] = mesh.vertices[vertex];
      }
    }
  }
}

std::size_t PackedTree::bytes() const {
  return packs_.capacity() * sizeof(BallPack) + nodes_.capacity() * sizeof(nodes_[0]) +
         blocks_.capacity() * sizeof(TriangleBlock);
}

BallPack PackOfBall(double radius) {
  BallPack pack = EmptyPack();
  pack.x[0] = pack.y[0] = pack.z[0] = 0;
  pack.radius[0] = FloatUp(radius);
  pack.signed_distance[0] = FloatUp(-radius);
  return pack;
}

}  // namespace collision::sphere_tree
