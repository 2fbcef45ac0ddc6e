// What the service knows about one simulator and its agents, beside what the core holds.
#pragma once

#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "collision_core/detection/detector.h"
#include "idl/messages.pb.h"

namespace collision::server {

/// A described agent. It is admitted to the detector once a state and, with a simulated clock, the
/// first clock of its simulator are there.
struct Agent {
  std::uint32_t generation = 0;
  std::uint32_t revision = 0;
  motion::AgentDeclaration declaration;
  std::string shape_hash = {};  ///< Empty: the ball is its shape.
  bool admitted = false;
  bool told_no_room = false;
  Instant stamp = Instant::Always();                        ///< Of the newest state in force.
  std::uint64_t acknowledged_sequence = 0;                  ///< Likewise its sequence.
  std::optional<detection::AgentClearance> clearance = {};  ///< As last told by the detector.
};

/// The newest state of an agent that cannot be admitted yet.
struct WaitingState {
  std::uint32_t generation = 0;
  std::uint64_t sequence = 0;
  motion::MotionState state;
};

/// One slot, through all its generations.
struct Slot {
  std::optional<Agent> agent;
  std::optional<WaitingState> waiting;
  std::uint64_t generations_over = 0;  ///< Every generation below has been removed or replaced.
  /// The newest state looked at, accepted or not: a chunk repeats what has not changed.
  std::optional<std::pair<std::uint32_t, std::uint64_t>> handled;  ///< Generation, sequence.
};

/// A clock that waits until what was written before it has arrived.
struct PendingClock {
  Instant clock;
  std::uint64_t states_sequence = 0;
  std::uint64_t descriptions_sequence = 0;
  bool lock_step = false;
};

/// A simulator's clocks come in order, so only a few overtake their states; beyond, the newest
/// replaces the last, which costs granularity and nothing else.
inline constexpr std::size_t kPendingClocksMax = 16;

/// Inputs of a simulator that waits for its id until the former owner is gone.
inline constexpr std::size_t kHeldInputsMax = 4096;

struct Simulator {
  std::uint64_t id = 0;
  std::uint64_t sender = 0;  ///< Who owns the id, as the network tells.
  std::uint32_t run = 0;
  std::string name;  ///< Empty until a description or a clock has proved it.
  bool alive = true;
  bool released = false;             ///< Silent too long: no longer waited for.
  std::int64_t silent_since_ns = 0;  ///< Monotonic; while not alive.

  std::uint64_t states_seen = 0;        ///< Highest sequence that has arrived in this run.
  std::uint64_t descriptions_seen = 0;  ///< Likewise.
  Instant told = Instant::Always();     ///< The newest clock that has arrived.
  std::deque<PendingClock> pending;
  std::optional<Instant> first_clock;  ///< The one this service first brought into force.
  std::optional<Instant> clock;        ///< The newest clock in force.
  std::optional<Instant> granted;      ///< By this service, in this run.
  bool lock_step = true;               ///< It waits for grants, as its newest clock says.

  std::map<std::uint32_t, Slot> slots;
  /// It has told clocks of the other kind only: its stamps mean nothing here.
  bool other_time = false;
  std::size_t agents = 0;       ///< Described.
  std::vector<v1::Input> held;  ///< Of whoever wants to take over.
  bool taken_over = false;      ///< With what was held; its new owner has said nothing since.

  std::set<std::uint32_t> chunks_changed;  ///< Clearance samples to publish.
  std::uint64_t states = 0;                ///< Accepted, in all runs.
  std::uint64_t rejected = 0;              ///< Likewise.

  /// Whether `agent` of `slot` exists under exactly this generation.
  static bool Describes(const Slot& slot, std::uint32_t generation) {
    return slot.agent && slot.agent->generation == generation;
  }

  detection::AgentId IdOf(std::uint32_t slot, std::uint32_t generation) const {
    return {.simulator = id, .slot = slot, .run = run, .generation = generation};
  }

  /// Gone for good: it said so by removing all its agents, or never described any.
  bool has_left() const { return !alive && agents == 0; }

  /// Whether the world's time waits for it.
  bool holds_time() const { return clock.has_value() && !released && !has_left(); }

  /// Takes a clock that has arrived; it comes into force with TakeClock().
  void OfferClock(const PendingClock& offered);

  /// Brings the newest clock into force of which everything written before it has arrived. False:
  /// none.
  bool TakeClock();

  /// Everything of the former run goes; the slots' agents must have been removed from the detector.
  void StartRun(std::uint64_t new_sender, std::uint32_t new_run);
};

/// Slots per clearance sample; chunk 0 always exists.
inline constexpr std::uint32_t kSlotsPerChunk = 64;

}  // namespace collision::server
