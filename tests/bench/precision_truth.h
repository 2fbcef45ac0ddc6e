// The exact distance of two posed bodies, to judge all others by.
#pragma once

#include <vector>

#include "collision_core/geometry/mesh/triangle_mesh.h"
#include "tests/bench/narrow_convex.h"

namespace collision::bench {

/// Two bodies of one mesh. What is posed is every vertex by the pose's own numbers, exactly: as
/// doubles they are no rotation, and nobody can ask for more.
class MeshTruth {
 public:
  explicit MeshTruth(geometry::TriangleMesh mesh) : mesh_(std::move(mesh)) {}

  /// [m], rounded to the nearest double; 0: the surfaces have a point in common. By rational
  /// arithmetic (support/exact_triangle.h) over all pairs of triangles that may be as near as
  /// `upper`. Requires that `upper` is not less than the distance by more than 1e-13.
  double DistanceAt(const PlainPose& pose, double upper) const;

 private:
  geometry::TriangleMesh mesh_;
};

/// Capsules, boxes and hulls: the hulls of their cores' corners, by rational arithmetic
/// (support/exact_convex.h), less the roundings [m]; 0: they have a point in common.
double ConvexTruthAt(const PlainConvex& a, const PlainConvex& b, const PlainPose& pose);

}  // namespace collision::bench
