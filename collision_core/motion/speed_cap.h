// What a declared speed cap takes away from the horn.
#pragma once

#include <optional>

#include "collision_core/motion/space_time_bound.h"

namespace collision::motion {

/// Whether the agent declares a speed cap V: |velocity| of its reference point never exceeds V
/// [m/s].
///
/// Under a cap, from any instant t_s on, whatever contained the agent then, grown by V' (t − t_s),
/// contains it still. V' = V + ½ A h with A the greatest acceleration, because the motion counted
/// within an integrator's step of h has the speed |v + a s + ½ a h|, where |v| and |v + a h| are at
/// most V. A is D + |a|; where a jerk is declared it grows without end, but two speeds of at most V
/// differ by at most 2 V, so A h <= 2 V and V' = 2 V (V without steps). Two such bounds are used
/// beside the horn; of everything that separates two agents the latest counts, as for balls and
/// boxes:
///
/// - The *capped ball* is the horn's ball until |v| + ε_v + (D + |a|) σ + ½ J σ'² = V, σ' = σ + 2
///   κ + h. From that instant on, its centre stays where the horn's centre then is, and its radius
///   grows at the rate V'. Before it, every velocity of the horn is below V; after it, the ball
///   allows every velocity up to V'.
/// - The *capped box*: each face with normal x follows the horn until v_x + ε_v + |a| κ + (f D +
///   max(0, a_x)) σ + ½ f J σ'² + ½ f D h = V + ½ D h, then has the slope V' (f is the fraction
///   that a declared direction leaves). That is min(v_x + D τ, V) integrated, not the lesser of
///   two positions, so its slopes never fall: without a known acceleration faces are convex, and a
///   chord over a window never cuts inside (hypertrapezoid.h).
///
/// The instants of change are whole nanoseconds, rounded down (at once, if within 2^-40 V of the
/// cap). Any instant would be sound, so nothing depends on the rounding.
///
/// Why not the ball of radius ∫ min(M σ, V + |v|) about the uniform motion? It is sound, but not
/// *nested*: its velocities finally fill the ball of radius V + |v| about v, and after a turn,
/// about v', another one; every honest turn would be a widening. A ball that contains the balls of
/// all later states needs the velocities |·| <= V as soon as |v| may be V: the capped ball. It is
/// loose for short times, where the horn is tight, so both are used. Head-on, the bound is exact:
/// the reach grows like |v| τ + ½ M τ² until the speed is V, and at the rate V from then on.
///
/// Nesting. Let T be the time at which the old ball changes, |v| + ε_v + (D + |a|) (T + κ) + ½ J (T
/// + 3 κ + h)² = V. With |e_v| <= ε_v − ε_v' + D s + ½ J s (s + 2 (κ + h)), |v'| <= |v| + |a| s +
/// |e_v| and |a'| <= |a| + J s the new one changes at T' >= T − s, which is later. While both are
/// horns, the conditions of contract.h apply. From T on the old ball grows by all velocities up to
/// V', which include every velocity of the new one, before T' and after. So the new ball need only
/// be inside at its own stamp, or, if the old one has not changed by then, when it does; for s > T
/// that means that U'(0) lies in the capped ball. For faces the same holds with the slopes of one
/// direction. If rounding makes T' earlier by x after all, the balls differ by (2 |v + a T| + A x)
/// x and the faces by A x², A = D + |a| + J (T + κ): that is reported as drift.
///
/// Breach: |v'| > V + ε_v', or p' farther from where the cap took over than errors, 2 κ and V'
/// explain, beyond the rounding allowance. Changing or dropping a cap is a widening, also lowering
/// it (the ball then changes sooner); declaring one where there was none is not.
inline bool HasSpeedCap(const MotionLimits& limits) {
  return limits.speed_max < numeric::kInfinity;
}

/// V' [m/s]. Requires a cap.
numeric::Interval CappedSpeed(const SpaceTimeBound& bound);

/// When the capped ball leaves the horn: not before the state's stamp; Never() if it never does.
/// Rounded down to the nanosecond; any instant would be sound. Requires a cap.
Instant CapStartOf(const SpaceTimeBound& bound);

/// A face of the horn's box: the one whose outward normal is `sign` (1 or −1) times the axis.
struct FaceNormal {
  int axis;
  int sign;

  /// The component of `v` along the normal.
  double Along(const Eigen::Vector3d& v) const { return sign * v[axis]; }
};

/// The same for one face; `fraction` is how much of ForwardDeviation() counts there. Requires a
/// cap.
Instant FaceCapStartOf(const SpaceTimeBound& bound, FaceNormal face, double fraction);

/// The capped ball at t >= from: A is within radius + u + speed · (t − from) [m] of p_WA + shift.
struct CappedBall {
  Instant from;                   ///< When the cap takes over.
  numeric::IntervalVector shift;  ///< From p_WA to the centre [m].
  numeric::Interval u;            ///< The horn's u at `from` [m].
  numeric::Interval speed;        ///< V' [m/s].

  /// u as a quadratic in the seconds after `base`, valid at and after `from`.
  numeric::Cubic UFrom(Instant base) const;
};

/// The capped ball of a bound. Requires a cap. `from` may be Never(); then only `from` is set.
CappedBall CappedBallOf(const SpaceTimeBound& bound);

/// A ball that counts from `start` seconds after its base on; they may be negative.
struct BallFromTime {
  double start;  ///< [s], rounded down.
  numeric::MovingBall ball;
};

/// The capped ball as seen from `base`, anchored at p_WA; it counts beside the horn's. nullopt: no
/// cap is declared, or it never takes over.
std::optional<BallFromTime> CappedBallFrom(const SpaceTimeBound& bound, Instant base);

/// One face under the cap at t >= from: A reaches up to radius + u + speed · (t − from) from
/// p_WA + shift along the face's normal.
struct CappedFace {
  Instant from;
  numeric::Interval shift;
  numeric::Interval u;
  numeric::Interval speed;

  /// As CappedBall::UFrom().
  numeric::Cubic UFrom(Instant base) const;
};

/// The capped face. `fraction` is how much of ForwardDeviation() counts there (DirectionalReach).
/// Requires a cap.
CappedFace CappedFaceOf(const SpaceTimeBound& bound, FaceNormal face, numeric::Interval fraction);

/// How far the centre of the horn has come along a face's normal, `since` seconds after its stamp.
numeric::Interval PathOfFace(const MotionState& state, FaceNormal face, numeric::Interval since);

}  // namespace collision::motion
