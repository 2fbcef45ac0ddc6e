// The one façade of the core: states in, clearances and collision events out.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "collision_core/base/shared_limit.h"
#include "collision_core/detection/agents/agent_declaration.h"
#include "collision_core/detection/clearance/keys/agent_clearance.h"
#include "collision_core/detection/earliest/earliest_answer.h"
#include "collision_core/detection/events/collision_event.h"
#include "collision_core/detection/pairs/owner_work.h"
#include "collision_core/detection/step/detector_counters.h"
#include "collision_core/detection/step/detector_options.h"
#include "collision_core/motion/broken_bound.h"

namespace collision::detection {

/// An agent as a detector holds it, so that another one can admit it too.
struct HeldAgent {
  AgentId id;
  AgentDeclaration in_force;  ///< Of its newest state.
  AgentDeclaration declared;  ///< The latest: what is narrower in it counts from the next state on.
  motion::MotionState state;  ///< The newest.
  Instant heard_until;        ///< Its owner has reported everything about it up to here.
};

/// How the detector took a state.
enum class UpdateOutcome {
  kKept,      ///< The bound lies inside the last one: standing answers stay valid.
  kJumped,    ///< A declared discontinuity, or the return after an expiry: queried anew.
  kWidened,   ///< Promises less than before: the agent is queried anew.
  kBreached,  ///< Breaks the last bound: the agent is queried anew, its partners are notified.
  kOlder,     ///< Stamped before the newest known state: dropped.
  kUnknown    ///< No such agent: dropped.
};

/// Holds every agent's space-time bound, keeps the earliest possible intersections current,
/// evaluates pairs that could overlap, and returns what follows as values: events, and for each
/// agent the time until which it is certified clear. SI units, world frame, one time scale in
/// nanoseconds.
///
/// Between two calls of Advance() any number of Admit, Update, Redeclare, Remove and SetHeardUntil
/// may come, in a deterministic order; their effects show after the next Advance(). Same calls,
/// same bits, on every machine and with every broad-phase method. Values are trusted here: the
/// server refuses bad input at the edge. A broken precondition or invariant throws CheckFailure
/// (base/check.h).
///
/// Single-threaded; knows no clock: time is an argument. A step costs what has changed and what is
/// due, never a walk over all agents or pairs. An update that keeps its contract is O(1) and
/// allocates nothing. Memory: some 1 kB an agent and its states (0.3 kB each), 0.6 kB a tracked
/// pair.
///
/// Source: the loop of Hubbard, "Collision detection for interactive graphics applications", IEEE
/// TVCG 1(3), 1995, section 4, kept per agent instead of for the whole scene (README.md).
class Detector {
 public:
  explicit Detector(const DetectorOptions& options);
  Detector(Detector&&) noexcept;
  Detector& operator=(Detector&&) noexcept;
  ~Detector();

  /// False if `agents_max` is reached, HasRoomForHalfSpace() is false for one, or the id is
  /// present. An agent that comes after Remove() has another id (a new generation): the former one
  /// is evaluated a last time beside it.
  /// `effective_from`: the instant from which the clearances of other agents take account of this
  /// one. With a simulated clock it is the greatest time granted so far to any agent that this one
  /// can meet, otherwise the state's stamp.
  bool Admit(const AgentId& id, const AgentDeclaration& declaration,
             const motion::MotionState& state, Instant effective_from);

  /// `effective_from` is used where the state jumps, widens or breaches.
  UpdateOutcome Update(const AgentId& id, const motion::MotionState& state, Instant effective_from);

  /// What the newest state that breached broke, in numbers: of the last Update() that returned
  /// kBreached, which there must be. Some 30 contract checks, so a caller asks only for what it
  /// tells.
  motion::BrokenBound ExplainLastBreach() const;

  /// A new declaration. The filter and everything wider than before are in force at once
  /// (clearances report it as effective from `effective_from`); narrower limits from the next state
  /// on. False: unknown agent. Requires, like Admit(), that a shape that is awaited is null.
  bool Redeclare(const AgentId& id, const AgentDeclaration& declaration, Instant effective_from);

  /// The owner gives the agent up. Once `now` has reached the expiry of its newest state, or else
  /// the time that its owner has reported, its confirmed events end and its possible ones become
  /// undecided or withdrawn. False: unknown agent.
  bool Remove(const AgentId& id);

  /// The newest state of an agent, until the next call that is not const; null: there is no such
  /// agent, or it has expired. O(log agents).
  const motion::MotionState* StateOf(const AgentId& id) const;

  /// Calls `use` with each agent that is not removed, in an order that depends on nothing but the
  /// calls before. O(agents). `use` calls nothing of this detector.
  void ForEachAgent(const std::function<void(const HeldAgent&)>& use) const;

  /// The owner, one run of a simulator, has reported everything about its agents up to `until`:
  /// contacts are evaluated up to there. Holds for all agents of the owner, also for those admitted
  /// later; has no effect while it has none. Never goes back. O(log owners).
  /// `still_until`: it has also said that none of its agents jumps before that time, so that a
  /// contact with one that leaves by then is certain.
  void SetHeardUntil(const OwnerId& owner, Instant until, Instant still_until = Instant::Always());

  /// The owner's part of `pairs_max`; a pair of two owners counts for both. Beyond it, its agents
  /// are saturated, and so are agents of others that meet them. Has no effect while it has no
  /// agents; without this call it may have all that others are not guaranteed (SharedLimit).
  void SetPairShare(const OwnerId& owner, const Share& share);

  /// The clock of one run of a simulator turned out to be off by more than its bounds allow for, so
  /// that none of its states is believed: in the next step its agents expire, each to come back
  /// with its next state. What was promised to them, and to others about them, is void from `from`
  /// on: the clearances of these agents, and of all that can meet one of them, tell so with kSkew.
  /// O(agents) where their filters let them meet.
  void VoidOwner(const OwnerId& owner, Instant from);

  /// Brings everything to `now` (never backward): afterwards every pair that may meet before
  /// now + announce_within is tracked, and events() holds what is new. Pairs for which the step has
  /// no work left wait for the next one (pairs_waiting()).
  ///
  /// `progress`, if there is one, is called after each bounded piece of work: each query of an
  /// agent and each evaluation of a pair, so that the caller knows that a long step goes on. It may
  /// read the detector's counts and nothing else of it.
  void Advance(Instant now, const std::function<void()>& progress = nullptr);

  /// The revisions made by the last Advance(), in their order; valid until the next one.
  const std::vector<CollisionEvent>& events() const;

  /// The clearances that differ from those that this call returned last; the first call returns
  /// all.
  std::vector<AgentClearance> TakeChangedClearances();

  /// The clearance of one agent as of the last Advance(); nullopt: unknown. For callers that keep
  /// no clearances of their own; the service uses TakeChangedClearances().
  std::optional<AgentClearance> ClearanceOf(const AgentId& id) const;

  /// The canonical earliest intersection as of the last Advance(). No later event or clearance
  /// depends on whether it is called. It fills a cache of its own and counts its work, which
  /// counters() and profile() show, so two threads may not call it at the same time.
  ///
  /// At most about `queries_max` queries are made for it. Where more agents and pairs than that may
  /// be the first, as in a lattice, in which all tie, the answer is the least of the certified
  /// bounds that are known, with an agent or pair that has it: no pair intersects before. The next
  /// calls refresh these bounds in turn, the earliest first.
  EarliestAnswer Earliest(std::size_t queries_max = std::numeric_limits<std::size_t>::max()) const;

  std::size_t agents() const;
  /// Whether another half-space can be admitted: at most kHalfSpacesMax are held, those included
  /// that have left since the last step.
  bool HasRoomForHalfSpace() const;
  /// Agents that are removed and still to be evaluated up to the time that their owners reported.
  std::size_t departing() const;
  std::size_t pairs_tracked() const;
  /// Of these, pairs that wait for their evaluation since the last step's work was used up.
  std::size_t pairs_waiting() const;
  /// What the narrow phase has done for each owner that has tracked pairs.
  std::vector<OwnerWork> owner_work() const;
  /// Entries that wait for their time: agents to be queried again, pairs to be evaluated, expiries.
  std::size_t queued() const;
  const DetectorCounters& counters() const;

  /// The broad-phase method in use, why, and what this scene does without.
  struct Profile {
    std::string broad_phase;
    std::string why;
    std::vector<std::string> left_out;
  };
  Profile profile() const;

  /// Walks all structures and throws CheckFailure where an invariant does not hold. O(everything);
  /// called at the end of each Advance() in debug builds.
  void Validate() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace collision::detection
