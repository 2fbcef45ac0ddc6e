#include "collision_core/sphere_tree/median_split/median_split_builder.h"

#include <algorithm>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>

#include "collision_core/base/check.h"
#include "collision_core/geometry/triangle/enclosing_ball.h"

namespace collision::sphere_tree {
namespace {

using Eigen::Vector3d;
using Triangles = std::span<std::uint32_t>;

/// The largest number of children of a node.
constexpr int kHalvings = 3;

class Builder {
 public:
  Builder(const geometry::TriangleMesh& mesh, const ShapeOptions& options)
      : mesh_(mesh),
        options_(options),
        leaf_(std::max<std::size_t>(options.triangles_per_leaf, 1)),
        order_(mesh.triangles.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    middles_.reserve(order_.size());
    for (const geometry::Triangle& t : mesh.triangles) {
      const Vector3d &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
      middles_.push_back(a.cwiseMin(b).cwiseMin(c) + a.cwiseMax(b).cwiseMax(c));
    }
  }

  SphereTree Build() {
    AddNode(0, order_);
    for (std::size_t node = 0; node < tree_.nodes.size(); ++node) Divide(node);
    tree_.levels = tree_.nodes.back().level + 1;
    tree_.nodes.shrink_to_fit();
    return std::move(tree_);
  }

 private:
  void AddNode(std::uint32_t level, Triangles part) {
    corners_.clear();
    for (const std::uint32_t triangle : part) {
      for (const std::uint32_t corner : mesh_.triangles[triangle]) {
        corners_.push_back(mesh_.vertices[corner]);
      }
    }
    const geometry::EnclosingBall ball = geometry::SmallBallAround(corners_);
    SphereNode node;
    node.centre = ball.centre;
    node.radius = node.signed_distance = ball.radius;
    node.level = level;
    tree_.nodes.push_back(node);
    parts_.push_back(part);
  }

  void Divide(std::size_t index) {
    const Triangles part = parts_[index];
    const std::uint32_t level = tree_.nodes[index].level;
    const bool may_be_divided = part.size() > leaf_ && level < options_.levels_max &&
                                tree_.nodes.size() + (1 << kHalvings) <= options_.nodes_max;
    if (!may_be_divided) return MakeLeaf(part, &tree_.nodes[index]);
    const auto first = static_cast<std::uint32_t>(tree_.nodes.size());
    AddHalves(level + 1, part, kHalvings);
    tree_.nodes[index].first_child = first;
    tree_.nodes[index].children = static_cast<std::uint32_t>(tree_.nodes.size()) - first;
  }

  void AddHalves(std::uint32_t level, Triangles part, int halvings) {
    if (halvings == 0 || part.size() <= leaf_) return AddNode(level, part);
    // Whole leaves on the lower side: fewer of them, and full.
    const std::size_t half = (part.size() / 2 + leaf_ - 1) / leaf_ * leaf_;
    Halve(part, half);
    AddHalves(level, part.first(half), halvings - 1);
    AddHalves(level, part.subspan(half), halvings - 1);
  }

  /// The `half` lowest along the longest axis to the front. Ties are decided by the triangles'
  /// numbers, so that the result does not depend on the standard library.
  void Halve(Triangles part, std::size_t half) const {
    Vector3d lower = middles_[part[0]], upper = lower;
    for (const std::uint32_t i : part) {
      lower = lower.cwiseMin(middles_[i]);
      upper = upper.cwiseMax(middles_[i]);
    }
    int axis = 0;
    (upper - lower).maxCoeff(&axis);
    std::nth_element(part.begin(), part.begin() + static_cast<std::ptrdiff_t>(half), part.end(),
                     [&](std::uint32_t a, std::uint32_t b) {
                       return std::tuple(middles_[a][axis], a) < std::tuple(middles_[b][axis], b);
                     });
  }

  void MakeLeaf(Triangles part, SphereNode* node) {
    std::sort(part.begin(), part.end());
    node->first_element = static_cast<std::uint32_t>(tree_.elements.size());
    node->elements = static_cast<std::uint32_t>(part.size());
    for (const std::uint32_t triangle : part) tree_.elements.emplace_back(triangle);
  }

  const geometry::TriangleMesh& mesh_;
  const ShapeOptions& options_;
  const std::size_t leaf_;            ///< Triangles of a node that is not divided.
  std::vector<std::uint32_t> order_;  ///< Triangles; each node's stand one after the other.
  std::vector<Vector3d> middles_;     ///< Of each triangle's box, doubled.
  std::vector<Triangles> parts_;      ///< Of each node.
  std::vector<Vector3d> corners_;
  SphereTree tree_;
};

}  // namespace

SphereTree BuildMedianSplit(const geometry::TriangleMesh& mesh, const ShapeOptions& options) {
  CORE_CHECK(geometry::IsWellFormed(mesh), "a tree is built of a well-formed mesh",
             mesh.triangles.size());
  return Builder(mesh, options).Build();
}

}  // namespace collision::sphere_tree
