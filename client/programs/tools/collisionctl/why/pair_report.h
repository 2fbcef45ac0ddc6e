// What keeps two agents apart for how long, as far as it follows from what they have told.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "client/programs/shared/world_view.h"

namespace collision::client {

/// How far an agent can be from where its last state leads, by what is not known of its motion [m]:
/// the terms of u(t) at the head of collision_core/motion/space_time_bound.h, without a speed cap
/// and a thrust direction, which make it smaller.
struct Reach {
  double position_error = 0;  ///< ε_p
  double velocity_error = 0;  ///< ε_v σ
  double acceleration = 0;    ///< ½ D σ (σ + h)
  double jerk = 0;            ///< ⅙ J σ (σ² + 3 h σ + 3 h²)
  double skew = 0;            ///< |v| κ + |a| (κ + ½ h) σ
  double Sum() const { return position_error + velocity_error + acceleration + jerk + skew; }
};

/// One agent of the pair.
struct BoundReport {
  AgentView agent;
  std::string name;      ///< With its simulator.
  std::string unusable;  ///< Why nothing can be computed of it; empty: all below is.
  double age = 0;        ///< Of its state [s]; negative: it lies ahead.
  Reach first;           ///< At the report's `from_ns`.
  Reach at_earliest;     ///< When the pair can meet, if it can.
  Reach fresh;           ///< Likewise, had it a state of now.
};

/// Why the pair meets when it does, or never.
struct PairReport {
  std::int64_t now_ns = 0;
  /// Now, or the newest stamp of the two, if that is later: from here on both states hold.
  std::int64_t from_ns = 0;
  double skew = 0;  ///< κ of the service [s].
  BoundReport a, b;
  double distance = 0;  ///< Of the reference points at `from_ns` [m].
  double gap = 0;       ///< What both balls leave of it; negative: they overlap [m].
  /// From `from_ns` on not before this, as follows from both states; kNever: never; nullopt: one is
  /// not usable.
  std::optional<std::int64_t> earliest_ns;
  std::vector<std::string> apart;           ///< Why the two are not looked at; empty: they are.
  std::vector<std::string> not_told;        ///< What else may keep them apart: the service's.
  std::optional<v1::CollisionEvent> event;  ///< The pair's newest.
};

/// Requires a status; the two differ. `event`: as in the report.
PairReport ReportOn(const AgentView& a, const AgentView& b,
                    const std::optional<v1::CollisionEvent>& event, const WorldView& view);

/// The terms after σ = `elapsed` + κ seconds.
Reach ReachAfter(double elapsed, double skew, const v1::AgentDescription& description,
                 const v1::AgentState& state);

}  // namespace collision::client
