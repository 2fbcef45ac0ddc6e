// The values that simulators and monitors exchange with the library: plain structs, SI units, the
// unit in each name. What need not be declared is a std::optional, and nullopt is "not declared".
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "collision/export.h"

namespace collision::client {

/// Instants are nanoseconds: since the run's start in lock-step, since 1970 (UTC) with a wall
/// clock. This one stands for "never".
inline constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();

using Vector3 = std::array<double, 3>;     ///< x, y, z in the world frame W.
using Quaternion = std::array<double, 4>;  ///< w, x, y, z: rotates body axes to world axes.

class Shape;

/// Names one agent in all runs of all simulators of a world.
struct AgentId {
  std::uint64_t simulator = 0;   ///< Hash of the simulator's name.
  std::uint32_t run = 0;         ///< Of the simulator; a restart has a higher one.
  std::uint32_t slot = 0;        ///< Place in the simulator's table; reused after a removal ...
  std::uint32_t generation = 0;  ///< ... with the next generation.
  friend auto operator<=>(const AgentId&, const AgentId&) = default;
};

/// A word about an agent.
struct Tag {
  std::string key;
  std::string value;
  friend bool operator==(const Tag&, const Tag&) = default;
};

/// What an agent is called, as it was described last, also after it has left.
struct AgentLabel {
  std::string simulator;  ///< Name of its owner; empty: the service does not know any of this.
  std::string name;
  std::string assembly;
  std::vector<Tag> tags;
};

/// All x with normal · x <= offset_m, in W: a floor, a wall, without end.
struct HalfSpace {
  Vector3 normal{0, 0, 1};  ///< Out of it; of length 1 within 1e-6.
  double offset_m = 0;
};

/// What an agent declares about itself: valid for every state until it is described anew.
///
/// The service derives everything from these bounds. A bound that the motion exceeds makes the
/// service's answers wrong until it notices the breach; a bound that is too wide only makes them
/// less sharp.
struct AgentDescription {
  std::string name = {};  ///< 1 to 64 bytes, for people.
  /// Ball about the reference point that contains the agent. Beside a shape it may be left out, and
  /// is that of the shape; else it is required.
  std::optional<double> radius_m = {};
  /// Whatever comes within this of the agent counts as touching it; of two agents the sum of both
  /// counts. 0, or at least 1e-6.
  double margin_m = 0;
  /// Required. |acceleration − acceleration_m_s2| of its states never exceeds this, and
  /// `jerk_max_m_s3` for each second since the state more, between two states without a
  /// discontinuity. Two agents at rest with 0 cannot move: the service tells nothing of the two,
  /// even if they overlap.
  std::optional<double> acceleration_max_m_s2 = {};
  double jerk_max_m_s3 = 0;  ///< 0: what a state tells of the acceleration does not age.
  /// Not declared: every orientation is possible between two states.
  std::optional<double> angular_acceleration_max_rad_s2 = {};
  /// Of the reference point, never exceeded; above 0.
  std::optional<double> speed_max_m_s = {};
  /// Step h of an Euler integrator; not declared: the motion is continuous.
  std::optional<double> time_step_s = {};
  /// One of the classes that the service's configuration names, which says whom it can meet; empty:
  /// it can meet all. At most 32 bytes.
  std::string class_name = {};
  /// The agents of one assembly of this simulator, as the links of a robot, never meet each other;
  /// empty: of none. At most 64 bytes.
  std::string assembly = {};
  /// Names of agents of its assembly that it can meet after all. At most 16; of two agents one is
  /// enough to list the other.
  std::vector<std::string> meets_in_assembly = {};
  /// Names of agents of this simulator that it never meets. Likewise; this wins.
  std::vector<std::string> never_meets = {};
  /// Words about it for those who look, "kind" "forklift": at most 16, with different keys of 1 to
  /// 32 bytes and values of at most 64. They stand in every event of the agent.
  std::vector<Tag> tags = {};
  /// Its shape (collision/shape.h), inside the ball of `radius_m`; null: the ball itself.
  std::shared_ptr<const Shape> shape = nullptr;
  /// Its body is this half-space: then it has neither radius nor shape, never moves, and meets
  /// every agent that can move. Of its states only the stamp and the expiry count. It cannot change
  /// while the agent is there; the service holds at most 64.
  std::optional<HalfSpace> half_space = {};
  /// A motion to be screened, such as a manoeuvre that may be flown: only its simulator hears what
  /// it would meet (Event::hypothetical), and nothing that is found, promised or granted to real
  /// agents depends on it. It meets real agents only. Never changes.
  bool hypothetical = false;
};

/// Where an agent is and how it moves at one instant, as its owner knows it.
struct State {
  std::int64_t stamp_ns = 0;
  Vector3 position_m{};                ///< Of the reference point.
  Vector3 velocity_m_s{};              ///< Of the reference point.
  Vector3 acceleration_m_s2{};         ///< As far as its owner knows it; zero: nothing is known.
  Quaternion orientation{1, 0, 0, 0};  ///< Unit within 0.001.
  Vector3 angular_velocity_rad_s{};    ///< In W.
  double position_error_m = 0;         ///< The true position is at most this far away.
  double velocity_error_m_s = 0;       ///< Likewise the true velocity.
  double rotation_error_rad = 0;       ///< Likewise the true orientation, as an angle.
  /// Unit d with (acceleration − acceleration_m_s2)·d >= 0.
  std::optional<Vector3> thrust_direction = {};
  std::int64_t direction_until_ns = kNever;    ///< The declared direction holds until then.
  std::optional<std::int64_t> expiry_ns = {};  ///< Promises exclude the agent from then on.
  bool discontinuity = false;                  ///< The motion jumped here: a teleport or a bounce.
};

/// A closed interval of time that contains a begin or an end.
struct TimeBracket {
  std::int64_t earliest_ns = kNever;
  std::int64_t latest_ns = kNever;  ///< kNever: open.
};

/// The life of an event. A possible one becomes confirmed (contact certain), dismissed (certainly
/// no contact), undecided (over, and neither could be certified) or withdrawn (an agent left); a
/// confirmed one becomes ended.
enum class EventStatus { kPossible, kConfirmed, kDismissed, kUndecided, kWithdrawn, kEnded };

/// "possible", "confirmed", ...
COLLISION_API const char* Name(EventStatus status);

/// A contact, or a pair that could not be decided: not one of the many possible events that come to
/// nothing.
inline bool IsDecided(EventStatus status) {
  return status == EventStatus::kConfirmed || status == EventStatus::kEnded ||
         status == EventStatus::kUndecided;
}

/// What kept the brackets from being narrower: the work allowed, the uncertainty of the motion, or
/// the resolution of the shapes' sphere trees.
enum class EventLimit { kNone, kBudget, kMotion, kGeometry };

/// "none", "budget", ...
COLLISION_API const char* Name(EventLimit limit);

/// The direction between two bodies.
struct Normal {
  Vector3 direction{};   ///< Unit, from lower to higher.
  double error_rad = 0;  ///< Angle to the true one, at most.
};

/// The velocity of the higher agent's point less that of the lower one's.
struct RelativeVelocity {
  Vector3 velocity_m_s{};
  double error_m_s = 0;  ///< The true one is within this of it.
};

/// How near two agents are at one instant.
struct Proximity {
  std::int64_t at_ns = 0;         ///< The rest holds in this nanosecond.
  double separation_lower_m = 0;  ///< Distance of the surfaces, negative inside: at least.
  double separation_upper_m = 0;  ///< At most; <= 0: in contact.
  double depth_lower_m = 0;       ///< Penetration depth: at least.
  Vector3 point_m{};              ///< A common point, within its error; apart: half-way between.
  double point_error_m = 0;
  std::optional<Normal> normal;  ///< Absent: nobody knows it.
  /// The solid or triangle that touches at the point, or is nearest: its number in the shape.
  /// Absent: a ball, or not resolved so far.
  std::optional<std::uint32_t> lower_part;
  std::optional<std::uint32_t> higher_part;
  std::optional<RelativeVelocity> relative_velocity;  ///< At the point.
};

/// A state as its owner told it.
struct StateUsed {
  std::int64_t stamp_ns = 0;
  Vector3 position_m{};
  Vector3 velocity_m_s{};
  Vector3 acceleration_m_s2{};
};

/// What is certain of the least distance of two agents within a span of time.
struct ClosestApproach {
  std::int64_t from_ns = 0;  ///< The span.
  std::int64_t until_ns = 0;
  TimeBracket at;  ///< They are nearest within it.
  double distance_lower_m = 0;
  double distance_upper_m = 0;  ///< <= 0: they touch.
};

/// What is expected of a pair.
enum class ExpectedOutcome {
  kTouch,
  kPass,
  kUndecided  ///< They graze, or the service's work did not suffice.
};

/// "touch", "pass", "undecided".
COLLISION_API const char* Name(ExpectedOutcome outcome);

/// What happens if both agents keep the motion that their newest states tell. No proof: nobody has
/// to keep it. The brackets are certain for that motion.
struct Expectation {
  ExpectedOutcome outcome = ExpectedOutcome::kUndecided;
  TimeBracket begin;                       ///< kTouch: when they begin to touch; else kNever.
  std::optional<ClosestApproach> closest;  ///< kPass: how near, and when.
  std::int64_t until_ns = 0;               ///< How far ahead it looked.
};

/// One revision of one contact of a pair. (level, lower, higher, contact) names the contact; a
/// higher revision replaces a lower one. Every bracket contains the truth.
struct Event {
  /// The level of the service's configuration whose margin the two cross: "touch" then means "come
  /// within margin_m". Empty: they touch.
  std::string level;
  AgentId lower;
  AgentId higher;
  AgentLabel lower_label;
  AgentLabel higher_label;
  std::uint32_t contact = 0;  ///< Ordinal among the contacts of this pair, from 1.
  std::uint32_t revision = 0;
  std::int64_t now_ns = 0;  ///< The service's time at this revision.
  /// Number among the contacts (confirmed, ended, undecided) of the world; 0: a forecast.
  std::uint64_t contacts_sequence = 0;
  EventStatus status = EventStatus::kPossible;
  TimeBracket begin;
  TimeBracket end;
  bool continuous = true;     ///< Contact is certified without a gap from begin to end.
  bool began_before = false;  ///< Perhaps before either agent was known, or jumped.
  double margin_m = 0;  ///< Of the two: this event is about the bodies grown by their margins.
  /// At one instant of the contact or doubt; none of a pair that is only possible.
  std::optional<Proximity> proximity;
  /// The states from which the event was computed: of a possible event the newest ones, else those
  /// in force at `proximity->at_ns`. Absent: the service does not keep them any more.
  std::optional<StateUsed> lower_state;
  std::optional<StateUsed> higher_state;
  /// Of a possible event: what happens if both keep the motion that they told. Absent while a shape
  /// is awaited.
  std::optional<Expectation> expected;
  /// Since the event was announced, or of the contact. Final in dismissed and ended events; absent:
  /// nothing is known yet.
  std::optional<ClosestApproach> closest;
  std::uint32_t tree_level = 0;  ///< Depth of the sphere trees that decided it; 0: balls.
  std::uint64_t work_units = 0;  ///< Spent on this contact so far.
  EventLimit limited_by = EventLimit::kNone;
  /// An agent of the pair is gone: it has "left", or the service removed it: "silent", "evicted",
  /// "restarted" or "refused"; else empty.
  std::string because;
  /// One of the two is a hypothetical agent of this simulator: nobody else hears of it, and in
  /// truth nothing touches. It has no contacts_sequence, whatever its status.
  bool hypothetical = false;
};

/// A sample that the service refused, and why.
struct Rejection {
  std::uint64_t simulator = 0;  ///< Its sender.
  std::string reason;           ///< As in the IDL: REJECTED_...
  std::string topic;
  std::uint32_t slot = 0;
  std::string field;
  std::string detail;
  std::uint64_t count = 0;  ///< Of all rejections of this simulator so far.
  /// Sending it again does not help: a value out of range, no room. False for what was late or
  /// lost.
  bool lasting = false;
};

/// What an agent broke of what it declared: no motion under its declaration leads from one of its
/// states to the next. BOUNDS.md says what to do.
struct Breach {
  AgentId agent;
  /// The first bound that is broken on its own, as in the IDL: "acceleration_max_m_s2",
  /// "speed_max_m_s", "angular_acceleration_max_rad_s2"; "thrust_direction", of a state.
  std::string field;
  double declared = 0;  ///< Its value; of a direction 0.
  /// What the motion reached, certainly at least; of a direction how far it fell below 0. Infinity:
  /// no value explains the two states.
  double seen = 0;
  std::int64_t from_ns = 0;  ///< Stamp of the last honest state ...
  std::int64_t at_ns = 0;    ///< ... and of the one that does not follow from it.
  std::uint64_t count = 0;   ///< Breaches of this agent so far; may be newer than the rest.
};

/// How long one agent is clear: before `clear_until_ns` it begins no contact that the service has
/// not announced as possible.
struct Clearance {
  std::int64_t clear_until_ns =
      std::numeric_limits<std::int64_t>::min();  ///< INT64_MIN: no promise yet.
  bool not_clear = false;                        ///< `clear_until_ns` has come: it may touch.
  bool saturated = false;  ///< It has more partners at hand than the service tracks.
  /// From when on promises count its latest admission, jump or widened declaration.
  std::int64_t effective_from_ns = std::numeric_limits<std::int64_t>::min();
  /// That holds for its newest description, too: nobody relies on the one before any more. Until
  /// then the agent must keep to both.
  bool description_counts = false;
  /// How often it was lowered for a cause since the agent was admitted.
  std::uint32_t lowerings = 0;
  /// The newest cause that this simulator has not taken in before, as in the IDL (CAUSE_...);
  /// empty: none. It may be lower even then, where a contact ended or the agent became saturated.
  std::string cause;
  AgentId cause_agent;
  std::int64_t void_from_ns = kNever;  ///< A broken declaration voids the promise from then on.
  /// In real time: the promise holds no longer than this unless the service is heard again. In
  /// lock-step time does not go on without the service: kNever.
  std::int64_t expires_ns = kNever;
  /// When the service next needs a state of the agent. A time that is not after the sample's own:
  /// at every step. kNever: it needs none. A World sends those states by itself
  /// (WorldOptions::on_demand).
  std::int64_t state_wanted_ns = std::numeric_limits<std::int64_t>::min();
};

/// What a World has sent since it was created.
struct Traffic {
  std::uint64_t states_set = 0;    ///< By the simulator: what a stream would send.
  std::uint64_t states_sent = 0;   ///< Those of them that were sent.
  std::uint64_t samples_sent = 0;  ///< Samples of topic agent_states.
  std::uint64_t bytes_sent = 0;    ///< Of these samples, without the network's headers.
};

}  // namespace collision::client
