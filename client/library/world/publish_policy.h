// Which of an agent's states are sent, and when.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "client/library/world/contract.h"
#include "collision/types.h"
#include "idl/limits.h"

namespace collision::client {

/// States of an agent that each sample carries beside its newest one, if they fit.
inline constexpr std::size_t kCarriedMax = wire::kStatesPerChunkMax;

/// How a simulator publishes the states that its agents are set to.
struct PublishPolicy {
  bool on_demand = false;    ///< Send only the states that the service needs; false: all.
  std::int64_t lead_ns = 0;  ///< Send a state this long before the service wants it.
  std::uint32_t chunk_size = wire::kStatesPerChunkMax;  ///< Slots per sample of agent_states.
  bool wall_clock = false;  ///< Stamps may go back: the clock that they come from may be set.
};

/// The states of one agent on their way to the service: one staged, one sent, and those before
/// either that count as well: the first, a jump, and either end of a motion that breaks the agent's
/// bounds. The network keeps the newest sample only, so each sample carries those again, and the
/// same states reach the service whatever it loses.
///
/// A staged state is *due* when the clock has reached its stamp and one of these holds:
///  - it *must* be sent: no earlier state stands in for it (contract.h), one before it counts, or
///    the agent was described anew since; and it stays due until the service has acknowledged it,
///    since a refused jump would mislead every other agent;
///  - the service wants a state at every step, or has not said yet when it wants one;
///  - the service wants one (Clearance::state_wanted_ns, less the lead) before the next state could
///    be sent, one period of the agent later.
/// Otherwise it stays staged until a newer state replaces it, or until the service wants it after
/// all. Book-keeping only: neither clock nor network.
class OutgoingStates {
 public:
  /// A jump that was staged stays recorded when a later state replaces it. Throws
  /// std::invalid_argument if the stamp lies before that of the state sent last; in real time
  /// such a state is dropped.
  void Stage(const State& state, const MotionBounds& bounds, const PublishPolicy& policy);

  /// The agent leaves at `clock_ns`: the newest state that it has reached is sent next, again if it
  /// was sent, and expires then. In lock-step others may get much farther before the service takes
  /// the removal. Requires a sent state.
  void StageLast(std::int64_t clock_ns);

  const std::optional<State>& staged() const { return staged_; }
  const std::optional<State>& sent() const { return sent_; }
  std::uint64_t sent_sequence() const { return sent_sequence_; }

  /// States before the one sent last that count as well and that the service has not acknowledged,
  /// oldest first; at most kCarriedMax, beyond which the oldest is forgotten. The next one is no
  /// jump any more then: what lies between is a breach, of which nobody may say what it met.
  struct Carried {
    State state;
    std::uint64_t sequence = 0;
  };
  const std::vector<Carried>& carried() const { return carried_; }

  /// Stamp of the oldest jump on its way: sent, and not acknowledged. Of an agent of which the
  /// service has acknowledged nothing only one of the last second counts: it may never be admitted.
  std::optional<std::int64_t> JumpOnItsWay(std::int64_t clock_ns) const;

  /// Whether a jump will be sent next. Requires a staged state.
  bool StagedJumps() const;

  /// Requires a staged state. `revision` is that of the agent's description.
  bool IsDue(std::int64_t clock_ns, std::uint32_t revision, const PublishPolicy& policy) const;

  /// The staged state is sent now, and before it those that it would have replaced but that count.
  /// Each takes the next number of its simulator: `sequence` is the last one used, and becomes so.
  void MarkSent(std::uint64_t* sequence, std::uint32_t revision);

  /// The service has forgotten what was sent, and says nothing about the agent any more.
  void ForgetSent();

  /// Another service is in force, which has acknowledged nothing.
  void BeginService() { answered_ = false; }

  /// A clearance as of the service's time `now_ns`; `acknowledged`: the newest sequence in force.
  void SetClearance(const Clearance& clearance, std::uint64_t acknowledged, std::int64_t now_ns);

  const Clearance& clearance() const { return clearance_; }

 private:
  bool MustBeSent(std::uint32_t revision) const;
  void Carry(const State& state, std::uint64_t sequence);

  std::optional<State> staged_;
  std::optional<State> sent_;
  bool stands_in_ = false;      ///< `sent_` stands in for `staged_`.
  bool staged_counts_ = false;  ///< It is an end of a motion that breaks the bounds.
  bool sent_counts_ = false;    ///< Likewise, or a jump, or the first.
  std::uint64_t sent_sequence_ = 0;
  std::uint32_t sent_revision_ = 0;   ///< Of the description, when `sent_` was sent.
  std::vector<State> staged_before_;  ///< They count, and are sent with the staged one.
  std::vector<Carried> carried_;
  std::uint64_t must_sequence_ = 0;  ///< Of the last state that had to be sent, wanted or not.
  std::int64_t period_ns_ = 0;       ///< Between the last two stamps that were set.
  Clearance clearance_;
  bool wanted_always_ = true;  ///< At every step; so until the service says otherwise.
  std::uint64_t acknowledged_ = 0;
  bool answered_ = false;  ///< The service in force has acknowledged a state.
};

}  // namespace collision::client
