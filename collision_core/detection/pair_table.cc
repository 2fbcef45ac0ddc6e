#include "collision_core/detection/pair_table.h"

namespace collision {

std::optional<std::uint32_t> PairTable::Add(const PairRecord& pair) {
  if (used_.size() == pairs_max_) return std::nullopt;
  std::uint32_t slot;
  if (free_.size() <= kSlotsResting && pairs_.size() < pairs_max_) {
    slot = static_cast<std::uint32_t>(pairs_.size());
    pairs_.emplace_back(pair);
  } else {
    slot = free_.front();
    free_.pop_front();
    pairs_[slot] = pair;
  }
  used_.insert(slot);
  return slot;
}

void PairTable::Remove(std::uint32_t slot) {
  pairs_[slot].reset();
  free_.push_back(slot);
  used_.erase(slot);
}

std::uint32_t PairTable::NextContact(std::uint32_t lower, std::uint32_t higher) {
  return ++contacts_[{lower, higher}];
}

void PairTable::Forget(std::uint32_t agent) {
  std::erase_if(contacts_, [agent](const auto& entry) {
    return entry.first.first == agent || entry.first.second == agent;
  });
}

}  // namespace collision
