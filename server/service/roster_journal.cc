#include "server/service/roster_journal.h"

#include <spdlog/spdlog.h>

#include <exception>
#include <utility>
#include <vector>

#include "collision_core/numeric/seconds.h"

namespace collision::server {
namespace {

constexpr std::int64_t kTryAgainAfter = 1'000'000'000;  // [ns]

/// Whether a restarted service must wait for it.
bool IsInEpoch(const Simulator& simulator) {
  return simulator.time().stands_at().has_value() && !simulator.has_left();
}

}  // namespace

RosterJournal::RosterJournal(const v1::Config& config, JournalParts parts)
    : parts_(std::move(parts)),
      has_roster_(config.clock().kind() != v1::Clock::REAL_TIME),
      goes_on_without_(config.on_state_failure() != v1::Config::END),
      written_ahead_(config.clock().grant_ahead_max_s()) {}

void RosterJournal::TryToOpen(std::int64_t monotonic_ns) {
  if (!opens_ || monotonic_ns < next_try_ns_) return;
  next_try_ns_ = monotonic_ns + kTryAgainAfter;
  try {
    parts_.journal = parts_.open();
    awaited_.clear();
  } catch (const JournalInUse& in_use) {
    if (awaited_.empty()) spdlog::warn("{}: opened as soon as that one lets go", in_use.what());
    awaited_ = in_use.what();
    return;
  } catch (const std::exception& failure) {
    Fail(failure.what());
  }
  opens_ = false;
  WriteTerm();
}

void RosterJournal::WriteTerm() {
  if (parts_.journal == nullptr || term_ == 0) return;
  if (!has_roster_) parts_.journal->RemoveAll();
  parts_.journal->SetTerm(term_, epoch_);
}

bool RosterJournal::Keep(const World& world) {
  TryToOpen(world.monotonic_ns());
  if (parts_.journal == nullptr || !world.simulated()) return GoesOn();
  std::vector<std::uint64_t> gone;
  for (const auto& [id, kept] : parts_.journal->simulators()) {
    const auto found = world.simulators().find(id);
    const bool there = found != world.simulators().end() && IsInEpoch(found->second);
    if (!there && !world.silence().roster().IsMissing(id)) gone.push_back(id);
  }
  for (const std::uint64_t id : gone) parts_.journal->Remove(id);
  for (const auto& [id, simulator] : world.simulators()) {
    if (IsInEpoch(simulator) && !KeepOne(simulator)) break;
  }
  return GoesOn();
}

bool RosterJournal::KeepOne(const Simulator& simulator) {
  const auto& roster = parts_.journal->simulators();
  const auto found = roster.find(simulator.id());
  const std::optional<Instant>& granted = simulator.time().granted();
  if (found != roster.end()) {
    const JournalledSimulator& kept = found->second;
    if (kept.run == simulator.run() && granted <= kept.granted) return true;
  } else if (parts_.journal->full()) {
    // Of those that have not come back yet. Until they have, or are given up, nobody is granted
    // time; then there is room.
    return true;
  }
  JournalledSimulator entry{
      .id = simulator.id(), .run = simulator.run(), .name = simulator.name(), .granted = {}};
  if (granted) {
    entry.granted = numeric::AddRoundedUp(*granted, written_ahead_);
  } else if (found != roster.end()) {
    entry.granted = found->second.granted;  // to its former run
  }
  return parts_.journal->Put(entry);
}

void RosterJournal::SetTerm(std::uint32_t term, std::uint32_t epoch, std::int64_t monotonic_ns) {
  term_ = term;
  epoch_ = epoch;
  TryToOpen(monotonic_ns);
  WriteTerm();
  static_cast<void>(GoesOn());
}

/// After what was to be kept: whether it is, or the service goes on without.
bool RosterJournal::GoesOn() {
  if (parts_.failure.empty() && parts_.journal != nullptr) Fail(parts_.journal->error());
  return parts_.failure.empty() || goes_on_without_;
}

void RosterJournal::Fail(const std::string& why) {
  if (why.empty()) return;
  parts_.failure = why;
  spdlog::error("{}; nothing more is kept for the next start", why);
}

}  // namespace collision::server
