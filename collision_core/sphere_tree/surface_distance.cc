// How far a point is from a surface.
#include <algorithm>

#include "collision_core/geometry/triangle/point_triangle.h"
#include "collision_core/sphere_tree/surface_query.h"
#include "collision_core/sphere_tree/underflow.h"

namespace collision::sphere_tree {
namespace {

using Eigen::Vector3d;

/// Points farther than this [m] in a coordinate are measured against the root's ball alone: squares
/// would overflow, and its radius is less than the rounding.
constexpr double kFar = 1e100;

/// Relative to |d| and the radius: a computed |d| is off by a relative 3.5 u, u = 2^−53, but for
/// kDistanceUnderflow; subtracting rounds by another u of the difference. 8 u.
constexpr double kBoundRounding = 0x1p-50;

/// No point of the node's part is nearer.
double LowerBound(const SphereNode& node, const Vector3d& point) {
  const double d = (point - node.centre).norm();
  return (d - node.radius) - kBoundRounding * (d + node.radius) - kDistanceUnderflow;
}

}  // namespace

void SurfaceQuery::TryLeaf(const SphereNode& leaf, const Vector3d& point, numeric::Interval* best) {
  work_ += leaf.elements;
  for (const ElementIndex index : tree_.ElementsOf(leaf)) {
    ElementIndex& place = measured_[index.value() % kCacheSize];
    if (place == index) continue;
    const geometry::Triangle& t = mesh_.triangles[index.value()];
    const geometry::TrianglePoints corners = {mesh_.vertices[t[0]], mesh_.vertices[t[1]],
                                              mesh_.vertices[t[2]]};
    if (geometry::IsCertainlyFarther(point, corners, best->upper)) continue;
    place = index;
    *best = numeric::Min(*best, geometry::DistanceToTriangle(point, corners).distance);
  }
}

// Whatever is left out is certainly farther than an upper bound that was known then, and so than
// the distance: the nearest triangle is always measured.
numeric::Interval SurfaceQuery::DistanceTo(const Vector3d& point, double known_upper) {
  if (!(point.cwiseAbs().maxCoeff() < kFar)) {
    const numeric::Interval d = numeric::Norm(numeric::IntervalVector(point) -
                                              numeric::IntervalVector(tree_.root().centre));
    return numeric::Max(d + numeric::Interval(-tree_.root().radius, tree_.root().radius), 0);
  }
  numeric::Interval best(numeric::kInfinity, known_upper);
  heap_.clear();
  measured_.fill(ElementIndex::None());
  heap_.push_back({LowerBound(tree_.root(), point), SphereTree::kRoot});
  while (!heap_.empty() && heap_.front().lower <= best.upper) {
    const SphereNode& node = tree_.node(heap_.front().node);
    std::pop_heap(heap_.begin(), heap_.end());
    heap_.pop_back();
    work_ += 1 + node.children;
    if (node.is_leaf()) TryLeaf(node, point, &best);
    for (std::uint32_t i = 0; i < node.children; ++i) {
      const NodeIndex child = node.child(i);
      const double lower = LowerBound(tree_.node(child), point);
      if (lower > best.upper) continue;
      heap_.push_back({lower, child});
      std::push_heap(heap_.begin(), heap_.end());
    }
  }
  return {std::min(best.lower, best.upper), best.upper};
}

}  // namespace collision::sphere_tree
