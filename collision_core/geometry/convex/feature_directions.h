// Directions that the features of two convex cores determine exactly.
#pragma once

#include "collision_core/geometry/convex/gjk.h"

namespace collision::geometry {

/// The directions that the edges of segments, triangles and boxes determine: normals of faces,
/// cross products of two edges, and for each edge the part of `about` perpendicular to it. Each is
/// negated where needed, so that its product with `about` is not negative. Other cores contribute
/// no edges.
class FeatureDirections {
 public:
  FeatureDirections(const ConvexPair& pair, const Eigen::Vector3d& about);

  const Eigen::Vector3d* begin() const { return directions_.data(); }
  const Eigen::Vector3d* end() const { return directions_.data() + count_; }

 private:
  static constexpr int kMost = 3 + 3 + 9 + 6;
  void Take(const Eigen::Vector3d& direction, const Eigen::Vector3d& about);

  std::array<Eigen::Vector3d, kMost> directions_;
  int count_ = 0;
};

}  // namespace collision::geometry
