// How often a closed surface winds about a point.
#include <algorithm>

#include "collision_core/geometry/triangle/ray_passage.h"
#include "collision_core/numeric/allowances.h"
#include "collision_core/numeric/rounding.h"
#include "collision_core/sphere_tree/surface_query.h"
#include "collision_core/sphere_tree/underflow.h"

namespace collision::sphere_tree {
namespace {

using Eigen::Vector3d;

/// Whether a ray from the point along +x (kForward) or −x (kBackward) may meet the ball. The
/// computed square is off by a relative 5 u, u = 2^−53, r² by u; kSquareUnderflow covers what
/// underflows. The sum along x is rounded monotonically, to the right side.
bool RayMayMeet(const SphereNode& node, const Vector3d& point, geometry::Passing side) {
  const double dy = point.y() - node.centre.y(), dz = point.z() - node.centre.z();
  const double r = node.radius;
  if (dy * dy + dz * dz > r * r * numeric::kSomeRoundingsUp + kSquareUnderflow) return false;
  return side == geometry::Passing::kForward ? node.centre.x() + r >= point.x()
                                             : node.centre.x() - r <= point.x();
}

}  // namespace

std::optional<int> SurfaceQuery::WindingNumberAt(const Vector3d& point) {
  const SphereNode& root = tree_.root();
  // Towards the nearer end of the surface: fewer triangles there.
  const bool forward = point.x() >= root.centre.x();
  const geometry::Passing asked =
      forward ? geometry::Passing::kForward : geometry::Passing::kBackward;
  passed_.clear();
  stack_.assign(1, SphereTree::kRoot);
  while (!stack_.empty()) {
    const SphereNode& node = tree_.node(stack_.back());
    stack_.pop_back();
    ++work_;
    if (!RayMayMeet(node, point, asked)) continue;
    for (std::uint32_t i = 0; i < node.children; ++i) stack_.push_back(node.child(i));
    work_ += node.elements;
    for (const ElementIndex index : tree_.ElementsOf(node)) {
      const geometry::Triangle& t = mesh_.triangles[index.value()];
      const geometry::RayPassage pass = geometry::PassageOf(
          {mesh_.vertices[t[0]], mesh_.vertices[t[1]], mesh_.vertices[t[2]]}, point);
      if (pass.passing == geometry::Passing::kUnknown) return std::nullopt;
      if (pass.passing == asked) passed_.emplace_back(index, forward ? pass.sign : -pass.sign);
    }
  }
  // A triangle may stand in several leaves.
  std::sort(passed_.begin(), passed_.end());
  passed_.erase(std::unique(passed_.begin(), passed_.end()), passed_.end());
  int winding = 0;
  for (const auto& [triangle, sign] : passed_) winding += sign;
  return winding;
}

}  // namespace collision::sphere_tree
