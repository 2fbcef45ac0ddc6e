// Certified signed distances of many centres.
#pragma once

#include <optional>

#include "collision_core/sphere_tree/fitted/fitted_boxes.h"
#include "collision_core/sphere_tree/tree_options.h"

namespace collision::sphere_tree {

/// A centre, and what is certified about it.
struct CentreFacts {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double signed_distance = 0;  ///< An upper bound.
  /// Certain: the winding number is not zero, no triangle is nearer than -signed_distance.
  bool inside = false;
};

/// Certified queries of one surface, through its boxes.
class FittedDistance {
 public:
  FittedDistance(const TriangleBoxTree& boxes, SurfaceKind kind) : boxes_(boxes), kind_(kind) {}

  /// The signed distance, rounded up by `slack` at most where that makes it easier, beside
  /// rounding. `near`: facts of a centre near by, which may save the winding number; `triangle`:
  /// one near by.
  CentreFacts Certify(const Eigen::Vector3d& centre, double slack, const CentreFacts& near,
                      std::uint32_t triangle) const;

 private:
  double LowerBound(const Eigen::Vector3d& centre, double from) const;
  std::optional<int> WindingNumberAt(const Eigen::Vector3d& point) const;

  const TriangleBoxTree& boxes_;
  const SurfaceKind kind_;
};

}  // namespace collision::sphere_tree
