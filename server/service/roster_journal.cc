#include "server/service/roster_journal.h"

#include <vector>

#include "collision_core/numeric/seconds.h"

namespace collision::server {
namespace {

/// Whether a restarted service must wait for it.
bool IsInEpoch(const Simulator& simulator) {
  return simulator.time().clock().has_value() && !simulator.has_left();
}

}  // namespace

RosterJournal::RosterJournal(const v1::Config& config, Journal* journal)
    : journal_(journal), written_ahead_(config.clock().grant_ahead_max_s()) {}

bool RosterJournal::Keep(const World& world) {
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

bool RosterJournal::Clear() { return journal_ == nullptr || journal_->RemoveAll(); }

bool RosterJournal::SetTerm(std::uint32_t term, std::uint32_t epoch) {
  return journal_ == nullptr || journal_->SetTerm(term, epoch);
}

const std::string& RosterJournal::error() const {
  static const std::string none;
  return journal_ == nullptr ? none : journal_->error();
}

}  // namespace collision::server
