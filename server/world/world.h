// The simulators of the world, which process speaks for each of them, and what time it is.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "idl/config.pb.h"
#include "server/bus/clock.h"
#include "server/codec/codec.h"
#include "server/quotas/simulator_quotas.h"
#include "server/world/departed_agents.h"
#include "server/world/silence.h"
#include "server/world/silence/ended_runs.h"
#include "server/world/simulator.h"
#include "server/world/wall_clock/wall_time.h"
#include "server/world/wall_clock/widenings.h"

namespace collision::server {

/// How long the end of a simulator is not believed after the service itself has stood still [ns]:
/// one that lives tells its clock again within half a second.
inline constexpr std::int64_t kWakingTime = 1'000'000'000;

/// Whether a sender may speak for a simulator id.
struct Claim {
  Simulator* simulator = nullptr;  ///< The one that the id names; null: there is none.
  bool accepted = false;
  bool unproven = false;  ///< Neither accepted nor refused: it would be, had it a name.
  bool new_run = false;   ///< Accepted, and a run begins: remove its agents, then StartRun().
  v1::RejectionReason reason = v1::REJECTED_ID_OWNED;  ///< Unless accepted.
  std::string detail = {};
};

/// The owner of all simulators, and the world's time. Pure bookkeeping: no bus, no detector, no
/// log. One thread.
///
/// **Ownership.** An id belongs to the first sender that names itself, in a description or a clock;
/// states alone prove nothing and make no simulator. Another sender is refused until the owner is
/// gone *and* the other one's run is higher. A successor that writes earlier is refused
/// (Contenders) and writes again when the simulator's report says that the owner is gone. A
/// simulator has left when its process is gone and it has no agents; it makes room for another one.
///
/// **Now.** Simulated clock: it begins with the least first clock, once `simulators_awaited` have
/// one, and goes on in rounds. All that hold time are granted the same time, and when each has told
/// everything up to it, the round is over: now is the end of it. So when the world's time moves,
/// and what is known by then, follows from the simulators alone. While one of them does not say
/// when its next step is, now is the least clock as it arrives, which is as safe but depends on the
/// network. A silent simulator holds time for ever (WAIT) or for `release_after_s` (RELEASE); its
/// agents stay, and their bounds grow. Wall clock: what it shows (WallTime).
///
/// **Epochs** (simulated clock). When nobody holds time any more, the epoch is over: agents that
/// were left behind are gone, and the next simulator's first clock begins another one, at whatever
/// time it names up to `first_clock_max_s`. A dead simulator whose successor waits holds no time
/// here, and the epoch is over, too, when the only one that holds time is dead and starts again.
/// One that starts again beside others holds time where its former run stood, until it has told a
/// clock of its own. Wall clock: a step of it that breaks the time begins another epoch at once;
/// simulators and the descriptions of their agents stay.
///
/// **Grants** (simulated clock). All may run until the least `clear_until` of all agents, at least
/// to now + `temporal_resolution_s`, at most to now + `grant_ahead_max_s`; a grant is never
/// withdrawn. A simulator whose first clock is not the start of a run was granted time by a
/// service before this one: it is believed up to that clock + `grant_ahead_max_s`. Before its
/// first grant a simulator may be ahead of now, or of its first clock, by `grant_ahead_max_s`.
class World {
 public:
  /// `roster`: whom a service before this one served.
  explicit World(const v1::Config& config, const std::vector<JournalledSimulator>& roster = {});

  /// `name`: as in a description or clock, already checked against the id; null for messages
  /// without one. Only a named message makes a simulator, or takes over the id of one that is gone.
  Claim ClaimFor(std::uint64_t id, std::uint64_t sender, std::uint32_t run,
                 const std::string* name);

  /// A run follows the one in force, whose agents have been removed. `held`: before that, the
  /// simulator held time. Then the world waits for the first clock of the new run, too.
  void StartRun(Simulator* simulator, std::uint64_t sender, std::uint32_t run, bool held);

  /// Null: unknown.
  Simulator* Find(std::uint64_t id);

  /// What its simulators may have of the limits of the world. A simulator that has left is
  /// guaranteed nothing: call UpdateQuotas() once a step, after the inputs.
  SimulatorQuotas& quotas() { return quotas_; }
  const SimulatorQuotas& quotas() const { return quotas_; }
  void UpdateQuotas();

  /// Those that have left, and since the last call made room for others and did not come back.
  std::vector<std::uint64_t> TakeForgotten();

  std::map<std::uint64_t, Simulator>& simulators() { return simulators_; }
  const std::map<std::uint64_t, Simulator>& simulators() const { return simulators_; }

  /// The daemon's clocks at this step. With a wall clock this moves `now`, and returns the step of
  /// the clock, if it was set. One that breaks the time needs BeginEpoch().
  std::optional<ClockStep> SetReading(const ClockReading& reading);

  /// Simulated clock: a simulator that has no clock asks what time it is. The answer is a grant:
  /// the greatest so far, or 0 before time has begun; time waits for its first clock there, unless
  /// it `finishes`: no step of it follows after all.
  void Join(Simulator* simulator, bool finishes);

  /// Simulated clock: each simulator that holds time says when its next step is.
  bool RunsInRounds() const;

  /// Simulated clock: the time to which now may go, as far as clocks are in force; nullopt: it has
  /// to wait. In rounds it is the end of the round, or the start.
  std::optional<Instant> NextNow() const;

  /// In rounds: nobody has a further step, and the last round has been judged.
  bool HasNoRoundLeft() const;

  /// Simulated clock, before time begins: how many simulators it still waits for beside those that
  /// are there (`simulators_awaited`); 0 if none is there.
  std::size_t SimulatorsToCome() const;

  /// Simulated clock: now moves there.
  void MoveTo(Instant next);

  /// Moves to NextNow(), if there is one.
  void MoveOn();

  /// What this agent is called, or was before it left; null: not known any more.
  std::shared_ptr<const v1::AgentLabel> LabelOf(const detection::AgentId& id) const;
  DepartedAgents& departed() { return departed_; }
  const DepartedAgents& departed() const { return departed_; }

  /// Who is silent, stands or is missing, and what follows.
  Silence& silence() { return silence_; }
  const Silence& silence() const { return silence_; }

  /// Simulated clock: takes note of who has moved in this step; simulators that have been silent or
  /// have stood for `release_after_s` then hold time no longer. Returns the names of those released
  /// now. Call it once a step, after the inputs.
  std::vector<std::string> ReleaseSilent();

  /// The simulators that have been silent for `remove_silent_after_s`. None while this service
  /// stands by: it may be the only one that does not hear them, and the one in force says whom it
  /// has removed.
  std::vector<std::uint64_t> Overdue() const;

  /// The process of the service has stood still until now. It has not heard anybody meanwhile:
  /// before kWakingTime is over nobody is released or removed, and the end of a simulator whose
  /// name another program waits for is not believed.
  void WakeUp() { woke_ns_ = monotonic_ns(); }
  bool IsWaking() const { return woke_ns_ && monotonic_ns() - *woke_ns_ < kWakingTime; }

  /// Simulated clock: whom the world's time waits for.
  std::vector<Awaited> Waited() const;

  /// Ends the run of a simulator: nothing more is taken of it. Requires that its agents have been
  /// removed.
  void EndRun(Simulator* simulator, EndCause cause);
  const EndedRuns& ended_runs() const { return ended_runs_; }
  EndedRuns& ended_runs() { return ended_runs_; }

  /// Simulated clock: it has begun, and nobody holds time any more. Call it before successors take
  /// over.
  bool EpochIsOver() const;

  /// Simulated clock: the only one that holds time is dead, and a named message of this sender
  /// begins its next run. Nobody is left who knows this time: the epoch is over before that run.
  bool SucceedsLast(std::uint64_t id, std::uint64_t sender, std::uint32_t run) const;

  /// Brings `now` to the greatest clock in force: all that was told of this epoch counts.
  void FinishEpoch();

  /// Simulated clock: there is no `now` until the next first clock. Requires that the agents of the
  /// simulators that leave (LeavesWithEpoch()) have been removed. Wall clock: now is what the clock
  /// shows. Requires that no agent is admitted.
  void BeginEpoch();

  /// Whether it was in the epoch that is over. Who has no clock yet comes to the next one.
  static bool LeavesWithEpoch(const Simulator& simulator) {
    return simulator.time().clock().has_value() || !simulator.alive();
  }

  std::uint32_t epoch() const { return epoch_; }  ///< From 1.

  /// The service that serves this world is in this epoch. Requires that nothing was detected in
  /// ours. True: ours was a lower one.
  bool FollowEpoch(std::uint32_t epoch);

  bool simulated() const { return simulated_; }
  bool started() const { return started_; }  ///< There is a `now`; nothing happens before.
  Instant now() const { return now_; }
  std::int64_t monotonic_ns() const { return reading_.monotonic_ns; }

  /// Another service serves this world, and this one stands by: simulators follow the grants of
  /// that one.
  void StandBy();

  bool stands_by() const { return stands_by_; }

  /// Another service has granted so much in this epoch, as its status says.
  void HearGranted(Instant granted) {
    if (simulated_) heard_granted_ = std::max(heard_granted_, granted);
  }

  /// As a standby, once it knows all that the service in force knows: that one has told what
  /// lowered clearances so far. What this one believes of before may be wrong, since a jump that
  /// the other one has acknowledged is not written again.
  void ForgetLowerings();

  /// A replay: the recorded service has granted so much, and its simulators act on it. Where the
  /// replay begins with the recording this changes nothing.
  void FollowGrant(std::optional<std::int64_t> granted_ns) {
    if (!simulated_ || !granted_ns || *granted_ns <= granted_.nanoseconds()) return;
    granted_ = Instant::FromNanoseconds(*granted_ns);
    GrantToAll();
  }

  /// A clock of this simulator has come that is taken in a later round (SimulatorTime::Hear()): the
  /// service in force has granted it.
  void HearClock(Simulator* simulator, Instant clock, Instant until);

  /// It stands by, or has taken over, and time has not begun here: it does not before Begin(),
  /// since simulators may be there that hold time and of which this service has not heard yet.
  bool awaits_others() const { return simulated_ && awaits_others_ && !started_; }
  void Begin() { awaits_others_ = false; }

  /// This service serves from now on, in place of the one beside which it stood by. Simulated
  /// clock: time stands until each simulator that lives and holds time has told a clock that
  /// follows this service. Until then it may act on a grant of which this service has not heard;
  /// that is at most `grant_ahead_max_s` beyond the clocks, and promises count from there. What
  /// this service has computed beyond what it has heard is granted to nobody: it may not know all
  /// who hold time.
  void TakeOver();

  /// Simulators that are there and whose newest clock names this service, or none; 0 while it
  /// stands by.
  std::size_t followers() const;

  /// Agents of simulators that hold time: with their first states they are, or will be, admitted.
  /// nullopt: no simulator does.
  std::optional<std::size_t> agents_in_time() const;

  /// The latest time of which this service knows, as it stands by.
  Instant newest() const { return simulated_ ? std::max(NewestClock(), heard_granted_) : now_; }

  /// From when on promises count after a take-over, whatever is said of single agents; else
  /// Always().
  Instant promised_from() const { return promised_from_; }

  /// What a clock tells of its sender's offset; nullopt: nothing. `service_id`: of this service.
  std::optional<RoundTrip> RoundTripOf(const v1::SimulatorClock& clock,
                                       std::uint64_t service_id) const;

  StampRules RulesForState(const Simulator& simulator, bool admitted) const;
  ClockRules RulesForClock(const Simulator& simulator) const;

  /// From when on a change counts that may lower promises already given: with a simulated clock the
  /// greatest time granted to any simulator.
  Instant EffectiveFrom(Instant stamp) const;

  /// The detector has a new description of an admitted agent, which counts from EffectiveFrom() on;
  /// with a wall clock when everybody knows (Widenings).
  void AddRevision(const Widening& revision);

  /// Wall clock, after clearances were published: acknowledges the revisions that count from now
  /// on. True: there are some, and their clearances are to be published again.
  bool AcknowledgeRevisions();
  std::optional<std::int64_t> NextRevision() const { return widenings_.NextDue(); }

  /// The detector gives an agent a new clearance. Ignored if the agent is not there any more.
  void SetClearance(const detection::AgentClearance& clearance);
  /// Likewise of a level: only when states are wanted depends on it.
  void SetClearanceOfLevel(std::size_t level, const detection::AgentClearance& clearance);

  /// After all events up to now. Grants the time described above, marks the clearance samples where
  /// it has grown, and forgets the names of agents that have left by now.
  void UpdateGrants();

  /// The same with the time that is granted already, for those who have come since. A service that
  /// stands by may have computed it without them, though the one in force knew them: it is then
  /// lowered to their clocks.
  void ShareGrant();

  /// The greatest time granted in this epoch; Always(): none was.
  Instant granted() const { return granted_; }

  /// The monotonic time at which a simulator may next be named, released or removed; nullopt: none
  /// is silent or stands.
  std::optional<std::int64_t> NextRelease() const;

  /// Walks all simulators and checks what must hold, with CORE_CHECK. For tests and debug builds.
  void Validate() const;

 private:
  /// What the clocks in force of all who hold time tell, as far as they have one.
  struct Told {
    Instant until = Instant::Never();  ///< Everything up to here; Never(): no step follows.
    Instant first = Instant::Never();  ///< The earliest clock; Never(): there is none.
    Instant last = Instant::Always();  ///< The latest one.
  };
  Told ToldByAll() const;
  bool HasNothingAhead(const Told& told) const;

  bool HasRoomFor(std::uint64_t id) const;
  Simulator* Add(std::uint64_t id, std::uint64_t sender, std::uint32_t run,
                 const std::string& name);
  Claim ClaimForNew(std::uint64_t id, std::uint64_t sender, std::uint32_t run,
                    const std::string* name);
  Instant LatestAllowed(const Simulator& simulator) const;
  bool HasBegun() const;
  void BeginWallEpoch();
  Instant NewestClock() const;
  void RaiseInheritedGrant();
  void GrantToAll();
  void LowerGrant(Instant until);

  const bool simulated_;
  const double skew_;
  const double grant_ahead_max_;
  const double temporal_resolution_;
  const Instant first_clock_max_;
  const std::size_t simulators_awaited_;
  const std::size_t simulators_max_;
  const std::set<std::uint64_t> expected_;  ///< Ids whose names the configuration has.

  std::map<std::uint64_t, Simulator> simulators_;
  std::vector<std::uint64_t> forgotten_;
  SimulatorQuotas quotas_;
  Silence silence_;
  EndedRuns ended_runs_;
  DepartedAgents departed_;
  std::uint32_t epoch_ = 1;
  bool started_ = false;
  Instant now_;
  Instant granted_ = Instant::Always();
  ClockReading reading_;
  WallTime wall_time_;
  Widenings widenings_;
  std::optional<std::int64_t> woke_ns_;
  bool stands_by_ = false;
  bool awaits_others_ = false;
  Instant heard_granted_ = Instant::Always();  ///< By another service.
  Instant promised_from_ = Instant::Always();
};

/// Seconds of a configuration, as nanoseconds.
std::int64_t ToNanoseconds(double seconds);

}  // namespace collision::server
