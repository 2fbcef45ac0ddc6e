// How much wider than the truth the bounds are that clearance keys are computed from.
#pragma once

#include "collision_core/motion/contract.h"
#include "collision_core/motion/space_time_bound.h"

namespace collision::detection {

/// Clearance keys are computed from bounds a little wider than the true ones, so that a key from an
/// older state is not later than the canonical answer from a newer one that kept its contract up to
/// rounding. Such a state may lie off by a few units in the last place, and by how far the agent
/// moves while its stamp is rounded to the nanosecond. What each kept state may have lost is taken
/// off the margin, so that every widened bound lies inside the one before it, in exact arithmetic:
/// the broad phase relies on that. When the margin is used up, the agent is renewed.
class BoundMargin {
 public:
  BoundMargin() = default;

  /// The full margin: 2^-40 of the magnitudes (a unit in the last place is 2^-52 of them), and four
  /// nanoseconds of motion.
  explicit BoundMargin(const motion::SpaceTimeBound& bound);

  /// Takes off what a kept state may have lost against the one before it. False: there is not
  /// enough left, and all keys that relied on the bound must be computed anew.
  bool Spend(const motion::ContractCheck& check, const motion::SpaceTimeBound& before);

  /// The bound with the rest of the margin added to its errors, that of the known acceleration to
  /// what is not known of it; after a jump also with where the
  /// agent may have been since the skew before it.
  motion::SpaceTimeBound Widen(const motion::SpaceTimeBound& bound) const;

 private:
  double position_ = 0;      ///< What is left [m].
  double velocity_ = 0;      ///< What is left [m/s].
  double acceleration_ = 0;  ///< What is left [m/s²]; 0 where none is known or ages.
};

}  // namespace collision::detection
