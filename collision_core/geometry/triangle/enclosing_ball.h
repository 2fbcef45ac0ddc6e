// A small ball around points.
#pragma once

#include <Eigen/Core>
#include <span>

namespace collision::geometry {

/// A ball that contains points.
struct EnclosingBall {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double radius = 0;  ///< Rounded up: every point is certainly inside.
};

/// A ball around the points, typically within 3 % of the smallest one. Requires at least one point
/// and coordinates of magnitude below 1e100.
EnclosingBall SmallBallAround(std::span<const Eigen::Vector3d> points);

}  // namespace collision::geometry
