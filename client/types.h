// What a simulator and a monitor say and hear. Plain values: nothing of the network shows.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace collision::client {

/// Instants are nanoseconds: since the run's start in lock-step, since 1970 with a wall clock. This
/// one is never.
inline constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();

using Vector3 = std::array<double, 3>;     ///< x, y, z in the world frame W.
using Quaternion = std::array<double, 4>;  ///< w, x, y, z, body to world.

class Shape;

struct AgentId {
  std::uint64_t simulator = 0;
  std::uint32_t run = 0;
  std::uint32_t slot = 0;
  std::uint32_t generation = 0;
  friend auto operator<=>(const AgentId&, const AgentId&) = default;
};

/// What does not change from state to state. Units as in the names.
struct AgentDescription {
  std::string name = {};             ///< 1 to 64 bytes, for people.
  double radius_m = 0;               ///< Ball about the reference point that contains the agent.
  double acceleration_max_m_s2 = 0;  ///< Never exceeded between two states without a discontinuity.
  double angular_acceleration_max_rad_s2 = -1;  ///< < 0: not declared.
  double speed_max_m_s = 0;  ///< Of the reference point, never exceeded; 0: not declared.
  double time_step_s = 0;    ///< h of an Euler integrator, of either kind; 0: continuous motion.
  std::uint32_t group = 1;   ///< Bits this agent is.
  std::uint32_t mask = ~0u;  ///< Bits it can meet.
  /// Its shape (client/shape.h), within the ball of `radius_m`; null: the ball itself.
  std::shared_ptr<const Shape> shape = nullptr;
};

struct State {
  std::int64_t stamp_ns = 0;
  Vector3 position_m{};
  Vector3 velocity_m_s{};
  Quaternion orientation{1, 0, 0, 0};
  Vector3 angular_velocity_rad_s{};
  double position_error_m = 0;
  double velocity_error_m_s = 0;
  double rotation_error_rad = 0;
  Vector3 thrust_direction{};  ///< Unit d with acceleration·d >= 0; zero: not declared.
  std::int64_t direction_until_ns = kNever;
  std::int64_t expiry_ns = kNever;
  bool discontinuity = false;  ///< The motion jumped here: a teleport or a bounce.
};

struct TimeBracket {
  std::int64_t earliest_ns = kNever;
  std::int64_t latest_ns = kNever;  ///< kNever: open.
};

enum class EventStatus { kPossible, kConfirmed, kDismissed, kUndecided, kWithdrawn, kEnded };

/// "possible", "confirmed", ...
const char* Name(EventStatus status);

/// What kept the brackets from being narrower: the work allowed, the uncertainty of the motion, or
/// what the shapes' trees resolve.
enum class EventLimit { kNone, kBudget, kMotion, kGeometry };

/// "none", "budget", ...
const char* Name(EventLimit limit);

/// One revision of one contact; (lower, higher, contact) names it, a higher revision replaces a
/// lower one.
struct Event {
  AgentId lower;
  AgentId higher;
  std::uint32_t contact = 0;
  std::uint32_t revision = 0;
  std::int64_t now_ns = 0;  ///< The service's time when it said so.
  EventStatus status = EventStatus::kPossible;
  TimeBracket begin;
  TimeBracket end;
  bool continuous = true;
  bool began_before = false;
  std::int64_t evaluated_at_ns = kNever;  ///< The rest holds in this nanosecond; kNever: at none.
  double separation_lower_m = 0;
  double separation_upper_m = 0;
  double depth_lower_m = 0;
  Vector3 point_m{};
  double point_error_m = 0;
  Vector3 normal{};  ///< Unit, from lower to higher.
  double normal_error_rad = 0;
  std::uint32_t level = 0;  ///< Of the sphere trees, down to which it was decided; 0: balls.
  std::uint64_t work_units = 0;
  EventLimit limited_by = EventLimit::kNone;
};

/// A sample the service refused, and why.
struct Rejection {
  std::string reason;  ///< As in the IDL: REJECTED_...
  std::string topic;
  std::uint32_t slot = 0;
  std::string field;
  std::string detail;
  std::uint64_t count = 0;  ///< Of all rejections of this simulator so far.
};

/// How long one agent is clear.
struct Clearance {
  std::int64_t clear_until_ns =
      std::numeric_limits<std::int64_t>::min();  ///< No promise yet: minimum.
  bool not_clear = false;
  bool saturated = false;
  std::int64_t effective_from_ns = std::numeric_limits<std::int64_t>::min();
  std::string cause;  ///< Why it was lowered, as in the IDL; empty: it was not.
  AgentId cause_agent;
  std::int64_t void_from_ns = kNever;
  /// When the service next needs a state of the agent: not after its own time, at every step; kNever:
  /// none. A World tells those states by itself (WorldOptions::on_demand).
  std::int64_t state_wanted_ns = std::numeric_limits<std::int64_t>::min();
};

/// What a World has sent since its beginning.
struct Traffic {
  std::uint64_t states_set = 0;    ///< By the simulator: what a stream would send.
  std::uint64_t states_sent = 0;   ///< Of them, those that were told.
  std::uint64_t samples_sent = 0;  ///< On the network, of agent_states.
  std::uint64_t bytes_sent = 0;    ///< Of these samples, without the network's own.
};

}  // namespace collision::client
