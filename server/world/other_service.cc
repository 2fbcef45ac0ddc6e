// The world of a service that stands by beside another one, or has taken over from it.
#include <algorithm>
#include <vector>

#include "collision_core/numeric/seconds.h"
#include "server/world/world.h"

namespace collision::server {

void World::StandBy() {
  // Whether time waits for those that our journal misses is for the service in force to decide.
  if (!stands_by_) {
    silence_.roster().GiveUpAll();
    awaits_others_ = true;
  }
  stands_by_ = true;
}

void World::HearClock(Simulator* simulator, Instant clock, Instant until) {
  simulator->time().Hear(clock, until);
  heard_granted_ = std::max(heard_granted_, NewestClock());
}

void World::ForgetLowerings() {
  for (auto& [id, simulator] : simulators_) simulator.agents().clearances().ForgetLowerings();
}

void World::TakeOver() {
  stands_by_ = false;
  for (auto& [id, simulator] : simulators_) {
    simulator.TakeOver();
    simulator.agents().clearances().MarkAllChanged();
  }
  if (!simulated_ || NewestClock() == Instant::Always()) return;
  std::vector<JournalledSimulator> roster;
  for (auto& [id, simulator] : simulators_) {
    if (!simulator.holds_time()) continue;
    // One that is not heard may be there all the same, if this service could not hear it.
    if (!simulator.alive() && simulator.time().has_finished()) continue;
    roster.push_back({.id = id, .run = simulator.run(), .name = simulator.name(), .granted = {}});
  }
  silence_.AwaitRoster(roster, monotonic_ns());
  if (started_) LowerGrant(std::max(NewestClock(), heard_granted_));
  promised_from_ = std::max({granted_, heard_granted_, Instant()});
  RaiseInheritedGrant();
  ShareGrant();
}

std::optional<std::size_t> World::agents_in_time() const {
  std::optional<std::size_t> count;
  for (const auto& [id, simulator] : simulators_) {
    if (simulator.holds_time()) count = count.value_or(0) + simulator.agents().size();
  }
  return count;
}

std::size_t World::followers() const {
  if (stands_by_) return 0;
  return static_cast<std::size_t>(
      std::count_if(simulators_.begin(), simulators_.end(), [](const auto& one) {
        return one.second.alive() && one.second.follows() && !one.second.has_left();
      }));
}

Instant World::NewestClock() const {
  Instant newest = Instant::Always();
  Instant slowest = Instant::Never();
  for (const auto& [id, simulator] : simulators_) {
    const Instant heard = simulator.time().heard();
    newest = std::max(newest, heard);
    if (simulator.alive() && simulator.holds_time())
      slowest = std::min(slowest, simulator.time().heard_until());
  }
  if (slowest.is_never()) return newest;
  return std::min(newest, numeric::AddRoundedUp(slowest, grant_ahead_max_));
}

/// To a time that lies ahead, so that the round has an end. Requires that nobody was told of what
/// is taken back.
void World::LowerGrant(Instant until) {
  until = std::max(until, numeric::AddRoundedDown(now_, temporal_resolution_));
  if (until >= granted_) return;
  granted_ = until;
  for (auto& [id, simulator] : simulators_) simulator.time().LowerGrant(until);
}

/// A grant is at most `grant_ahead_max_s` ahead of now, and now never ahead of what a clock told
/// that the service had: by the time at which all follow this service, it has those clocks, too.
void World::RaiseInheritedGrant() {
  if (promised_from_ == Instant::Always() || silence_.roster().complete()) return;
  const Instant newest = std::max({NewestClock(), heard_granted_, granted_});
  const Instant from = numeric::AddRoundedUp(newest, grant_ahead_max_);
  if (from <= promised_from_) return;
  promised_from_ = from;
  silence_.roster().RaiseGrant(promised_from_);
  for (auto& [id, simulator] : simulators_) simulator.agents().clearances().MarkAllChanged();
}

}  // namespace collision::server
