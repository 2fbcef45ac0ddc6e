#include "collision_core/broad_phase/all_pairs.h"

namespace collision {

void AllPairs::Put(std::uint32_t agent, const SpaceTimeBound& bound) {
  if (bounds_.size() <= agent) bounds_.resize(agent + 1);
  bounds_[agent] = bound;
}

void AllPairs::Remove(std::uint32_t agent) { bounds_[agent].reset(); }

void AllPairs::Meetings(std::uint32_t agent, Instant from, Instant until,
                        const std::function<bool(std::uint32_t)>& skip,
                        std::vector<Meeting>* meetings) const {
  const SpaceTimeBound& asked = *bounds_[agent];
  std::optional<Meeting> next;
  for (std::uint32_t partner = 0; partner < bounds_.size(); ++partner) {
    if (partner == agent || !bounds_[partner] || skip(partner)) continue;
    const Meeting meeting{partner, EarliestIntersection(asked, *bounds_[partner], from)};
    ++pair_queries_;
    const Instant when = meeting.time.instant();
    if (when <= until) {
      meetings->push_back(meeting);
    } else if (!when.is_never() && (!next || when < next->time.instant())) {
      next = meeting;
    }
  }
  if (next) meetings->push_back(*next);
}

}  // namespace collision
