#include "server/world.h"

#include <algorithm>
#include <cmath>

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
      release_after_ns_(ToNanoseconds(config.clock().release_after_s())),
      simulators_awaited_(config.clock().simulators_awaited()),
      simulators_max_(config.simulators_max()) {}

Simulator* World::Find(std::uint64_t id) {
  const auto found = simulators_.find(id);
  return found == simulators_.end() ? nullptr : &found->second;
}

Simulator* World::MakeRoomFor(std::uint64_t id) {
  if (simulators_.size() >= simulators_max_) {
    const auto left = std::find_if(simulators_.begin(), simulators_.end(), [](const auto& entry) {
      return entry.second.has_left() && entry.second.held.empty();
    });
    if (left == simulators_.end()) return nullptr;
    simulators_.erase(left);
  }
  Simulator& simulator = simulators_[id];
  simulator.id = id;
  return &simulator;
}

Claim World::ClaimFor(std::uint64_t id, std::uint64_t sender, std::uint32_t run,
                      const std::string* name) {
  Claim claim{.simulator = Find(id)};
  if (claim.simulator == nullptr) {
    claim.simulator = MakeRoomFor(id);
    if (claim.simulator == nullptr) {
      claim.reason = v1::REJECTED_TOO_MANY_SIMULATORS;
      claim.detail = std::to_string(simulators_.size()) + " are there; allowed: 1 to " +
                     std::to_string(simulators_max_);
      return claim;
    }
    claim.simulator->sender = sender;
    claim.simulator->run = run;
  }
  Simulator& simulator = *claim.simulator;
  const bool proves = name != nullptr && simulator.name.empty();
  if (simulator.sender == sender) {
    claim.accepted = run >= simulator.run;
    claim.new_run = run > simulator.run;
    claim.reason = v1::REJECTED_OLD_RUN;
  } else {
    claim.accepted = claim.new_run = proves || (!simulator.alive && run > simulator.run);
    claim.may_wait = !claim.accepted && simulator.alive && run > simulator.run;
  }
  if (!claim.accepted) {
    claim.detail = "run " + std::to_string(run) + "; in force: run " +
                   std::to_string(simulator.run) +
                   (simulator.sender == sender ? "" : " of another sender") +
                   (simulator.alive ? "" : ", gone; allowed: a higher run");
  } else if (proves) {
    simulator.name = *name;
  }
  return claim;
}

void World::SetReading(const ClockReading& reading) {
  reading_ = reading;
  if (simulated_) return;
  if (!wall_minus_monotonic_ns_) wall_minus_monotonic_ns_ = reading.wall_ns - reading.monotonic_ns;
  started_ = true;
  now_ = std::max(now_, Instant::FromNanoseconds(*wall_minus_monotonic_ns_ + reading.monotonic_ns));
}

void World::UpdateSimulatedTime() {
  if (!simulated_) return;
  std::size_t spoken = 0;
  Instant least = Instant::Never();
  for (const auto& [id, simulator] : simulators_) {
    if (simulator.clock) ++spoken;
    if (simulator.holds_time()) least = std::min(least, *simulator.clock);
  }
  if (least.is_never() || (!started_ && spoken < simulators_awaited_)) return;
  now_ = started_ ? std::max(now_, least) : least;
  started_ = true;
}

std::vector<std::string> World::ReleaseSilent() {
  std::vector<std::string> released;
  if (!simulated_ || !releases_silent_) return released;
  for (auto& [id, simulator] : simulators_) {
    if (simulator.alive || !simulator.holds_time()) continue;
    if (monotonic_ns() - simulator.silent_since_ns < release_after_ns_) continue;
    simulator.released = true;
    released.push_back(simulator.name);
  }
  return released;
}

std::vector<std::string> World::WaitedFor() const {
  std::vector<std::string> names;
  if (!simulated_) return names;
  for (const auto& [id, simulator] : simulators_) {
    if (!simulator.alive && simulator.holds_time()) names.push_back(simulator.name);
  }
  return names;
}

std::optional<std::int64_t> World::NextRelease() const {
  std::optional<std::int64_t> next;
  if (!simulated_ || !releases_silent_) return next;
  for (const auto& [id, simulator] : simulators_) {
    if (simulator.alive || !simulator.holds_time()) continue;
    const std::int64_t due = simulator.silent_since_ns + release_after_ns_;
    next = next ? std::min(*next, due) : due;
  }
  return next;
}

bool World::TakeClock(Simulator* simulator) {
  if (!simulator->TakeClock()) return false;
  if (!simulator->first_clock) simulator->first_clock = simulator->clock;
  return true;
}

Instant World::LatestAllowed(const Simulator& simulator) const {
  if (!simulated_) return numeric::AddRoundedDown(now_, skew_);
  const bool waits = simulator.lock_step && simulator.granted;
  if (!started_ && !waits && !simulator.first_clock) return Instant::Never();
  Instant latest = simulator.granted.value_or(Instant::Always());
  if (started_ && !waits)
    latest = std::max(latest, numeric::AddRoundedDown(now_, grant_ahead_max_));
  // A clock that does not begin at the run's start was granted by a service before this one.
  if (simulator.first_clock && (!waits || *simulator.first_clock > Instant())) {
    latest = std::max(latest, numeric::AddRoundedDown(*simulator.first_clock, grant_ahead_max_));
  }
  return latest;
}

StampRules World::RulesForState(const Simulator& simulator, bool admitted) const {
  StampRules rules{.latest = LatestAllowed(simulator)};
  if (admitted && simulator.clock) rules.discontinuity_from = *simulator.clock;
  return rules;
}

ClockRules World::RulesForClock(const Simulator& simulator) const {
  return {.earliest = simulator.told, .latest = LatestAllowed(simulator), .lock_step = simulated_};
}

Instant World::EffectiveFrom(Instant stamp) const {
  if (!simulated_) return now_;
  Instant greatest = Instant::Always();
  for (const auto& [id, simulator] : simulators_) {
    if (simulator.granted) greatest = std::max(greatest, *simulator.granted);
  }
  return greatest == Instant::Always() ? stamp : greatest;
}

void World::UpdateGrants() {
  if (!simulated_ || !started_) return;
  const Instant least = numeric::AddRoundedDown(now_, temporal_resolution_);
  const Instant greatest = numeric::AddRoundedDown(now_, grant_ahead_max_);
  for (auto& [id, simulator] : simulators_) {
    if (!simulator.clock) continue;
    Instant clear = greatest;
    for (const auto& [slot, state] : simulator.slots) {
      if (!state.agent || !state.agent->clearance) continue;
      clear = std::min(clear, state.agent->clearance->clear_until);
      // The end of a contact is news too: nobody runs ahead of it.
      if (state.agent->clearance->in_contact) clear = std::min(clear, least);
    }
    const Instant grant = std::max({simulator.granted.value_or(Instant::Always()), least, clear});
    if (simulator.granted == grant) continue;
    simulator.granted = grant;
    simulator.chunks_changed.insert(0);
  }
}

}  // namespace collision::server
