// The motion of a satellite through a run, as it is played, and what it can promise about it.
//
// The nodes of the motion are steps of a Runge-Kutta integrator; the motion itself is the cubic
// Hermite curve H through them, which a checker can know exactly. A state at s tells g(H(s)), the
// gravity where it is. For all s and t, in either order,
//
//   |H''(t) − g(H(s))| <= |H''(t) − g(H(t))| + |g(H(t)) − g(H(s))| <= D + J |t − s|,
//
// where J bounds |d/dt g(H(t))| along the curve (gravity.h), and D the defect d = H'' − g(H): what
// is left of the errors of interpolation, integration and rounding. It is computed at nine points
// of each piece. Between two of them, h apart, H'' is linear, so that d differs from the chord by
// at most h²/8 times a bound S on |d²/dt² g(H(t))|: D = max |d| + S h²/8.
//
// How far a piece strays from the chord between its ends: H by A h²/8 with A the greatest |H''|,
// and H' by |H'''| h²/8. The chord from p to p' is no nearer to the centre than √(ρ² − |p' −
// p|²/4), ρ the smaller radius of the two. And (x·v)' = v² + x·H'', so that x·v changes by no more
// than (v² + r A) h/2 from the nearer end. That bounds radius, speed and vertical speed on each
// piece.
#pragma once

#include <cstdint>

#include "client/programs/simulators/orbits/gravity.h"
#include "client/programs/simulators/player/trajectory.h"

namespace collision::client {

/// One step of x'' = Gravity(x) with the classical Runge-Kutta method of order 4. `seconds` may be
/// negative.
PositionAndVelocity Integrated(const PositionAndVelocity& from, double seconds);

/// Likewise in equal steps of at most `step_s`.
PositionAndVelocity Integrated(PositionAndVelocity from, double seconds, double step_s);

class Orbit {
 public:
  /// Through `at_begin` at `begin_ns`, in equal steps of at most `step_s`.
  Orbit(const PositionAndVelocity& at_begin, std::int64_t begin_ns, std::int64_t end_ns,
        double step_s);

  const Trajectory& curve() const { return curve_; }

  /// D and J, rounded up; and M, the greatest acceleration of the curve.
  double deviation_max_m_s2() const { return deviation_max_m_s2_; }
  double jerk_max_m_s3() const { return jerk_max_m_s3_; }
  double acceleration_max_m_s2() const { return acceleration_max_m_s2_; }

 private:
  Trajectory curve_;
  double deviation_max_m_s2_ = 0;
  double jerk_max_m_s3_ = 0;
  double acceleration_max_m_s2_ = 0;
};

}  // namespace collision::client
