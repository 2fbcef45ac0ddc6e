#include "collision_core/intersection/quick_horn_pair.h"

#include <cmath>

#include "collision_core/numeric/rounding.h"

namespace collision::intersection {
namespace {

/// ε: the most that one rounding costs, relative.
constexpr double kEpsilon = 0x1p-53;

/// The seconds from `from` to `to`, off by 2ε relative: from integer to double, and the quotient.
double Seconds(Instant from, Instant to) {
  std::int64_t nanoseconds;
  if (__builtin_sub_overflow(to.nanoseconds(), from.nanoseconds(), &nanoseconds))
    return numeric::kInfinity;
  return static_cast<double>(nanoseconds) / 1e9;
}

/// One agent's part, from `base` on.
struct Part {
  double shift[3];    // v τ, each off by 3ε.
  double u0, u1, u2;  // All terms are positive. σ is off by 3ε, σ + h by 4ε, a product of both by
                      // 9ε, |v| κ by 4ε, and the sums make it 13ε.

  Part(const motion::SpaceTimeBound& bound, Instant base) {
    const Eigen::Vector3d& v = bound.state.v_WA;
    const double tau = Seconds(bound.state.stamp, base), sigma = tau + bound.skew;
    const double step = bound.limits.time_step, error = bound.state.velocity_error;
    for (int i = 0; i < 3; ++i) shift[i] = v[i] * tau;
    u2 = 0.5 * bound.limits.acceleration_max;
    u1 = error + u2 * (2 * sigma + step);
    u0 = bound.state.position_error + error * sigma + u2 * (sigma * (sigma + step));
    if (bound.skew > 0) {
      u0 += bound.skew * std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    }
  }
};

/// Of the reach's terms, the 13ε of each part and the sums of five.
constexpr double kErrorOfReach = 20 * kEpsilon;

/// Of d, relative to the sum of the magnitudes of its terms p_B − p_A, v_B τ_B and v_A τ_A: each is
/// off by 3ε at most, and two more sums make it 5ε.
constexpr double kErrorOfDistance = 6 * kEpsilon;

/// Of w = v_B − v_A: ε, and what summing the magnitudes costs.
constexpr double kErrorOfVelocity = 2 * kEpsilon;

}  // namespace

numeric::QuickApproach QuickHornPair(const motion::SpaceTimeBound& a,
                                     const motion::SpaceTimeBound& b, Instant base, double margin) {
  const Part part_A(a, base), part_B(b, base);
  numeric::QuickApproach q;
  double magnitude = 0, speed = 0;
  for (int i = 0; i < 3; ++i) {
    // Positions first: a scene far from the origin loses only what its inputs lost.
    const double between = b.state.p_WA[i] - a.state.p_WA[i];
    q.d[i] = between + (part_B.shift[i] - part_A.shift[i]);
    q.w[i] = b.state.v_WA[i] - a.state.v_WA[i];
    magnitude += std::abs(between) + (std::abs(part_B.shift[i]) + std::abs(part_A.shift[i]));
    speed += std::abs(q.w[i]);
  }
  const double radii = (a.limits.radius + b.limits.radius) + margin;
  const double s0 = radii + (part_A.u0 + part_B.u0);
  const double s1 = part_A.u1 + part_B.u1;
  q.doubt0 = kErrorOfDistance * magnitude + kErrorOfReach * s0;
  q.doubt1 = kErrorOfVelocity * speed + kErrorOfReach * s1;
  q.s0 = s0 + q.doubt0;
  q.s1 = s1 + q.doubt1;
  q.s2 = (part_A.u2 + part_B.u2) * (1 + kErrorOfReach);
  return q;
}

}  // namespace collision::intersection
