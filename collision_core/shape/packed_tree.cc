#include "collision_core/shape/packed_tree.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace collision {
namespace {

/// The least float that is at least x.
float FloatUp(double x) {
  const auto rounded = static_cast<float>(x);
  if (static_cast<double>(rounded) >= x) return rounded;
  return std::nextafter(rounded, std::numeric_limits<float>::infinity());
}

constexpr Eigen::Index kAxes = 3;

BallPack EmptyPack() {
  BallPack pack;
  for (std::uint32_t i = 0; i < kPackBalls; ++i) {
    pack.x[i] = pack.y[i] = pack.z[i] = 0;
    pack.radius[i] = -kNowhere;
    pack.signed_distance[i] = kNowhere;
    pack.link[i] = BallLink::kLeaf;
  }
  return pack;
}

/// The middle of the balls' box: coordinates seen from there lose the least.
Eigen::Vector3d MiddleOf(const SphereTree& tree) {
  Eigen::Vector3d lower = tree.root().centre, upper = lower;
  for (const SphereNode& node : tree.nodes) {
    lower = lower.cwiseMin(node.centre), upper = upper.cwiseMax(node.centre);
  }
  return 0.5 * lower + 0.5 * upper;
}

}  // namespace

/// A node whose pack of children is still to be filled: nodes [first, first + count), or where they
/// are too many for a pack, `parent` again and again, each with a part of them.
struct PackedTree::Waiting {
  std::uint32_t pack, parent, first, count;
};

PackedTree::PackedTree(const TriangleMesh& mesh, const SphereTree& tree) : origin_(MiddleOf(tree)) {
  std::vector<Waiting> waiting = {{AddPack(0, 1), 0, 0, 1}};
  for (std::size_t next = 0; next < waiting.size(); ++next) {
    const Waiting parent = waiting[next];
    if (parent.count > kPackBalls) {
      AddChildren(tree, parent, &waiting);
      continue;
    }
    for (std::uint32_t i = 0; i < parent.count; ++i) {
      const SphereNode& node = tree.nodes[parent.first + i];
      const BallRef ball = parent.pack * kPackBalls + i;
      SetBall(node, ball);
      std::uint32_t link = 0;
      if (node.children == 0) {
        link = AddLeaf(mesh, tree, node);
      } else {
        const bool fits = node.children <= kPackBalls;
        const std::uint32_t lanes =
            fits ? node.children : std::min(kPackBalls, (node.children + 7) / kPackBalls);
        const std::uint32_t pack =
            fits ? AddPack(node.first_child, 1) : AddPack(parent.first + i, 0);
        waiting.push_back({pack, parent.first + i, node.first_child, node.children});
        link = pack | (lanes - 1) << BallLink::kIndexBits;
      }
      packs_[parent.pack].link[i] = link;
    }
  }
  FindExtremes(mesh);
}

// More children than a pack holds: lanes with the parent's own ball share them out.
void PackedTree::AddChildren(const SphereTree& tree, const Waiting& parent,
                             std::vector<Waiting>* waiting) {
  const std::uint32_t lanes = std::min(kPackBalls, (parent.count + kPackBalls - 1) / kPackBalls);
  std::uint32_t first = parent.first;
  for (std::uint32_t i = 0; i < lanes; ++i) {
    const std::uint32_t rest = parent.first + parent.count - first;
    const std::uint32_t count = (rest + lanes - i - 1) / (lanes - i);
    SetBall(tree.nodes[parent.parent], parent.pack * kPackBalls + i);
    const bool fits = count <= kPackBalls;
    const std::uint32_t inner =
        fits ? count : std::min(kPackBalls, (count + kPackBalls - 1) / kPackBalls);
    const std::uint32_t pack = fits ? AddPack(first, 1) : AddPack(parent.parent, 0);
    packs_[parent.pack].link[i] = pack | (inner - 1) << BallLink::kIndexBits;
    waiting->push_back({pack, parent.parent, first, count});
    first += count;
  }
}

std::uint32_t PackedTree::AddPack(std::uint32_t first, std::uint32_t step) {
  packs_.push_back(EmptyPack());
  nodes_.push_back({first, step});
  return static_cast<std::uint32_t>(packs_.size() - 1);
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
  const double rounding = 0x1p-51 * (node.centre.norm() + origin_.norm());
  const double moved = (seen - centre.cast<double>()).norm() * (1 + 0x1p-50) + rounding;
  pack.x[i] = centre.x(), pack.y[i] = centre.y(), pack.z[i] = centre.z();
  // Sums of two doubles: 2^-52 of the larger covers them.
  const double radius = node.radius + moved, distance = node.signed_distance + moved;
  pack.radius[i] = FloatUp(radius + 0x1p-52 * radius);
  pack.signed_distance[i] = FloatUp(distance + 0x1p-52 * (std::abs(node.signed_distance) + moved));
  const double widest = std::max<double>(pack.radius[i], std::abs(pack.signed_distance[i]));
  extent_ = std::max(extent_, (seen.norm() + moved + widest) * (1 + 0x1p-50));
}

std::uint32_t PackedTree::AddLeaf(const TriangleMesh& mesh, const SphereTree& tree,
                                  const SphereNode& leaf) {
  const auto triangles = tree.TrianglesOf(leaf);
  const auto first = static_cast<std::uint32_t>(blocks_.size());
  for (std::size_t done = 0; done < triangles.size(); done += kBlockTriangles) {
    TriangleBlock& block = blocks_.emplace_back();
    block.reach = 0;
    block.left = static_cast<std::uint32_t>(triangles.size() - done);
    for (std::uint32_t i = 0; i < kBlockTriangles; ++i) {
      SetTriangle(mesh, triangles[i < block.left ? done + i : done], i, &block);
    }
  }
  return first | BallLink::kLeaf;
}

void PackedTree::SetTriangle(const TriangleMesh& mesh, std::uint32_t triangle, std::uint32_t lane,
                             TriangleBlock* block) {
  Eigen::Vector3d corners[3] = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(),
                                Eigen::Vector3d::Zero()};
  const bool is_solid = triangle >= mesh.triangles.size();
  for (std::size_t k = 0; k < 3 && !is_solid; ++k) {
    const Eigen::Vector3d& vertex = mesh.vertices[mesh.triangles[triangle][k]];
    block->reach = std::max(block->reach, FloatUp(vertex.norm() * (1 + 0x1p-50)));
    corners[k] = vertex - origin_;
    extent_ = std::max(extent_, corners[k].norm() * (1 + 0x1p-50));
  }
  const Eigen::Vector3d across = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  const double length = across.norm();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  if (length > 0 && length < std::numeric_limits<double>::max()) normal = across / length;
  // As they are stored, so that `above` and `below` speak of them.
  const Eigen::Vector3f stored = normal.cast<float>();
  float above = -kNowhere, below = kNowhere;
  for (std::uint32_t k = 0; k < 4; ++k) {
    const Eigen::Vector3f place = k < 3 ? corners[k].cast<float>() : stored;
    const std::uint32_t at = kBlockTriangles * k + lane;
    block->x[at] = place.x(), block->y[at] = place.y(), block->z[at] = place.z();
    if (k == 3) continue;
    const auto height = static_cast<float>(stored.cast<double>().dot(place.cast<double>()));
    above = std::max(above, height), below = std::min(below, height);
  }
  block->above[lane] = above, block->below[lane] = below;
  block->triangle[lane] = triangle;
}

void PackedTree::FindExtremes(const TriangleMesh& mesh) {
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
    for (const Triangle& triangle : mesh.triangles) {
      for (const std::uint32_t vertex : triangle) {
        const double along = direction.dot(mesh.vertices[vertex] - origin_);
        if (along > farthest) farthest = along, extremes_[which] = mesh.vertices[vertex];
      }
    }
  }
}

std::size_t PackedTree::bytes() const {
  return packs_.capacity() * sizeof(BallPack) + nodes_.capacity() * sizeof(PackNodes) +
         blocks_.capacity() * sizeof(TriangleBlock);
}

BallPack PackOfBall(double radius) {
  BallPack pack = EmptyPack();
  pack.x[0] = pack.y[0] = pack.z[0] = 0;
  pack.radius[0] = FloatUp(radius);
  pack.signed_distance[0] = FloatUp(-radius);
  return pack;
}

}  // namespace collision
