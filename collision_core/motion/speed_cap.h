// What a declared speed cap takes away from the horn.
#pragma once

#include "collision_core/motion/space_time_bound.h"

namespace collision {

/// Under a cap V no velocity leaves the ball of radius V' = V + ½ M h about zero (an integrator of
/// step h moves ½ M h faster within a step than at its ends). So from any instant t_s on, whatever
/// contained A then, grown by V' (t − t_s), contains it still. Two such bounds are used beside the
/// horn; of what separates two agents the later counts, as it does for ball and box:
///   the capped ball   the horn's ball until |v| + ε_v + M σ = V, that ball grown by V' afterwards;
///   the capped box    each face until its slope v_x + ε_v + M σ = V, from then on at slope V':
///                     a face's velocity is min(v_x + ε_v + M σ, V), integrated.
/// Both are convex in time, and both *nest*: what an honest agent reports later lies inside, so that
/// no answer is taken back. The ball v, radius ∫ min(M σ, V + |v|), is a bound as well, but as fast
/// sideways as along v: an honest turn leaves it. Derivations: README.md beside this file.
///
/// Changing a cap may make answers earlier, also to a lower one (its ball turns sooner): a widening.
/// Declaring one where there was none never does.
inline bool HasSpeedCap(const AgentDeclaration& declaration) {
  return declaration.speed_max < kInfinity;
}

/// V' [m/s].
Interval CappedSpeed(const AgentDeclaration& declaration);

/// When the capped ball leaves the horn: at the state's stamp at the earliest, Never() at the latest.
/// To the nanosecond below; any instant would be sound.
Instant CapTakesOver(const SpaceTimeBound& bound);

/// Likewise one face: `along` is v's component out of it, and `fraction` of ½ M σ(σ + h) counts
/// there.
Instant FaceCapTakesOver(const SpaceTimeBound& bound, double along, double fraction);

/// The capped ball at t >= from: A is within radius + u + speed · (t − from) of p_WA + shift.
struct CappedBall {
  Instant from;
  IntervalVector shift;
  Interval u;
  Interval speed;

  /// u as a quadratic in the seconds after `base`, valid at and after `from`.
  Quadratic UFrom(Instant base) const;
};

/// The bound must have a cap. `from` may be Never(): then nothing else is filled.
CappedBall CapBall(const SpaceTimeBound& bound);

/// One face under the cap at t >= from: A reaches up to radius + u + speed · (t − from) from
/// p_WA + shift along the face's normal.
struct CappedFace {
  Instant from;
  Interval shift;
  Interval u;
  Interval speed;

  Quadratic UFrom(Instant base) const;
};

/// Of the face whose normal is `sign` (1 or −1) times the axis.
CappedFace CapFace(const SpaceTimeBound& bound, int axis, int sign, Interval fraction);

}  // namespace collision
