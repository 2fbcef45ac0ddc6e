// The Earth's gravity, with the flattening J2, and how fast it changes.
//
// The field is ∇(μ/r) + ∇Φ with Φ = −c P2(z/r) / r³ = −½ c ∂z²(1/r), c = J2 μ R². Along a unit
// vector u, ∂u^k (1/r) = (−1)^k k! P_k / r^(k+1), at most k! / r^(k+1). A symmetric multilinear
// form is greatest where all its arguments are equal (Banach), so no derivative of the order k of
// 1/r, in any directions, exceeds that. Hence of the field and its first two derivatives
//
//   |g|         <= μ / r²   + 3 c / r⁴,
//   |∇g u|      <= 2 μ / r³ + 12 c / r⁵,
//   |∇²g u u|   <= 6 μ / r⁴ + 60 c / r⁶.
//
// For a velocity that is nearly horizontal the terms of μ are smaller: with v_r its vertical part,
//
//   ∇g v    = −μ/r³ (v − 3 v_r r̂),                 of length μ/r³ √(v² + 3 v_r²),
//   ∇²g v v = 3 μ/r⁴ ((v² − 5 v_r²) r̂ + 2 v_r v),  at most 3 μ/r⁴ (v² + 2 v |v_r| + 5 v_r²).
#pragma once

#include "collision/types.h"

namespace collision::client {

inline constexpr double kEarthMu = 3.986004418e14;  ///< [m³/s²], WGS 84.
inline constexpr double kEarthRadius = 6378137;     ///< Equatorial [m], WGS 84.
inline constexpr double kEarthJ2 = 1.08262668e-3;   ///< Second zonal harmonic, EGM96.

/// The acceleration [m/s²] of a satellite at `position_m` from the Earth's centre, the z axis
/// through its pole: two bodies and J2.
Vector3 Gravity(const Vector3& position_m);

/// A part of a path: where it is least far from the Earth's centre, and how fast it is at most.
struct PathExtent {
  double radius_min_m = 0;
  double speed_max_m_s = 0;
  double climb_max_m_s = 0;          ///< |v_r|: speed along the radius.
  double acceleration_max_m_s2 = 0;  ///< Of the path, which need not be gravity's alone.
};

/// A bound on |d/dt g(x(t))| along such a path [m/s³].
double GravityRateMax(const PathExtent& path);

/// A bound on |d²/dt² g(x(t))| along such a path [m/s⁴].
double GravityRateRateMax(const PathExtent& path);

}  // namespace collision::client
