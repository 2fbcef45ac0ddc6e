// A convex set in some frame, given by its support function.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "collision_core/geometry/convex/convex_points.h"
#include "collision_core/numeric/allowances.h"
#include "collision_core/numeric/rounding.h"

namespace collision::geometry {

/// The kinds of cores. A core and all points within a radius of it (its rounding) are a convex set.
enum class ConvexCore : std::uint8_t {
  kPoint,     ///< Rounded: a ball.
  kSegment,   ///< Rounded: a capsule.
  kTriangle,  ///< A triangle of a mesh.
  kBox,
  kEllipsoid,
  kCylinder,
  kCone,
  kHull  ///< The convex hull of points.
};

/// All points within `rounding` of a core. Lengths in metres. With generators g_0, g_1, g_2
/// (columns) the core, seen from `centre`, is exactly:
///   kPoint      0
///   kSegment    s g_0, |s| <= 1
///   kTriangle   the hull of g_0, g_1, g_2
///   kBox        s g_0 + t g_1 + u g_2, each factor in [−1, 1] (columns need not be orthogonal)
///   kEllipsoid  the same with s² + t² + u² <= 1
///   kCylinder   the same with s² + t² <= 1 and |u| <= 1
///   kCone       the hull of g_2, its apex, and of s g_0 + t g_1 − g_2 with s² + t² <= 1, its base
///   kHull       the hull of G x for all points x
/// The true set differs from this one by at most `error`: each point of either lies within `error`
/// of a point of the other.
struct ConvexSet {
  ConvexCore core = ConvexCore::kPoint;
  Eigen::Matrix3d generators = Eigen::Matrix3d::Zero();
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double rounding = 0;
  double error = 0;
  /// The sum of the generators' lengths (kTriangle: the greatest; kHull: twice the points' reach),
  /// rounded up: no point of the core is further from the centre.
  double span = 0;
  const ConvexPoints* points = nullptr;  ///< The points of a hull; must outlive the set.

  /// The coordinates z of the core's point furthest along n: PointAt(z) is that point, seen from
  /// `centre`. They give a point of the core whatever the generators, so they may be reused at
  /// another pose.
  Eigen::Vector3d Support(const Eigen::Vector3d& n) const;
  Eigen::Vector3d PointAt(const Eigen::Vector3d& z) const;
  Eigen::Vector3d SupportPoint(const Eigen::Vector3d& n) const { return PointAt(Support(n)); }

  /// The coordinates of the point that has the part of the one at `z` in the direction n: of the
  /// same end of a cylinder, the apex of a cone for the apex. Of other cores Support(n).
  Eigen::Vector3d SupportBeside(const Eigen::Vector3d& z, const Eigen::Vector3d& n) const;

  /// Whether the surface is curved.
  bool IsSmooth() const { return core == ConvexCore::kEllipsoid || IsTurned(); }
  /// Whether the core is made of circles about the third generator.
  bool IsTurned() const { return core == ConvexCore::kCylinder || core == ConvexCore::kCone; }

  /// Whether the core is a point or a segment.
  bool IsThin() const { return core == ConvexCore::kPoint || core == ConvexCore::kSegment; }

 private:
  /// The coordinates of the point of a disc at this end (−1 or 1) that is furthest along n.
  Eigen::Vector3d OnRim(const Eigen::Vector3d& n, double end) const;
};

/// The triangle with these corners: exact, but for the rounding of differences.
ConvexSet TriangleSet(const std::array<Eigen::Vector3d, 3>& corners);

/// The ball about a point.
ConvexSet BallSet(const Eigen::Vector3d& centre, double radius);

/// With u = 2^-53 and |n| within 2^-20 of 1, derived in convex_set.cc:
/// · the greatest n·x of a core is less than n·(computed support point) + kSupportError span;
/// · a computed support point is within kSupportError span of a point of the core.
/// Where all products underflow, kSupportUnderflow is added.
inline constexpr double kSupportError = 18 * numeric::kUnitRoundoff;
inline constexpr double kSupportUnderflow = 0x1p-500;
/// [m] Far below what kSupportError leaves of the smallest solid (a micrometre).
inline constexpr double kRimMin = 0x1p-200;

/// At least |v|: a root of a sum of three squares is off by 2.5 · 2^-53 of itself, but for
/// underflow.
inline double LengthUp(const Eigen::Vector3d& v) {
  return numeric::kFewRoundingsUp * std::sqrt(v.squaredNorm()) + kSupportUnderflow;
}

inline Eigen::Vector3d ConvexSet::PointAt(const Eigen::Vector3d& z) const {
  return z.x() * generators.col(0) + z.y() * generators.col(1) + z.z() * generators.col(2);
}

inline Eigen::Vector3d ConvexSet::OnRim(const Eigen::Vector3d& n, double end) const {
  const double s = n.dot(generators.col(0)), t = n.dot(generators.col(1));
  const double rim = std::sqrt(s * s + t * t);
  // Where the square may have lost digits the whole disc is as far along n, to within kRimMin.
  if (!(rim > kRimMin)) return {0, 0, end};
  return {s / rim, t / rim, end};
}

inline Eigen::Vector3d ConvexSet::Support(const Eigen::Vector3d& n) const {
  const auto along = [&](int i) { return n.dot(generators.col(i)); };
  switch (core) {
    case ConvexCore::kPoint:
      break;
    case ConvexCore::kSegment:
      return {std::copysign(1, along(0)), 0, 0};
    case ConvexCore::kTriangle: {
      const double t0 = along(0), t1 = along(1), t2 = along(2);
      const bool first = t0 >= t1 && t0 >= t2, second = !first && t1 >= t2;
      return {first ? 1.0 : 0.0, second ? 1.0 : 0.0, first || second ? 0.0 : 1.0};
    }
    case ConvexCore::kBox:
      return {std::copysign(1, along(0)), std::copysign(1, along(1)), std::copysign(1, along(2))};
    case ConvexCore::kEllipsoid: {
      const Eigen::Vector3d m(along(0), along(1), along(2));
      const double square = m.squaredNorm();
      if (!(square > 0)) break;
      const double scale = 1 / std::sqrt(square);
      return {m.x() * scale, m.y() * scale, m.z() * scale};
    }
    case ConvexCore::kCylinder:
      return OnRim(n, std::copysign(1, along(2)));
    case ConvexCore::kCone: {
      const double s = along(0), t = along(1), u = along(2);
      if (u >= std::sqrt(s * s + t * t) - u) return {0, 0, 1};
      return OnRim(n, -1);
    }
    case ConvexCore::kHull:
      return (*points)[points->Furthest({along(0), along(1), along(2)})];
  }
  return {0, 0, 0};
}

inline Eigen::Vector3d ConvexSet::SupportBeside(const Eigen::Vector3d& z,
                                                const Eigen::Vector3d& n) const {
  if (!IsTurned()) return Support(n);
  const bool apex = core == ConvexCore::kCone && z.z() > 0;
  return apex ? z : OnRim(n, z.z());
}

}  // namespace collision::geometry
