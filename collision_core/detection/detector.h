// The one façade of the core: states in, clearances and collision events out.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "collision_core/broad_phase/adaptive_broad_phase.h"
#include "collision_core/detection/collision_event.h"
#include "collision_core/motion/contract.h"
#include "collision_core/motion/motion_state.h"

namespace collision::detection {

/// Every bound of the detector, with what happens at it.
struct DetectorOptions {
  double temporal_resolution = 1.0 / 60;  ///< Δt [s]: nearer than this a pair could overlap.
  double announce_within = 2.0;  ///< A meeting this near [s] is announced; >= temporal_resolution.
  double skew = 0;               ///< κ [s] between any sender's clock and ours.
  std::uint32_t agents_max = 1000;          ///< Admit() refuses beyond.
  std::uint32_t pairs_max = 65536;          ///< Tracked at once; beyond, both agents are saturated.
  std::uint32_t pairs_per_agent_max = 256;  ///< Likewise for one agent.
  std::uint32_t history_max =
      64;  ///< States kept for judging; beyond, the oldest go and brackets widen.
  /// WorkBudget that the narrow phase may spend on two shapes in one turn (narrow_phase/work.h); beyond,
  /// brackets stay wider and say that the budget limited them.
  std::uint64_t work_units_per_turn = 40000;
  /// Likewise in one step on all pairs with shapes, shared out among those whose turn it is
  /// (detection/work_shares.h): pairs that were announced and wait for a verdict count more, and what
  /// one leaves goes to the next. Who leaves or expires is judged a last time beside it. 0: no limit
  /// but each turn's.
  std::uint64_t work_units_per_step = 0;
  /// The method that finds who may meet; changes what it costs, never what is told.
  broad_phase::BroadPhaseMethod broad_phase = broad_phase::BroadPhaseMethod::kAuto;
};

/// Why a clearance was lowered.
enum class ClearanceCause { kNone, kAdmission, kTeleport, kBreach, kWidening, kSkew };

/// What one agent may rely on.
struct AgentClearance {
  AgentId agent{};
  Instant clear_until = Instant::Never();  ///< No new contact begins before.
  bool not_clear = false;                  ///< It has come: something may touch.
  bool in_contact = false;                 ///< A contact is confirmed and has not ended.
  bool saturated = false;                  ///< More partners than are tracked for one agent.
  /// Until then it meets nobody but those with whom a meeting is announced; >= clear_until.
  Instant unannounced_until = Instant::Never();
  /// A contact, or a doubt, is over since then, and a state newer than that tells more of it;
  /// Always(): none.
  Instant unsettled_until = Instant::Always();
  Instant effective_from =
      Instant::Always();  ///< Promises count the latest admission, jump or widening from here.
  ClearanceCause cause = ClearanceCause::kNone;  ///< Of the last lowering.
  AgentId cause_agent{};
  Instant void_from = Instant::Never();  ///< With kBreach: earlier promises are void from here.
};

/// What became of a state.
enum class UpdateOutcome {
  kKept,      ///< Inside what was promised: standing answers stay valid.
  kJumped,    ///< A declared discontinuity: asked anew.
  kWidened,   ///< Promises less than before: asked anew.
  kBreached,  ///< Broke its bound: the new truth, asked anew, partners told.
  kOlder,     ///< Not newer than the newest known: dropped.
  kUnknown    ///< No such agent: dropped.
};

/// The earliest possible intersection over all agents that are not in contact.
struct EarliestAnswer {
  bool found = false;
  Instant earliest = Instant::Never();
  AgentId lower;
  AgentId higher;
};

/// Counted work and occurrences since the start.
struct DetectorCounters {
  std::uint64_t updates_kept = 0, jumps = 0, widenings = 0, breaches = 0;
  std::uint64_t queries = 0;       ///< Agents asked for their earliest meetings.
  std::uint64_t pair_queries = 0;  ///< Pairs given to the canonical routine.
  std::uint64_t filter_tests = 0;  ///< Pairs that the broad phase ruled out, or not, more cheaply.
  std::uint64_t broad_units = 0;   ///< All of the broad phase, in the units by which it chooses.
  std::uint64_t method_changes = 0;   ///< Times the broad phase took another method.
  std::uint64_t segments = 0;         ///< Segments judged by the narrow phase.
  std::uint64_t glances = 0;          ///< Of these: a glance was enough.
  std::uint64_t work_units = 0;       ///< Spent by the narrow phase.
  std::uint64_t turns_cut_short = 0;  ///< Pairs' turns that spent all they were allowed.
  std::uint64_t saturations = 0;
  std::uint64_t events[6] = {};  ///< Published revisions that changed the status, by EventStatus.
};

/// Holds every agent's space-time bound, keeps the earliest possible intersections current, judges
/// pairs that could overlap, and tells what follows as values. Single-threaded; knows no clock:
/// time is an argument. Same calls, same bits. The paper's loop (Hubbard 1995, section 4) kept per
/// pair: README.md.
///
/// Between two calls of Advance() any number of Admit, Update, Redeclare, Remove and Hear may come,
/// in a deterministic order; their effects show after the next Advance().
class Detector {
 public:
  explicit Detector(const DetectorOptions& options);
  ~Detector();

  /// False if `agents_max` is reached or the id is present. An agent that comes after Remove() has
  /// another id (a new generation): the former one is judged a last time beside it. `effective_from`: the greatest time
  /// granted to anybody it can meet (simulated clock), else the state's stamp.
  bool Admit(const AgentId& id, const motion::AgentDeclaration& declaration,
             const motion::MotionState& state, Instant effective_from);

  /// `effective_from` is used where the state jumps, widens or breaches.
  UpdateOutcome Update(const AgentId& id, const motion::MotionState& state, Instant effective_from);

  /// A new declaration. What widens counts at once (and is told as effective from
  /// `effective_from`); what narrows counts from the next state on. False: unknown agent.
  bool Redeclare(const AgentId& id, const motion::AgentDeclaration& declaration,
                 Instant effective_from);

  /// Open events of the agent are withdrawn (ended, where confirmed). False: unknown agent.
  bool Remove(const AgentId& id);

  /// The owner has told everything it knows of this agent up to `until`; contacts are judged up to
  /// there.
  void Hear(const AgentId& id, Instant until);

  /// Brings everything to `now` (never backward): afterwards every pair that may meet before
  /// now + announce_within is tracked, and events() holds what is new.
  void Advance(Instant now);

  /// New revisions, in the order in which they came about; valid until the next Advance().
  const std::vector<CollisionEvent>& events() const;

  /// Agents whose clearance differs from what this call returned for them last time (first: all).
  std::vector<AgentClearance> TakeChangedClearances();

  /// The clearance of one agent as of the last Advance(); nullopt: unknown.
  std::optional<AgentClearance> ClearanceOf(const AgentId& id) const;

  /// Asks again whatever could be earlier than the best answer, so that it is the canonical one.
  EarliestAnswer Earliest();

  Instant now() const;
  std::size_t agents() const;
  std::size_t pairs_tracked() const;
  /// Events that wait for their time: agents to be asked again, pairs to be judged, expiries.
  std::size_t queued() const;
  const DetectorCounters& counters() const;

  /// The broad-phase method in use, why, and what this scene does not need.
  struct Profile {
    std::string broad_phase;
    std::string why;
    std::vector<std::string> left_out;
  };
  Profile profile() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace collision::detection
