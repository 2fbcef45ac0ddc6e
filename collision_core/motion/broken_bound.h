// Which declared bound a breach broke, and by how much at least.
#pragma once

#include "collision_core/motion/contract.h"

namespace collision::motion {

/// What an owner declares about a motion and a breach can break.
enum class DeclaredBound {
  /// D [m/s²]: of |x″ − a| less J |t − stamp|, with a and stamp of either state.
  kAccelerationMax,
  kSpeedMax,                ///< V [m/s].
  kAngularAccelerationMax,  ///< α [rad/s²].
  /// (x″ − a)·d >= 0: the declared value is 0, the value seen is how far below 0 it fell [m/s²].
  kThrustDirection
};

/// A breach in numbers: between two states the motion reached at least `seen` where at most
/// `declared` was allowed. +infinity: no finite value explains the two states, as of another
/// position at the same instant.
struct BrokenBound {
  DeclaredBound bound = DeclaredBound::kAccelerationMax;
  double declared = 0;
  double seen = 0;
  Instant from;  ///< Stamp of the last honest state ...
  Instant at;    ///< ... and of the state that cannot follow from it.
};

/// Explains a breach. `seen` is certified: a motion that keeps everything else that is declared
/// (errors, jerk, time step) and this bound with a smaller value does not lead from the one state
/// to the other, beyond what rounding at an honest sender explains. It is nearly the largest such
/// value: of what lies above `declared` at most kSeenShortfall is missing.
///
/// Derivation. Call a value m refuted if CheckContract(), with m in place of the declared value,
/// finds a breach. That is a proof that no motion under m does it (contract.h). A motion under a
/// smaller value is also one under m, so everything below a refuted m is impossible too, whether or
/// not the check itself grows evenly with m. The search keeps a refuted value and ends with it: a
/// lower bound, however it was found.
///
/// Of several broken bounds the first of this order is named, each checked without those that come
/// later: the acceleration, without speed cap and direction; the direction, without the cap; the
/// speed; the turning. What is named is therefore broken on its own. A value b against the
/// direction, (x″ − a)·d >= −b, is (x″ − (a − b d))·d >= 0 where the unknown part is at most D + b,
/// so the same check refutes it.
///
/// Requires next.stamp >= before.state.stamp, and that the check finds a breach with this
/// `orientation`. Some 30 contract checks; allocates nothing.
BrokenBound ExplainBreach(const SpaceTimeBound& before, const MotionState& next,
                          OrientationUse orientation);

/// The part of seen − declared that the search may leave out.
inline constexpr double kSeenShortfall = 0x1p-10;

}  // namespace collision::motion
