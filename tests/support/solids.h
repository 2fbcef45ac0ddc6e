// Boxes as convex solids.
#pragma once

#include "collision_core/shape/convex_solid.h"

namespace collision {

inline shape::ConvexSolid SolidBox(const Eigen::Vector3d& lower, const Eigen::Vector3d& upper) {
  shape::ConvexDescription box;
  box.core = geometry::ConvexCore::kBox;
  box.half = (upper - lower) / 2;
  box.p_BS = (upper + lower) / 2;
  return shape::ConvexSolid::Build(box);
}

/// The same, of its corners.
inline shape::ConvexSolid HullBox(const Eigen::Vector3d& lower, const Eigen::Vector3d& upper) {
  shape::ConvexDescription hull;
  hull.core = geometry::ConvexCore::kHull;
  for (int i = 0; i < 8; ++i) {
    hull.points.emplace_back((i & 1 ? upper : lower).x(), (i & 2 ? upper : lower).y(),
                             (i & 4 ? upper : lower).z());
  }
  return shape::ConvexSolid::Build(hull);
}

}  // namespace collision
