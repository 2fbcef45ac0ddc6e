// A cheap test before the canonical routine: can a renewed agent lower another agent's key?
#pragma once

#include "collision_core/base/ids.h"
#include "collision_core/motion/space_time_bound.h"

namespace collision::detection {

/// Holds a short form of each agent's newest wide bound, side by side in memory.
///
/// The difference of the two centres moves on a segment; the agents stay apart while the segment's
/// distance from the origin exceeds what both can reach until the end. Known accelerations take the
/// difference off the tangent at the newer state by half their own difference times the square of
/// the time, which is added to the reach. Some thirty operations lose
/// far less than 2^-40 of their terms; a stamp is exact to the nanosecond.
class ClearanceFilter {
 public:
  /// `skew` is κ [s], the same for all bounds.
  explicit ClearanceFilter(double skew) : skew_(skew) {}

  /// The bound that keys are computed from: wide, and after a jump with the motion before it.
  void Set(AgentIndex agent, const motion::SpaceTimeBound& bound);

  /// The agent is a half-space, of which nothing is certain here.
  void SetEndless(AgentIndex agent);

  /// True only if no motions within the two bounds bring them together before `until`. Usually true
  /// if they stay well apart until then. Requires Set() of both.
  bool CertainlyLater(AgentIndex agent, AgentIndex partner, Instant until) const;

 private:
  /// The terms of a bound, rounded to nearest. A QuickBall rounds each coefficient outward when it
  /// is made; here one allowance for both agents covers every rounding, those of the row included,
  /// and other roundings would spare other partners and change the counted work.
  struct Row {
    Eigen::Vector3d p, v;
    double speed;      ///< |v|.
    double magnitude;  ///< |p| + |v|: rounding takes a part of it.
    double reach;      ///< Radius and all errors that do not grow, those of the skew included [m].
    double velocity_error;
    double acceleration_max;
    double time_step;
    Instant stamp;
    bool bends;
    double jerk_max;
    double known_rate;  ///< |a| (κ + ½ h) [m/s].
    Eigen::Vector3d a;
  };

  double skew_;
  IndexedVector<AgentIndex, Row> rows_;
};

}  // namespace collision::detection
