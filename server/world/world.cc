#include "server/world/world.h"

#include <algorithm>
#include <cmath>

#include "collision_core/base/check.h"
#include "collision_core/numeric/seconds.h"

namespace collision::server {

std::int64_t ToNanoseconds(double seconds) {
  return static_cast<std::int64_t>(std::llround(seconds * 1e9));
}

World::World(const v1::Config& config)
    : simulated_(config.clock().kind() != v1::Clock::WALL),
      releases_silent_(config.clock().on_silent_simulator() == v1::Clock::RELEASE),
      skew_(config.clock().skew_max_s()),
      grant_ahead_max_(config.clock().grant_ahead_max_s()),
      temporal_resolution_(config.temporal_resolution_s()),
      first_clock_max_(Instant::FromNanoseconds(ToNanoseconds(config.clock().first_clock_max_s()))),
      release_after_ns_(ToNanoseconds(config.clock().release_after_s())),
      simulators_awaited_(config.clock().simulators_awaited()),
      simulators_max_(config.simulators_max()),
      wall_time_(ToNanoseconds(config.clock().skew_max_s())) {}

Simulator* World::Find(std::uint64_t id) {
  const auto found = simulators_.find(id);
  return found == simulators_.end() ? nullptr : &found->second;
}

/// In place of one that has left, if there is no room. Null: none has.
Simulator* World::Add(std::uint64_t id, std::uint64_t sender, std::uint32_t run) {
  if (simulators_.size() >= simulators_max_) {
    const auto left = std::find_if(simulators_.begin(), simulators_.end(), [this](const auto& one) {
      return one.second.has_left() && !succession_.IsAwaited(one.first);
    });
    if (left == simulators_.end()) return nullptr;
    simulators_.erase(left);
  }
  return &simulators_.try_emplace(id, id, sender, run).first->second;
}

Claim World::ClaimFor(std::uint64_t id, std::uint64_t sender, std::uint32_t run,
                      const std::string* name) {
  Claim claim{.simulator = Find(id)};
  if (claim.simulator == nullptr) claim.simulator = Add(id, sender, run);
  if (claim.simulator == nullptr) {
    claim.reason = v1::REJECTED_TOO_MANY_SIMULATORS;
    claim.detail = "the world has " + std::to_string(simulators_.size()) +
                   " simulators; allowed: at most " + std::to_string(simulators_max_);
    return claim;
  }
  Simulator& simulator = *claim.simulator;
  const bool owns = simulator.sender() == sender;
  const bool proves = name != nullptr && simulator.name().empty();
  if (owns) {
    claim.accepted = run >= simulator.run();
    claim.new_run = run > simulator.run();
    claim.reason = v1::REJECTED_OLD_RUN;
  } else {
    claim.accepted = claim.new_run = proves || (!simulator.alive() && run > simulator.run());
    claim.may_wait = !claim.accepted && simulator.alive() && run > simulator.run();
  }
  if (!claim.accepted) {
    claim.detail = "run " + std::to_string(run) + "; in force: run " +
                   std::to_string(simulator.run()) + (owns ? "" : " of another sender") +
                   (simulator.alive() ? "" : ", gone; allowed: a higher run");
  } else if (proves) {
    simulator.SetName(*name);
  }
  return claim;
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
  RoundTrip trip{.answered = Instant::FromNanoseconds(clock.sent_ns()),
                 .arrived = wall_time_.reading()};
  // An echo counts if it is of a sample on the present time scale.
  const Instant echo = Instant::FromNanoseconds(clock.echo_ns());
  if (clock.echo_service_id() == service_id && clock.echo_epoch() == epoch_ &&
      is_instant(clock.echo_ns()) && is_instant(clock.heard_ns()) &&
      echo > wall_time_.echoes_after() && echo <= now_) {
    // `now` may be ahead of the clock by what two readings of it differ.
    trip.asked = Instant::FromNanoseconds(clock.echo_ns() - kReadingErrorNs);
    trip.heard = Instant::FromNanoseconds(clock.heard_ns());
  }
  return trip;
}

void World::UpdateSimulatedTime() {
  if (!simulated_) return;
  std::size_t with_clock = 0;
  Instant least = Instant::Never();
  for (const auto& [id, simulator] : simulators_) {
    if (simulator.time().clock()) ++with_clock;
    if (simulator.holds_time()) least = std::min(least, *simulator.time().clock());
  }
  if (least.is_never() || (!started_ && with_clock < simulators_awaited_)) return;
  now_ = started_ ? std::max(now_, least) : least;
  started_ = true;
}

std::vector<std::string> World::ReleaseSilent() {
  std::vector<std::string> released;
  if (!simulated_ || !releases_silent_) return released;
  for (auto& [id, simulator] : simulators_) {
    if (simulator.alive() || !simulator.holds_time()) continue;
    if (monotonic_ns() - simulator.silent_since_ns() < release_after_ns_) continue;
    simulator.Release();
    released.push_back(simulator.name());
  }
  return released;
}

std::vector<std::string> World::WaitedFor() const {
  std::vector<std::string> names;
  if (!simulated_) return names;
  for (const auto& [id, simulator] : simulators_) {
    if (!simulator.alive() && simulator.holds_time()) names.push_back(simulator.name());
  }
  return names;
}

std::optional<std::int64_t> World::NextRelease() const {
  std::optional<std::int64_t> next;
  if (!simulated_ || !releases_silent_) return next;
  for (const auto& [id, simulator] : simulators_) {
    if (simulator.alive() || !simulator.holds_time()) continue;
    const std::int64_t due = simulator.silent_since_ns() + release_after_ns_;
    next = next ? std::min(*next, due) : due;
  }
  return next;
}

bool World::EpochIsOver() const {
  return simulated_ && started_ &&
         std::none_of(simulators_.begin(), simulators_.end(), [this](const auto& one) {
           const bool succeeded = !one.second.alive() && succession_.IsAwaited(one.first);
           return one.second.holds_time() && !succeeded;
         });
}

void World::FinishEpoch() {
  for (const auto& [id, simulator] : simulators_) {
    now_ = std::max(now_, simulator.time().clock().value_or(now_));
  }
}

void World::BeginEpoch() {
  if (!simulated_) return BeginWallEpoch();
  for (auto& [id, simulator] : simulators_) {
    if (LeavesWithEpoch(simulator)) simulator.LeaveEpoch();
  }
  ++epoch_;
  started_ = false;
  now_ = Instant();
}

void World::BeginWallEpoch() {
  for (auto& [id, simulator] : simulators_) simulator.RestartTime();
  ++epoch_;
  wall_time_.Restart();
  now_ = wall_time_.now();
}

Instant World::LatestAllowed(const Simulator& simulator) const {
  if (!simulated_) return numeric::AddRoundedDown(wall_time_.reading(), skew_);
  const SimulatorTime& time = simulator.time();
  const bool waits = time.lock_step() && time.granted();
  if (!started_ && !waits && !time.first_clock()) return first_clock_max_;
  Instant latest = time.granted().value_or(Instant::Always());
  if (started_ && !waits)
    latest = std::max(latest, numeric::AddRoundedDown(now_, grant_ahead_max_));
  // A clock that does not begin at the run's start was granted by a service before this one.
  if (time.first_clock() && (!waits || *time.first_clock() > Instant())) {
    latest = std::max(latest, numeric::AddRoundedDown(*time.first_clock(), grant_ahead_max_));
  }
  return latest;
}

StampRules World::RulesForState(const Simulator& simulator, bool admitted) const {
  StampRules rules{.earliest = wall_time_.earliest_stamp(), .latest = LatestAllowed(simulator)};
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
  Instant greatest = Instant::Always();
  for (const auto& [id, simulator] : simulators_) {
    greatest = std::max(greatest, simulator.time().granted().value_or(Instant::Always()));
  }
  return greatest == Instant::Always() ? stamp : greatest;
}

void World::SetClearance(const detection::AgentClearance& clearance) {
  Simulator* simulator = Find(clearance.agent.simulator);
  if (simulator == nullptr || simulator->run() != clearance.agent.run) return;
  simulator->agents().SetClearance(clearance);
}

void World::UpdateGrants() {
  if (!simulated_ || !started_) return;
  const Instant least = numeric::AddRoundedDown(now_, temporal_resolution_);
  const Instant greatest = numeric::AddRoundedDown(now_, grant_ahead_max_);
  for (auto& [id, simulator] : simulators_) {
    if (!simulator.time().clock()) continue;
    // No simulator may run past the end of a contact before its states are in.
    const Instant clear = std::min(greatest, simulator.agents().clearances().clear_until());
    if (simulator.time().Grant(std::max(least, clear))) {
      simulator.agents().clearances().MarkGrantChanged();
    }
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
