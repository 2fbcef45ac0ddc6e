// How long the hulls of a few moving points stay apart along a direction.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "collision_core/narrow_phase/advancement/swept_pose.h"
#include "collision_core/numeric/first_root.h"

namespace collision::narrow_phase {

/// The hull of some points, each of which moves along its tangent: one for a ball's centre, three
/// for a triangle.
template <std::size_t kPoints>
struct MovingPoints {
  std::array<Eigen::Vector3d, kPoints> points, velocities;  ///< At the start.

  std::array<Eigen::Vector3d, kPoints> At(double h) const {
    std::array<Eigen::Vector3d, kPoints> at;
    for (std::size_t i = 0; i < kPoints; ++i) at[i] = points[i] + h * velocities[i];
    return at;
  }
};

/// Moving points along a direction n at h: where they are, and how fast they move along it.
template <std::size_t kPoints>
struct ProjectedPoints {
  std::array<double, kPoints> at, speed;
  double low = numeric::kInfinity, high = -numeric::kInfinity;
  double slowest = numeric::kInfinity, fastest = -numeric::kInfinity;

  ProjectedPoints(const MovingPoints<kPoints>& moving, const Eigen::Vector3d& n, double h) {
    for (std::size_t i = 0; i < kPoints; ++i) {
      speed[i] = n.dot(moving.velocities[i]);
      at[i] = n.dot(moving.points[i]) + h * speed[i];
      low = std::min(low, at[i]);
      high = std::max(high, at[i]);
      slowest = std::min(slowest, speed[i]);
      fastest = std::max(fastest, speed[i]);
    }
  }
};

/// Two hulls, and how much of the gap between them may be used up t seconds after the start.
template <std::size_t kA, std::size_t kB>
struct SweptPoints {
  MovingPoints<kA> a;
  MovingPoints<kB> b;
  SweptPose::Growth used;  ///< c2 >= 0.
};

/// Beyond these the square of a length [m²] may have lost digits by underflow or overflow.
inline constexpr double kSquaredLengthMin = 0x1p-900, kSquaredLengthMax = 0x1p+900;

/// For how many seconds from `h` on the projections of the hulls on `direction` (from A to B, of
/// any length but zero) certainly stay apart: 0 where they show no gap at h, +infinity where the
/// gap is never used up. A result beyond `duration` may be less than it could be.
///
/// The gap of the projections lasts at least as long as between the foremost points if these moved
/// as fast as any; and as long as between every two points, since the projections do not meet
/// before any two of them do. The result is the larger of the two.
template <std::size_t kA, std::size_t kB>
double ApartAlong(const Eigen::Vector3d& direction, const SweptPoints<kA, kB>& hulls, double h,
                  double duration) {
  const double square = direction.squaredNorm();
  if (!(square > kSquaredLengthMin && square < kSquaredLengthMax)) return 0;
  const Eigen::Vector3d n = direction / std::sqrt(square);
  const ProjectedPoints<kA> of_a(hulls.a, n, h);
  const ProjectedPoints<kB> of_b(hulls.b, n, h);
  const SweptPose::Growth& reach = hulls.used;
  const double used = reach.c0 + h * (reach.c1 + h * reach.c2);
  const double growth = reach.c1 + 2 * h * reach.c2;
  const double whole = numeric::FirstRoot(of_b.low - of_a.high - used,
                                          of_a.fastest - of_b.slowest + growth, reach.c2);
  if (!(whole > 0) || h + whole > duration) return whole;
  double least = numeric::kInfinity;
  for (std::size_t i = 0; i < kA; ++i) {
    for (std::size_t j = 0; j < kB; ++j) {
      const double closing = of_a.speed[i] - of_b.speed[j] + growth;
      least =
          std::min(least, numeric::FirstRoot(of_b.at[j] - of_a.at[i] - used, closing, reach.c2));
    }
  }
  return std::max(whole, least);
}

}  // namespace collision::narrow_phase
