#include "server/world/clearances.h"

#include <utility>

#include "collision_core/base/check.h"

namespace collision::server {

void Clearances::Set(std::uint32_t slot, const detection::AgentClearance& clearance) {
  clearances_.insert_or_assign(slot, clearance);
  ends_.Set(SlotIndex(slot), EndOf(clearance));
  lowerings_.Take(slot, clearance);
  MarkChanged(slot);
}

void Clearances::Forget(std::uint32_t slot) {
  clearances_.erase(slot);
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
  CORE_CHECK(ends_.size() == clearances_.size(), "each clearance is queued", ends_.size(),
             clearances_.size());
  for (const auto& [slot, clearance] : clearances_) {
    CORE_CHECK(ends_.KeyOf(SlotIndex(slot)) == EndOf(clearance), "a clearance is queued by its end",
               slot);
  }
}

std::set<std::uint32_t> Clearances::TakeChanged() { return std::exchange(changed_, {}); }

}  // namespace collision::server
