// One ball around points of a surface that reaches beyond the surface as little as it can.
#pragma once

#include <span>

#include "collision_core/base/ids.h"
#include "collision_core/sphere_tree/fitted/fitted_boxes.h"
#include "collision_core/sphere_tree/tree_options.h"

namespace collision::sphere_tree {

/// A ball in the search, in plain doubles without an error bound. Lengths in metres.
struct FittedBall {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  /// The point of the surface nearest to the centre.
  Eigen::Vector3d nearest = Eigen::Vector3d::Zero();
  double signed_distance = 0;  ///< That of the centre; negative only where `inside`.
  double radius = 0;
  bool inside = false;
  ElementIndex triangle;  ///< The triangle of `nearest`.

  double overshoot() const { return radius + signed_distance; }
};

/// The distance of the farthest point from a centre, and which it is.
struct FarPoint {
  double distance = 0;
  std::uint32_t index = 0;
};
FarPoint FarthestFrom(const Eigen::Vector3d& centre, std::span<const Eigen::Vector3d> points);

/// Moves the centres of balls so that they overshoot less. Not thread-safe: it keeps its buffers.
class BallPolish {
 public:
  explicit BallPolish(const TriangleBoxTree& boxes) : boxes_(boxes) {}

  /// Moves the centre as long as that reduces the overshoot of a ball about all points. Starts no
  /// further round of up to three trials after `queries` queries for the nearest surface. Sets the
  /// radius.
  void Run(std::span<const Eigen::Vector3d> points, int queries, FittedBall* ball);

 private:
  bool Try(std::span<const Eigen::Vector3d> points, const Eigen::Vector3d& centre, double step,
           FittedBall* ball);

  const TriangleBoxTree& boxes_;
  std::vector<Eigen::Vector3d> near_;  ///< Points of the surface that were nearest once.
  std::vector<Eigen::Vector3d> far_;   ///< Points that were farthest once.
  Eigen::Vector3d farthest_ = Eigen::Vector3d::Zero();
  int queries_ = 0;
};

/// A point of a triangle.
struct SurfacePoint {
  Eigen::Vector3d point;   ///< [m]
  Eigen::Vector3d normal;  ///< The triangle's, of length 1; not read of an open surface.
  ElementIndex triangle;
};

/// Appends balls that touch the surface at a point from inside (or lie on it), as starts of a
/// search: the point itself, and for a closed surface the largest ball that contains no surface and
/// one half-way to the opposite side.
void AppendCandidates(const TriangleBoxTree& boxes, const SurfacePoint& at, SurfaceKind kind,
                      std::vector<FittedBall>* candidates);

}  // namespace collision::sphere_tree
