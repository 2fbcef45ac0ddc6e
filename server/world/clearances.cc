#include "server/world/clearances.h"

#include <algorithm>
#include <utility>

#include "collision_core/base/check.h"

namespace collision::server {
namespace {

/// Whether who still goes by `before` knows less than now, and nothing wrong.
bool OnlyRises(const detection::AgentClearance& before, const detection::AgentClearance& now) {
  return now.cause == detection::ClearanceCause::kNone && now.clear_until >= before.clear_until &&
         now.unannounced_until >= before.unannounced_until &&
         now.unsettled_until <= before.unsettled_until && now.not_clear == before.not_clear &&
         now.in_contact == before.in_contact && now.saturated == before.saturated &&
         now.effective_from == before.effective_from;
}

}  // namespace

void Clearances::Set(std::uint32_t slot, const detection::AgentClearance& clearance,
                     bool hypothetical) {
  const auto [known, is_new] = clearances_.try_emplace(slot, clearance);
  if (!is_new && OnlyRises(known->second, clearance)) {
    Risen& risen = risen_[slot / kSlotsPerChunk];
    if (!clearance.not_clear)
      risen.known_until = std::min(risen.known_until, known->second.clear_until);
  } else {
    MarkChanged(slot);
  }
  known->second = clearance;
  if (!hypothetical) ends_.Set(SlotIndex(slot), EndOf(clearance));
  lowerings_.Take(slot, clearance);
}

void Clearances::SetOfLevel(std::uint32_t slot, std::size_t level,
                            const detection::AgentClearance& clearance) {
  const auto [known, is_new] = of_levels_.try_emplace({slot, level}, clearance);
  if (!is_new && OnlyRises(known->second, clearance)) {
    risen_.try_emplace(slot / kSlotsPerChunk);
  } else {
    MarkChanged(slot);
  }
  known->second = clearance;
}

const detection::AgentClearance* Clearances::OfLevel(std::uint32_t slot, std::size_t level) const {
  const auto found = of_levels_.find({slot, level});
  return found != of_levels_.end() ? &found->second : nullptr;
}

void Clearances::Forget(std::uint32_t slot) {
  clearances_.erase(slot);
  of_levels_.erase(of_levels_.lower_bound({slot, 0}), of_levels_.lower_bound({slot + 1, 0}));
  ends_.Remove(SlotIndex(slot));
  lowerings_.Forget(slot);
  MarkChanged(slot);
}

void Clearances::Publish(std::uint32_t chunk, std::uint64_t sequence, std::int64_t now_ns) {
  if (lowerings_.acknowledged() >= lowerings_.published()) waiting_since_ns_ = now_ns;
  lowerings_.Publish(chunk, sequence);
}

void Clearances::Acknowledge(std::uint64_t sequence, std::int64_t now_ns, bool contended) {
  const std::uint64_t before = lowerings_.acknowledged();
  lowerings_.Acknowledge(sequence);
  if (lowerings_.acknowledged() > before) waiting_since_ns_ = now_ns;
  if (!contended || lowerings_.acknowledged() >= lowerings_.published()) return;
  if (now_ns - waiting_since_ns_ < kRepeatAfterNs) return;
  waiting_since_ns_ = now_ns;
  MarkAllChanged();
}

void Clearances::MarkAllChanged() {
  for (const auto& [slot, clearance] : clearances_) MarkChanged(slot);
  MarkGrantChanged();
}

void Clearances::Validate() const {
  ends_.Validate();
  std::size_t queued = 0;
  for (const auto& [slot, clearance] : clearances_) {
    if (!ends_.Contains(SlotIndex(slot))) continue;
    ++queued;
    CORE_CHECK(ends_.KeyOf(SlotIndex(slot)) == EndOf(clearance), "a clearance is queued by its end",
               slot);
  }
  CORE_CHECK(ends_.size() == queued, "what is queued is a clearance", ends_.size(), queued);
}

std::set<std::uint32_t> Clearances::TakeChanged(std::int64_t now_ns, std::int64_t wait_ns,
                                                Instant soon) {
  for (auto& [chunk, risen] : risen_) {
    if (!risen.since_ns) risen.since_ns = now_ns;
    if (now_ns - *risen.since_ns >= wait_ns || risen.known_until <= soon) changed_.insert(chunk);
  }
  for (const std::uint32_t chunk : changed_) risen_.erase(chunk);
  return std::exchange(changed_, {});
}

}  // namespace collision::server
