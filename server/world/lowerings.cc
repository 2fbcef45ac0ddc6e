#include "server/world/lowerings.h"

#include <algorithm>

namespace collision::server {

void Lowerings::Take(std::uint32_t slot, const detection::AgentClearance& clearance) {
  if (clearance.cause == detection::ClearanceCause::kNone) return;
  Lowering& standing = by_slot_[slot];
  ++standing.count;
  standing_.insert(slot);
  // No sample has carried it yet.
  published_.erase(slot / wire::kStatesPerChunkMax);
  if (clearance.void_from.is_never() && !standing.void_from.is_never()) return;
  standing.cause = clearance.cause;
  standing.cause_agent = clearance.cause_agent;
  standing.void_from = std::min(standing.void_from, clearance.void_from);
}

void Lowerings::Publish(std::uint32_t chunk, std::uint64_t sequence) {
  published_[chunk] = sequence;
  newest_published_ = std::max(newest_published_, sequence);
}

void Lowerings::Acknowledge(std::uint64_t sequence) {
  acknowledged_ = std::max(acknowledged_, std::min(sequence, newest_published_));
  std::erase_if(standing_, [&](std::uint32_t slot) {
    const auto sample = published_.find(slot / wire::kStatesPerChunkMax);
    if (sample == published_.end() || sample->second > acknowledged_) return false;
    if (const auto known = by_slot_.find(slot); known != by_slot_.end()) {
      known->second = {.count = known->second.count};
    }
    return true;
  });
}

Lowering Lowerings::Of(std::uint32_t slot) const {
  const auto known = by_slot_.find(slot);
  return known == by_slot_.end() ? Lowering{} : known->second;
}

}  // namespace collision::server
