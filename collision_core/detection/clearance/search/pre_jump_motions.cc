#include "collision_core/detection/clearance/search/pre_jump_motions.h"

#include <algorithm>

namespace collision::detection {

void PreJumpMotions::Record(AgentIndex agent, broad_phase::AgentBound bound, Instant until) {
  if (motions_max_ == 0) return;
  if (motions_.size() == motions_max_) DropFirst();
  auto place = static_cast<std::uint32_t>(agents_.size());
  if (free_.empty()) {
    agents_.push_back(agent);
  } else {
    place = free_.back();
    free_.pop_back();
    agents_[place] = agent;
  }
  bound.bound.state.expiry = std::min(bound.bound.state.expiry, until);
  method_->Set(place, bound);
  motions_.push_back({place, until});
}

void PreJumpMotions::DropFirst() {
  method_->Remove(motions_.front().place);
  free_.push_back(motions_.front().place);
  motions_.pop_front();
}

void PreJumpMotions::Forget(Instant since) {
  while (!motions_.empty() && motions_.front().until <= since) DropFirst();
}

void PreJumpMotions::Find(const broad_phase::AgentBound& around, Instant from, Instant until,
                          std::vector<AgentIndex>* agents) {
  if (motions_.empty()) return;
  found_.clear();
  const auto none = [](std::uint32_t) { return false; };
  method_->FindNeighbours(around, from, until, none, &found_);
  for (const broad_phase::Neighbour& neighbour : found_)
    agents->push_back(agents_[neighbour.partner]);
}

void PreJumpMotions::Validate() const {
  method_->Validate();
  std::vector<bool> used(agents_.size());
  const auto use = [&used](std::uint32_t place) {
    CORE_CHECK(place < used.size() && !used[place], "a place has one motion, or is free once",
               place);
    used[place] = true;
  };
  for (const Motion& motion : motions_) {
    use(motion.place);
    CORE_CHECK(method_->Contains(motion.place), "the index holds each motion", motion.place);
  }
  for (const std::uint32_t place : free_) {
    use(place);
    CORE_CHECK(!method_->Contains(place), "the index holds no motion that is forgotten", place);
  }
  CORE_CHECK(motions_.size() + free_.size() == agents_.size(), "each place is used or free",
             motions_.size(), free_.size());
}

}  // namespace collision::detection
