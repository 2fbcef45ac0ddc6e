// Whether a renewed agent can concern another one: a cheap test in front of the canonical routine.
#pragma once

#include <cstdint>
#include <vector>

#include "collision_core/motion/space_time_bound.h"

namespace collision::detection {

/// Of each agent what the test needs, side by side: its newest bound in short.
class KeyRows {
 public:
  explicit KeyRows(double skew) : skew_(skew) {}

  /// The bound that keys come from, where an agent that has jumped may still be before the jump.
  void Put(std::uint32_t agent, const motion::SpaceTimeBound& bound);
  /// True only if no motions within the two bounds bring them together before `until`. Says so
  /// mostly, where the two are well apart until then.
  bool CertainlyLater(std::uint32_t agent, std::uint32_t partner, Instant until) const;

 private:
  struct Row {
    Eigen::Vector3d p, v;
    double speed;      ///< |v|.
    double magnitude;  ///< |p| + |v|, of which rounding takes a part.
    double reach;      ///< Radius and all errors that do not grow; with the skew.
    double velocity_error;
    double acceleration_max;
    double time_step;
    Instant stamp;
  };

  double skew_;
  std::vector<Row> rows_;  // by agent
};

}  // namespace collision::detection
