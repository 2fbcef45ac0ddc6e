// Certified signed distances of many centres.
#pragma once

#include <optional>

#include "collision_core/base/ids.h"
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

  /// Certifies an upper bound of the signed distance, which exceeds it by at most `slack`, apart
  /// from rounding. `near`: facts of a nearby centre; if `centre` lies in its empty ball, no
  /// winding number is needed. `triangle`: a triangle that may be near.
  CentreFacts Certify(const Eigen::Vector3d& centre, double slack, const CentreFacts& near,
                      ElementIndex triangle) const;

 private:
  double LowerBound(const Eigen::Vector3d& centre, double from) const;
  std::optional<int> WindingNumberAt(const Eigen::Vector3d& point) const;

  const TriangleBoxTree& boxes_;
  const SurfaceKind kind_;
};

}  // namespace collision::sphere_tree
