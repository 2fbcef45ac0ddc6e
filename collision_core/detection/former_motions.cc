#include "collision_core/detection/former_motions.h"

#include <algorithm>

namespace collision::detection {

void FormerMotions::Keep(std::uint32_t agent, motion::SpaceTimeBound bound, Instant until) {
  if (motions_max_ == 0) return;
  if (motions_.size() == motions_max_) DropFirst();
  if (agents_.empty()) agents_.push_back(kAsking);
  std::uint32_t index = static_cast<std::uint32_t>(agents_.size());
  if (free_.empty()) {
    agents_.push_back(agent);
  } else {
    index = free_.back();
    free_.pop_back();
    agents_[index] = agent;
  }
  bound.state.expiry = std::min(bound.state.expiry, until);
  method_->Set(index, bound);
  motions_.push_back({index, agent, until});
}

void FormerMotions::DropFirst() {
  method_->Remove(motions_.front().index);
  free_.push_back(motions_.front().index);
  motions_.pop_front();
}

void FormerMotions::Forget(Instant since) {
  while (!motions_.empty() && motions_.front().until <= since) DropFirst();
}

void FormerMotions::Find(const motion::SpaceTimeBound& around, Instant from, Instant until,
                         std::vector<std::uint32_t>* agents) {
  if (motions_.empty()) return;
  method_->Set(kAsking, around);
  found_.clear();
  method_->FindNeighbours(
      kAsking, {from, until, until}, [](std::uint32_t) { return false; }, &found_);
  method_->Remove(kAsking);
  for (const broad_phase::Neighbour& meeting : found_) agents->push_back(agents_[meeting.partner]);
}

}  // namespace collision::detection
