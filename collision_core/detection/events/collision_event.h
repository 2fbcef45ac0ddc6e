// One revision of an event about a pair of agents.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "collision_core/base/instant.h"
#include "collision_core/detection/events/agent_id.h"
#include "collision_core/narrow_phase/pose/proximity.h"

namespace collision::detection {

/// The status of an event. Every event begins as possible; the transitions are
/// possible -> confirmed | dismissed | undecided | withdrawn, and confirmed -> ended.
enum class EventStatus {
  kPossible,   ///< The two may meet within announce_within, or may have met already.
  kConfirmed,  ///< Contact is certified.
  kDismissed,  ///< No contact took place, and the two are far apart again.
  kUndecided,  ///< The interval is over; neither contact nor freedom could be certified in it.
  kWithdrawn,  ///< An agent was removed or expired, or a filter keeps the two apart; no contact.
  kEnded       ///< The contact has ended, or its end is unknown: then end.latest is Never().
};

/// [earliest, latest] contains the true instant, rounded outward to nanoseconds. `latest` is
/// Never() while no upper end is known.
struct TimeBracket {
  Instant earliest = Instant::Never();
  Instant latest = Instant::Never();
  friend bool operator==(const TimeBracket&, const TimeBracket&) = default;
};

/// A state as its owner told it, from which an event was computed; World frame W, SI units.
struct StateUsed {
  Instant stamp;
  Eigen::Vector3d p_WA = Eigen::Vector3d::Zero();
  Eigen::Vector3d v_WA = Eigen::Vector3d::Zero();
  Eigen::Vector3d a_WA = Eigen::Vector3d::Zero();
};

/// What is certain of the least distance of a pair within [from, until].
struct ClosestApproach {
  Instant from, until;
  TimeBracket at;              ///< They are nearest within it.
  numeric::Interval distance;  ///< Of the surfaces [m]; upper <= 0: they touch.
};

/// What happens if both keep the motion that they told: no proof, since nobody has to.
enum class ExpectedOutcome {
  kTouch,     ///< They touch.
  kPass,      ///< They do not, up to Expectation::until.
  kUndecided  ///< They graze, or the work did not suffice.
};

/// What is expected of a pair: both keep the acceleration and the angular velocity of their newest
/// states, which count as exact. Brackets are certified for that motion.
struct Expectation {
  ExpectedOutcome outcome = ExpectedOutcome::kUndecided;
  TimeBracket begin;  ///< kTouch: when they begin to touch; else Never().
  /// kPass: how near they come, and when; else nothing.
  std::optional<ClosestApproach> closest;
  Instant until;  ///< Nothing beyond it was looked at.
};

/// The velocity of B's point at a place less that of A's there [m/s], in W.
struct RelativeVelocity {
  Eigen::Vector3d v_AB = Eigen::Vector3d::Zero();
  double error = 0;  ///< The true one is within this of it [m/s].
};

/// One revision of the event about one contact of one pair. (lower, higher, contact) names the
/// event; a higher revision replaces a lower one. World frame W, SI units.
struct CollisionEvent {
  AgentId lower;                                  ///< The agent with the lower id.
  AgentId higher;                                 ///< The agent with the higher id.
  std::uint32_t lower_side = 0, higher_side = 0;  ///< As declared in their filters.
  std::uint32_t pair_slot = 0;  ///< Key on the wire; reused after the pair is no longer tracked.
  std::uint32_t contact = 1;    ///< Number of the contact among the pair's, from 1.
  std::uint32_t revision = 1;   ///< From 1.
  Instant now;                  ///< The detector's time at the revision.
  EventStatus status = EventStatus::kPossible;
  /// When the contact began: `earliest` is how far freedom is certified without a gap, `latest` the
  /// first certified contact. If undecided, [begin.earliest, end.latest] is the whole interval that
  /// is not certified free.
  TimeBracket begin;
  /// When it ended: `earliest` is how far contact is certified, `latest` the first certified
  /// freedom.
  TimeBracket end;
  bool continuous = true;  ///< Contact is certified without a gap on [begin.latest, end.earliest].
  /// The contact may have begun before one of the two was admitted, jumped or broke its bound.
  bool began_before = false;
  /// The margins of the two together [m]. With a margin, everything here is about the bodies grown
  /// by it: a contact begins where the two come within it of each other.
  double margin = 0;
  /// The instant at which the values below hold, within a nanosecond; Never(): they are not known.
  Instant evaluated_at = Instant::Never();
  double separation_lower = 0;  ///< The distance of the surfaces is at least this [m].
  double separation_upper = 0;  ///< It is at most this [m]; <= 0: in contact.
  double depth_lower = 0;       ///< The translational penetration depth is at least this [m].
  Eigen::Vector3d p_WC = Eigen::Vector3d::Zero();  ///< Contact point [m].
  double point_error = 0;  ///< The true contact point lies within this of p_WC [m].
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< Unit vector, from lower to higher.
  double normal_error = 0;                           ///< Angle to the true normal, at most [rad].
  /// Of the higher agent against the lower one, at p_WC; none where it is not known.
  std::optional<RelativeVelocity> relative_velocity;
  /// The solid or triangle of either shape that touches at p_WC, or is nearest; none of a ball, and
  /// where only balls of the trees were compared.
  std::optional<std::uint32_t> lower_part, higher_part;
  /// The states from which the event was computed: the newest ones of a possible event, of the
  /// others those in force at `evaluated_at`. None where they are not kept any more.
  std::optional<StateUsed> lower_state, higher_state;
  /// What is expected of a possible event; none of others, and while a shape is awaited.
  std::optional<Expectation> expected;
  /// The closest approach so far: since the event was announced, or of the contact. Final in events
  /// that are dismissed or ended; none where nothing is known yet, and since a bound was broken.
  std::optional<ClosestApproach> closest;
  /// Depth of the sphere trees down to which the pair was examined; 0: balls.
  std::uint32_t level = 0;
  std::uint64_t work = 0;  ///< WorkBudget units spent on this contact.
  /// What kept the brackets from being narrower.
  narrow_phase::BracketLimit limited_by = narrow_phase::BracketLimit::kMotion;
};

}  // namespace collision::detection
