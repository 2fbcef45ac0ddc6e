#include "server/world/silence.h"

#include <algorithm>
#include <cmath>

namespace collision::server {
namespace {

std::int64_t Nanoseconds(double seconds) {
  return static_cast<std::int64_t>(std::llround(seconds * 1e9));
}

void TakeEarlier(std::optional<std::int64_t> due, std::optional<std::int64_t>* next) {
  if (due) *next = std::min(next->value_or(*due), *due);
}

}  // namespace

Silence::Silence(const v1::Config& config, const std::vector<JournalledSimulator>& roster)
    : simulated_(config.clock().kind() != v1::Clock::REAL_TIME),
      releases_(config.clock().on_silent_simulator() == v1::Clock::RELEASE),
      release_after_ns_(Nanoseconds(config.clock().release_after_s())),
      remove_after_ns_(Nanoseconds(config.clock().remove_silent_after_s())),
      progress_(Nanoseconds(config.clock().waiting_after_s())),
      roster_(simulated_ ? roster : std::vector<JournalledSimulator>{}) {}

void Silence::Update(const Simulators& simulators, std::int64_t now_ns) {
  if (!begun_ns_) begun_ns_ = now_ns;
  if (!simulated_) return;
  Instant least = Instant::Never();
  Instant greatest_alive = Instant::Always();
  for (const auto& [id, simulator] : simulators) {
    if (simulator.time().clock() && !simulator.is_inherited()) {
      roster_.Arrive(id, simulator.run());
    }
    if (!simulator.holds_time()) continue;
    const Instant told = simulator.time().told_until();
    least = std::min(least, told);
    if (simulator.alive()) greatest_alive = std::max(greatest_alive, told);
  }
  std::vector<TimeHolder> holders;
  for (const auto& [id, simulator] : simulators) {
    if (!simulator.alive() || !simulator.holds_time()) continue;
    const SimulatorTime& time = simulator.time();
    const bool may_go_on = !time.clock() || time.granted() > time.told_until();
    holders.push_back({.id = id,
                       .is_last = time.told_until() == least && may_go_on,
                       .others_wait = least < greatest_alive,
                       // Without a clock nothing that it tells brings the world further.
                       .told = {time.newest().nanoseconds(), time.clock() ? simulator.told() : 0}});
  }
  progress_.Update(holders, now_ns);
}

std::optional<std::int64_t> Silence::ReleaseDue(const Simulator& simulator) const {
  if (!simulated_ || !releases_ || !simulator.holds_time()) return std::nullopt;
  const std::optional<std::int64_t> since_ns =
      simulator.alive() ? progress_.HoldsUpSince(simulator.id()) : simulator.silent_since_ns();
  if (!since_ns) return std::nullopt;
  return *since_ns + release_after_ns_;
}

std::optional<std::int64_t> Silence::RemovalDue(const Simulator& simulator) const {
  if (remove_after_ns_ == 0 || simulator.has_left()) return std::nullopt;
  if (simulated_ && simulator.holds_time()) return std::nullopt;
  if (simulator.released()) return simulator.released_since_ns() + remove_after_ns_;
  if (simulator.alive()) return std::nullopt;
  return simulator.silent_since_ns() + remove_after_ns_;
}

std::optional<std::int64_t> Silence::RosterDue() const {
  if (roster_.complete() || !releases_ || !begun_ns_) return std::nullopt;
  return *begun_ns_ + release_after_ns_;
}

std::vector<std::string> Silence::Release(Simulators* simulators, std::int64_t now_ns) {
  std::vector<std::string> released;
  if (const auto due = RosterDue(); due && *due <= now_ns) released = roster_.GiveUpAll();
  for (auto& [id, simulator] : *simulators) {
    const auto due = ReleaseDue(simulator);
    if (!due || *due > now_ns) continue;
    simulator.Release(now_ns);
    released.push_back(simulator.name());
  }
  return released;
}

std::vector<std::uint64_t> Silence::Overdue(const Simulators& simulators,
                                            std::int64_t now_ns) const {
  std::vector<std::uint64_t> overdue;
  for (const auto& [id, simulator] : simulators) {
    const auto due = RemovalDue(simulator);
    if (due && *due <= now_ns) overdue.push_back(id);
  }
  return overdue;
}

std::vector<Awaited> Silence::Waited(const Simulators& simulators, std::int64_t now_ns) const {
  std::vector<Awaited> waited;
  if (!simulated_) return waited;
  for (const auto& [id, simulator] : simulators) {
    if (!simulator.holds_time() || simulator.time().has_finished()) continue;
    if (!simulator.alive()) {
      waited.push_back({simulator.name(), WaitReason::kEnded});
    } else if (progress_.IsNamed(id, now_ns)) {
      const bool stands = simulator.time().clock().has_value();
      waited.push_back({simulator.name(), stands ? WaitReason::kStands : WaitReason::kHasNoClock});
    }
  }
  for (const auto& [id, entry] : roster_.entries()) {
    const auto there = simulators.find(id);
    if (there != simulators.end() && there->second.holds_time() && !there->second.alive()) {
      continue;  // kEnded says so
    }
    const bool lives = there != simulators.end() && there->second.alive();
    waited.push_back({entry.name, lives ? WaitReason::kDoesNotFollowYet : WaitReason::kMissing});
  }
  std::sort(waited.begin(), waited.end());
  return waited;
}

std::optional<std::int64_t> Silence::NextDue(const Simulators& simulators, bool removes,
                                             std::int64_t now_ns) const {
  std::optional<std::int64_t> next = RosterDue();
  TakeEarlier(progress_.NextDue(now_ns), &next);
  for (const auto& [id, simulator] : simulators) {
    TakeEarlier(ReleaseDue(simulator), &next);
    if (removes) TakeEarlier(RemovalDue(simulator), &next);
  }
  return next;
}

}  // namespace collision::server
