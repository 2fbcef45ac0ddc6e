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
  return simulator.time().clock().has_value() && !simulator.has_left();
}

}  // namespace

RosterJournal::RosterJournal(const v1::Config& config, Journal* journal,
                             std::function<Journal*()> open)
    : journal_(journal),
      open_(std::move(open)),
      has_roster_(config.clock().kind() != v1::Clock::WALL),
      written_ahead_(config.clock().grant_ahead_max_s()) {}

void RosterJournal::TryToOpen(std::int64_t monotonic_ns) {
  if (!opens_ || monotonic_ns < next_try_ns_) return;
  next_try_ns_ = monotonic_ns + kTryAgainAfter;
  try {
    journal_ = open_();
    awaited_.clear();
  } catch (const JournalInUse& in_use) {
    if (awaited_.empty()) spdlog::warn("{}: opened as soon as that one lets go", in_use.what());
    awaited_ = in_use.what();
    return;
  } catch (const std::exception& failure) {
    failure_ = failure.what();
  }
  opens_ = false;
  WriteTerm();
}

void RosterJournal::WriteTerm() {
  if (journal_ == nullptr || term_ == 0) return;
  if (!has_roster_) journal_->RemoveAll();
  journal_->SetTerm(term_, epoch_);
}

bool RosterJournal::Keep(const World& world) {
  TryToOpen(world.monotonic_ns());
  if (journal_ == nullptr || !world.simulated()) return error().empty();
  std::vector<std::uint64_t> gone;
  for (const auto& [id, kept] : journal_->simulators()) {
    const auto found = world.simulators().find(id);
    const bool there = found != world.simulators().end() && IsInEpoch(found->second);
    if (!there && !world.silence().roster().IsMissing(id)) gone.push_back(id);
  }
  for (const std::uint64_t id : gone) journal_->Remove(id);
  for (const auto& [id, simulator] : world.simulators()) {
    if (IsInEpoch(simulator) && !KeepOne(simulator)) return false;
  }
  return error().empty();
}

bool RosterJournal::KeepOne(const Simulator& simulator) {
  const auto& roster = journal_->simulators();
  const auto found = roster.find(simulator.id());
  const std::optional<Instant>& granted = simulator.time().granted();
  if (found != roster.end()) {
    const JournalledSimulator& kept = found->second;
    if (kept.run == simulator.run() && granted <= kept.granted) return true;
  } else if (journal_->full()) {
    // Of those that have not come back yet. Until they have, or are given up, nobody is granted
    // time; then there is room.
    return true;
  }
  JournalledSimulator entry{
      .id = simulator.id(), .run = simulator.run(), .name = simulator.name(), .granted = {}};
  if (granted) entry.granted = numeric::AddRoundedUp(*granted, written_ahead_);
  return journal_->Put(entry);
}

bool RosterJournal::SetTerm(std::uint32_t term, std::uint32_t epoch, std::int64_t monotonic_ns) {
  term_ = term;
  epoch_ = epoch;
  TryToOpen(monotonic_ns);
  WriteTerm();
  return error().empty();
}

const std::string& RosterJournal::error() const {
  return journal_ == nullptr ? failure_ : journal_->error();
}

}  // namespace collision::server
