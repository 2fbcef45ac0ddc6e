// One revision of an event about a pair of agents.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "collision_core/base/instant.h"
#include "collision_core/detection/events/agent_id.h"
#include "collision_core/narrow_phase/pose/proximity.h"

namespace collision::detection {

/// possible -> confirmed | dismissed | undecided | withdrawn;  confirmed -> ended.
enum class EventStatus { kPossible, kConfirmed, kDismissed, kUndecided, kWithdrawn, kEnded };

/// A closed bracket, rounded outward; `latest` is Never() while it is open.
struct TimeBracket {
  Instant earliest = Instant::Never();
  Instant latest = Instant::Never();
  friend bool operator==(const TimeBracket&, const TimeBracket&) = default;
};

/// One revision of one contact of one pair. (lower, higher, contact) names the contact; a higher
/// revision replaces a lower one.
struct CollisionEvent {
  AgentId lower;
  AgentId higher;
  std::uint32_t pair_slot = 0;  ///< Key on the wire; reused after the pair is no longer tracked.
  std::uint32_t contact = 1;    ///< Ordinal of the pair's contacts.
  std::uint32_t revision = 1;
  Instant now;  ///< The service's time at the revision.
  EventStatus status = EventStatus::kPossible;
  /// Begin lies in [freedom certified continuously up to, first certified contact]. Undecided: the
  /// whole interval that is not certified free is [begin.earliest, end.latest].
  TimeBracket begin;
  TimeBracket end;
  bool continuous = true;  ///< No gap in certified contact from begin.latest to end.earliest.
  /// The contact may have begun before one of the two was admitted, jumped or broke its bound.
  bool began_before = false;
  /// The nanosecond in which the values below hold; Never(): they are not known.
  Instant evaluated_at = Instant::Never();
  double separation_lower = 0;  ///< Distance of the surfaces [m]; <= 0: in contact.
  double separation_upper = 0;
  double depth_lower = 0;  ///< Translational penetration depth is at least this [m].
  Eigen::Vector3d p_WC = Eigen::Vector3d::Zero();  ///< Contact point [m], within `point_error`.
  double point_error = 0;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< Unit, from lower to higher.
  double normal_error = 0;                           ///< Angle [rad].
  /// Depth of the sphere trees down to which the pair was examined; 0: balls.
  std::uint32_t level = 0;
  std::uint64_t work = 0;  ///< WorkBudget units spent on this contact.
  narrow_phase::EventLimit limited_by = narrow_phase::EventLimit::kMotion;
};

}  // namespace collision::detection
