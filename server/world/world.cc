#include "server/world/world.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "collision_core/base/check.h"
#include "collision_core/numeric/seconds.h"

namespace collision::server {

std::int64_t ToNanoseconds(double seconds) {
  return static_cast<std::int64_t>(std::llround(seconds * 1e9));
}

World::World(const v1::Config& config, const std::vector<JournalledSimulator>& roster)
    : simulated_(config.clock().kind() != v1::Clock::REAL_TIME),
      skew_(config.clock().skew_max_s()),
      grant_ahead_max_(config.clock().grant_ahead_max_s()),
      temporal_resolution_(config.temporal_resolution_s()),
      first_clock_max_(Instant::FromNanoseconds(ToNanoseconds(config.clock().first_clock_max_s()))),
      simulators_awaited_(config.clock().simulators_awaited()),
      simulators_max_(config.simulators_max()),
      expected_(ExpectedIds(config)),
      quotas_(config),
      silence_(config, roster),
      wall_time_(ToNanoseconds(config.clock().skew_max_s())),
      // Two clients' clocks may differ by twice the skew.
      widenings_(wire::kServiceLease + 2 * ToNanoseconds(config.clock().skew_max_s())) {}

Simulator* World::Find(std::uint64_t id) {
  const auto found = simulators_.find(id);
  return found == simulators_.end() ? nullptr : &found->second;
}

std::vector<std::uint64_t> World::TakeForgotten() {
  std::vector<std::uint64_t> forgotten = std::exchange(forgotten_, {});
  std::erase_if(forgotten, [this](std::uint64_t id) { return simulators_.contains(id); });
  return forgotten;
}

/// A simulator whose name is in the configuration has a place, whether it is there or not.
bool World::HasRoomFor(std::uint64_t id) const {
  const auto absent = std::count_if(expected_.begin(), expected_.end(), [&](std::uint64_t one) {
    return one != id && !simulators_.contains(one);
  });
  return simulators_.size() + static_cast<std::size_t>(absent) < simulators_max_;
}

/// In place of one that has left, if there is no room. Null: none has.
Simulator* World::Add(std::uint64_t id, std::uint64_t sender, std::uint32_t run,
                      const std::string& name) {
  while (!HasRoomFor(id)) {
    const auto left = std::find_if(simulators_.begin(), simulators_.end(), [](const auto& one) {
      return one.second.has_left() && one.second.contenders().empty();
    });
    if (left == simulators_.end()) return nullptr;
    forgotten_.push_back(left->first);
    simulators_.erase(left);
  }
  quotas_.Enter(id, name);
  return &simulators_.try_emplace(id, id, sender, run, name).first->second;
}

Claim World::ClaimFor(std::uint64_t id, std::uint64_t sender, std::uint32_t run,
                      const std::string* name) {
  Claim claim{.simulator = Find(id)};
  auto refusal = ended_runs_.Refusal(id, run);
  if (!refusal) refusal = silence_.roster().Refusal(id, run);
  if (refusal) {
    claim.reason = v1::REJECTED_OLD_RUN;
    claim.detail = *refusal;
    return claim;
  }
  if (claim.simulator == nullptr) return ClaimForNew(id, sender, run, name);
  Simulator& simulator = *claim.simulator;
  const bool owns = simulator.sender() == sender;
  const bool succeeds = !owns && !simulator.alive() && run > simulator.run();
  claim.unproven = succeeds && name == nullptr;
  claim.accepted = owns ? run >= simulator.run() : succeeds && name != nullptr;
  claim.new_run = claim.accepted && run > simulator.run();
  if (owns) claim.reason = v1::REJECTED_OLD_RUN;
  if (!claim.accepted) {
    claim.detail = "run " + std::to_string(run) + "; in force: run " +
                   std::to_string(simulator.run()) + (owns ? "" : " of another sender") +
                   (simulator.alive() ? "" : ", gone; allowed: a higher run");
  }
  return claim;
}

Claim World::ClaimForNew(std::uint64_t id, std::uint64_t sender, std::uint32_t run,
                         const std::string* name) {
  if (name == nullptr) return {.unproven = true};
  Claim claim{.simulator = Add(id, sender, run, *name)};
  claim.accepted = claim.simulator != nullptr;
  if (claim.accepted) return claim;
  claim.reason = v1::REJECTED_TOO_MANY_SIMULATORS;
  claim.detail = "the world has " + std::to_string(simulators_.size()) +
                 " simulators; allowed: at most " + std::to_string(simulators_max_);
  return claim;
}

void World::UpdateQuotas() {
  for (const auto& [id, simulator] : simulators_) {
    if (!simulator.has_left()) quotas_.Enter(id, simulator.name());
  }
  quotas_.Keep([this](std::uint64_t id) {
    const auto found = simulators_.find(id);
    return found != simulators_.end() && !found->second.has_left();
  });
}

std::optional<ClockStep> World::SetReading(const ClockReading& reading) {
  reading_ = reading;
  if (simulated_) return std::nullopt;
  const std::optional<ClockStep> step = wall_time_.Take(reading);
  started_ = true;
  now_ = wall_time_.now();
  if (!step) return std::nullopt;
  for (auto& [id, simulator] : simulators_) simulator.sender_clock().Forget();
  return step;
}

std::optional<RoundTrip> World::RoundTripOf(const v1::SimulatorClock& clock,
                                            std::uint64_t service_id) const {
  const auto is_instant = [](std::int64_t ns) { return 0 < ns && ns <= wire::kInstantMax; };
  if (simulated_ || !is_instant(clock.sent_ns())) return std::nullopt;
  RoundTrip trip;
  trip.answered = Instant::FromNanoseconds(clock.sent_ns());
  trip.arrived = wall_time_.reading();
  // An echo counts if it is of a sample on the present time scale.
  const Instant echo = Instant::FromNanoseconds(clock.echo_ns());
  if (clock.service_id() == service_id && clock.epoch() == epoch_ && is_instant(clock.echo_ns()) &&
      is_instant(clock.heard_ns()) && echo > wall_time_.echoes_after() && echo <= now_) {
    // `now` may be ahead of the clock by what two readings of it differ.
    trip.asked = Instant::FromNanoseconds(clock.echo_ns() - kReadingErrorNs);
    trip.heard = Instant::FromNanoseconds(clock.heard_ns());
  }
  return trip;
}

void World::Join(Simulator* simulator, bool finishes) {
  SimulatorTime& time = simulator->time();
  if (time.awaits_own_clock()) {
    if (finishes) time.Join(time.newest(), true);
    return;
  }
  if (finishes || time.newest() != Instant::Always()) return;
  const Instant granted = std::max(granted_, silence_.roster().greatest_grant());
  time.Join(std::max(granted, started_ ? now_ : Instant()), false);
  simulator->Resume();
  simulator->agents().clearances().MarkGrantChanged();
}

bool World::RunsInRounds() const {
  return simulated_ && std::all_of(simulators_.begin(), simulators_.end(), [](const auto& one) {
           return !one.second.holds_time() || one.second.time().tells_next();
         });
}

/// Time that a service before this one granted has begun already, with all that were awaited.
bool World::HasBegun() const {
  return started_ || silence_.roster().greatest_grant() != Instant::Always() ||
         heard_granted_ != Instant::Always();
}

std::size_t World::SimulatorsToCome() const {
  if (!simulated_ || HasBegun()) return 0;
  const auto with_clock = static_cast<std::size_t>(
      std::count_if(simulators_.begin(), simulators_.end(),
                    [](const auto& one) { return one.second.time().clock().has_value(); }));
  return with_clock == 0 ? 0 : simulators_awaited_ - std::min(simulators_awaited_, with_clock);
}

World::Told World::ToldByAll() const {
  Told all;
  for (const auto& [id, simulator] : simulators_) {
    const SimulatorTime& time = simulator.time();
    const std::optional<Instant> clock = time.stands_at();
    if (!clock) continue;
    // Who has finished and left is not waited for, but its last round counts.
    if (!simulator.holds_time() && (simulator.released() || !time.has_finished())) continue;
    all.until = std::min(all.until, time.told_until());
    all.first = std::min(all.first, *clock);
    all.last = std::max(all.last, *clock);
  }
  return all;
}

std::optional<Instant> World::NextNow() const {
  const Told told = ToldByAll();
  if (told.first.is_never() || !silence_.roster().complete()) return std::nullopt;
  if (!started_) {
    if (SimulatorsToCome() > 0 || awaits_others()) return std::nullopt;
    return told.until >= told.first ? std::optional(told.first) : std::nullopt;
  }
  if (!RunsInRounds()) return std::max(now_, told.first);
  // Of those who have no further step the last round is still to be judged.
  if (told.until < granted_ || HasNothingAhead(told)) return std::nullopt;
  return granted_ > now_ ? std::optional(granted_) : std::nullopt;
}

bool World::HasNothingAhead(const Told& told) const {
  return !told.first.is_never() && told.until.is_never() && told.last <= now_;
}

bool World::HasNoRoundLeft() const {
  return started_ && RunsInRounds() && HasNothingAhead(ToldByAll());
}

void World::MoveTo(Instant next) {
  now_ = next;
  started_ = true;
}

void World::MoveOn() {
  if (const auto next = NextNow()) MoveTo(*next);
}

std::vector<std::string> World::ReleaseSilent() {
  if (IsWaking()) return {};
  for (auto& [id, simulator] : simulators_) {
    const auto doubted_until = simulator.doubted_until_ns();
    if (doubted_until && *doubted_until <= monotonic_ns()) {
      simulator.SetAlive(false, monotonic_ns());
    }
  }
  RaiseInheritedGrant();
  silence_.Update(simulators_, monotonic_ns());
  return silence_.Release(&simulators_, monotonic_ns());
}

std::vector<Awaited> World::Waited() const { return silence_.Waited(simulators_, monotonic_ns()); }

std::vector<std::uint64_t> World::Overdue() const {
  if (stands_by_ || IsWaking()) return {};
  return silence_.Overdue(simulators_, monotonic_ns());
}

std::optional<std::int64_t> World::NextRelease() const {
  const auto due = silence_.NextDue(simulators_, !stands_by_, monotonic_ns());
  return due && woke_ns_ ? std::max(*due, *woke_ns_ + kWakingTime) : due;
}

void World::EndRun(Simulator* simulator, EndCause cause) {
  ended_runs_.Add(simulator->id(), simulator->run(), cause);
  simulator->End();
}

bool World::EpochIsOver() const {
  return simulated_ && started_ &&
         std::none_of(simulators_.begin(), simulators_.end(), [](const auto& one) {
           const bool succeeded = !one.second.alive() && one.second.contenders().has_successor();
           return one.second.holds_time() && !succeeded;
         });
}

bool World::SucceedsLast(std::uint64_t id, std::uint64_t sender, std::uint32_t run) const {
  const auto found = simulators_.find(id);
  if (!simulated_ || !started_ || IsWaking() || found == simulators_.end()) return false;
  const Simulator& former = found->second;
  if (!former.holds_time() || former.alive() || former.sender() == sender) return false;
  if (run <= former.run()) return false;
  return std::none_of(simulators_.begin(), simulators_.end(),
                      [id](const auto& one) { return one.first != id && one.second.holds_time(); });
}

void World::StartRun(Simulator* simulator, std::uint64_t sender, std::uint32_t run, bool held) {
  std::optional<PendingClock> former;
  if (simulated_ && held && HasBegun() && !simulator->time().has_finished()) {
    former = simulator->time().standing();
    // What it told of later counts no more: nobody is to go beyond what all are granted.
    if (former->next && granted_ != Instant::Always()) {
      former->next = std::min(*former->next, granted_);
    }
  }
  simulator->StartRun(sender, run, former);
}

void World::FinishEpoch() {
  for (const auto& [id, simulator] : simulators_) {
    now_ = std::max(now_, simulator.time().clock().value_or(now_));
  }
}

std::shared_ptr<const v1::AgentLabel> World::LabelOf(const detection::AgentId& id) const {
  const auto simulator = simulators_.find(id.simulator);
  if (simulator != simulators_.end() && simulator->second.run() == id.run) {
    const Agent* agent = simulator->second.agents().Find(id.slot, id.generation);
    if (agent != nullptr) return agent->label;
  }
  return departed_.Find(id);
}

void World::BeginEpoch() {
  departed_.Clear();
  if (!simulated_) return BeginWallEpoch();
  for (auto& [id, simulator] : simulators_) {
    if (LeavesWithEpoch(simulator)) simulator.LeaveEpoch();
    simulator.time().ForgetFormer();
  }
  silence_.roster().Forget();
  ++epoch_;
  started_ = false;
  now_ = Instant();
  granted_ = heard_granted_ = promised_from_ = Instant::Always();
}

bool World::FollowEpoch(std::uint32_t epoch) {
  const bool is_higher = epoch > epoch_;
  epoch_ = std::max(epoch_, epoch);
  return is_higher;
}

void World::BeginWallEpoch() {
  for (auto& [id, simulator] : simulators_) simulator.RestartTime();
  widenings_.Clear();
  ++epoch_;
  wall_time_.Restart();
  now_ = wall_time_.now();
}

Instant World::LatestAllowed(const Simulator& simulator) const {
  if (!simulated_) return numeric::AddRoundedDown(wall_time_.reading(), skew_);
  // Another service, which it still follows, may have granted it more than this one has heard of.
  if (simulator.is_inherited()) return Instant::Never();
  const SimulatorTime& time = simulator.time();
  const bool waits = time.lock_step() && time.granted();
  if (!started_ && !waits && !time.first_clock()) return first_clock_max_;
  Instant latest = time.granted().value_or(Instant::Always());
  if (started_ && !waits)
    latest = std::max(latest, numeric::AddRoundedDown(now_, grant_ahead_max_));
  // A clock that does not begin at the run's start was granted by a service before this one.
  if (time.first_clock() && (!waits || (*time.first_clock() > Instant() && !time.joined()))) {
    latest = std::max(latest, numeric::AddRoundedDown(*time.first_clock(), grant_ahead_max_));
  }
  if (stands_by_) {
    const Instant told = std::max({time.newest(), heard_granted_, started_ ? now_ : Instant()});
    latest = std::max(latest, numeric::AddRoundedDown(told, grant_ahead_max_));
  }
  return std::max(latest, promised_from_);
}

StampRules World::RulesForState(const Simulator& simulator, bool admitted) const {
  // Beside the service in force, which judges it: its clocks may come later than its states.
  const bool judged_elsewhere = simulated_ && stands_by_;
  StampRules rules{.earliest = wall_time_.earliest_stamp(),
                   .latest = judged_elsewhere ? Instant::Never() : LatestAllowed(simulator)};
  const std::optional<Instant>& clock = simulator.time().clock();
  if (admitted && clock) rules.discontinuity_from = *clock;
  return rules;
}

ClockRules World::RulesForClock(const Simulator& simulator) const {
  return {.earliest = simulator.time().newest(),
          .latest = LatestAllowed(simulator),
          .lock_step = simulated_};
}

Instant World::EffectiveFrom(Instant stamp) const {
  if (!simulated_) return now_;
  const Instant greatest = std::max(granted_, silence_.roster().greatest_grant());
  return greatest == Instant::Always() ? stamp : greatest;
}

void World::AddRevision(const Widening& revision) {
  if (!simulated_) return widenings_.Add(revision);
  Find(revision.agent.simulator)
      ->agents()
      .AcknowledgeRevision(revision.agent.slot, revision.agent.generation, revision.revision,
                           Instant::Always());
}

bool World::AcknowledgeRevisions() {
  if (widenings_.empty()) return false;
  std::vector<Informed> informed;
  for (const auto& [id, simulator] : simulators_) {
    const Clearances& clearances = simulator.agents().clearances();
    if (clearances.all().empty()) continue;
    informed.push_back(
        {id, clearances.lowerings().published(), clearances.lowerings().acknowledged()});
  }
  const std::vector<Widening> acknowledged = widenings_.Take(informed, monotonic_ns());
  for (const auto& [agent, revision] : acknowledged) {
    Simulator* simulator = Find(agent.simulator);
    if (simulator == nullptr || simulator->run() != agent.run) continue;
    simulator->agents().AcknowledgeRevision(agent.slot, agent.generation, revision, now_);
  }
  return !acknowledged.empty();
}

void World::SetClearance(const detection::AgentClearance& clearance) {
  Simulator* simulator = Find(clearance.agent.simulator);
  if (simulator == nullptr || simulator->run() != clearance.agent.run) return;
  simulator->agents().SetClearance(clearance);
}

void World::SetClearanceOfLevel(std::size_t level, const detection::AgentClearance& clearance) {
  Simulator* simulator = Find(clearance.agent.simulator);
  if (simulator == nullptr || simulator->run() != clearance.agent.run) return;
  simulator->agents().SetClearanceOfLevel(level, clearance);
}

void World::UpdateGrants() {
  departed_.ForgetUntil(now_);
  if (!simulated_ || !started_) return;
  // In place of its former run one holds what is granted until it tells what it does.
  const bool holds = std::any_of(simulators_.begin(), simulators_.end(), [](const auto& one) {
    return one.second.holds_time() && !one.second.time().clock();
  });
  if (holds) return GrantToAll();
  Instant until = numeric::AddRoundedDown(now_, grant_ahead_max_);
  for (const auto& [id, simulator] : simulators_) {
    until = std::min(until, simulator.agents().clearances().clear_until());
  }
  // No simulator may run past the end of a contact before its states are in.
  until = std::max(until, numeric::AddRoundedDown(now_, temporal_resolution_));
  granted_ = std::max(granted_, until);
  GrantToAll();
}

void World::ShareGrant() {
  if (stands_by_ && started_) {
    for (const auto& [id, simulator] : simulators_) {
      const SimulatorTime& time = simulator.time();
      if (time.clock() && !time.granted()) LowerGrant(*time.clock());
    }
  }
  GrantToAll();
}

void World::GrantToAll() {
  if (!simulated_ || granted_ == Instant::Always()) return;
  for (auto& [id, simulator] : simulators_) {
    if (!simulator.time().clock() || !simulator.time().Grant(granted_)) continue;
    simulator.agents().clearances().MarkGrantChanged();
  }
}

void World::Validate() const {
  CORE_CHECK(simulators_.size() <= simulators_max_, "the number of simulators is bounded",
             simulators_.size(), simulators_max_);
  for (const auto& [id, simulator] : simulators_) {
    CORE_CHECK(simulator.id() == id, "a simulator stands under its own id", id, simulator.id());
    simulator.agents().Validate();
  }
}

}  // namespace collision::server
