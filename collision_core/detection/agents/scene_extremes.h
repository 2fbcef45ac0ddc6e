// The oldest and the newest state of a scene, and how fast anything in it can be.
#pragma once

#include "collision_core/motion/space_time_bound.h"

namespace collision::detection {

/// Maintains bounds of all newest states without a walk over all agents: each new state is included
/// at once, and rounds over the agents, a few in each step, drop what no longer holds. Until a
/// round is complete the bounds may be wider than the truth, never narrower. Unchecked: the
/// stamps of one agent never go back.
class SceneExtremes {
 public:
  /// Bounds of all newest states together.
  struct Bounds {
    Instant oldest = Instant::Never();  ///< No agent's newest state is older.
    Instant newest = Instant::Always();
    double speed_max = 0;           ///< |v| and its error [m/s].
    double position_error_max = 0;  ///< [m]
    double acceleration_max = 0;    ///< What is known of it and what is not, together [m/s²].
    double jerk_max = 0;            ///< [m/s³]
    double time_step_max = 0;       ///< [s]

    void Include(const motion::SpaceTimeBound& bound);
    /// Whether they would stay as they are if the bound was included.
    bool Holds(const motion::SpaceTimeBound& bound) const;

    friend bool operator==(const Bounds&, const Bounds&) = default;
  };

  /// Agents examined in each step, and additional ones for each agent that has changed.
  static constexpr std::size_t kAgentsPerStep = 64;
  static constexpr std::size_t kAgentsPerChange = 4;

  const Bounds& bounds() const { return bounds_; }

  void Include(const motion::SpaceTimeBound& bound) {
    bounds_.Include(bound);
    next_.Include(bound);
  }

  /// Examines the next agents of the table, whose indices are below `size`, round after round;
  /// `bound_of(i)` gives a bound or nullptr. At the end of a round its result replaces bounds().
  template <typename BoundOf>
  void ExamineNext(std::size_t changed, std::size_t size, const BoundOf& bound_of) {
    std::size_t looks = kAgentsPerStep + kAgentsPerChange * changed;
    if (looks >= size) {
      looks = size;
      Restart();
    }
    for (; looks > 0; --looks) {
      if (const motion::SpaceTimeBound* bound = bound_of(at_)) next_.Include(*bound);
      if (++at_ < size) continue;
      bounds_ = next_;
      Restart();
    }
  }

 private:
  void Restart() {
    next_ = Bounds();
    at_ = 0;
  }

  Bounds bounds_, next_;
  std::size_t at_ = 0;
};

}  // namespace collision::detection
