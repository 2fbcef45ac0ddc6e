#include "collision_core/broad_phase/all_pairs.h"

#include <algorithm>

namespace collision {

void AllPairs::Put(std::uint32_t agent, const SpaceTimeBound& bound) {
  if (bounds_.size() <= agent) bounds_.resize(agent + 1);
  bounds_[agent] = bound;
}

void AllPairs::Remove(std::uint32_t agent) { bounds_[agent].reset(); }

void AllPairs::OfferMeetings(std::uint32_t agent, std::uint32_t first, const BroadQuery& query,
                             std::optional<PairMeeting>* best) {
  for (std::uint32_t partner = first; partner < bounds_.size(); ++partner) {
    if (partner == agent || !bounds_[partner]) continue;
    ++work_.pair_queries;
    const PairMeeting meeting{std::min(agent, partner), std::max(agent, partner),
                              MeetingTime(query, *bounds_[agent], *bounds_[partner])};
    if (meeting.time.instant().is_never()) continue;
    if (!*best || meeting < **best) *best = meeting;
  }
}

std::optional<PairMeeting> AllPairs::Earliest(const BroadQuery& query) {
  std::optional<PairMeeting> best;
  for (std::uint32_t agent = 0; agent < bounds_.size(); ++agent) {
    if (bounds_[agent]) OfferMeetings(agent, agent + 1, query, &best);
  }
  return best;
}

std::optional<PairMeeting> AllPairs::EarliestOf(std::uint32_t agent, const BroadQuery& query) {
  std::optional<PairMeeting> best;
  OfferMeetings(agent, 0, query, &best);
  return best;
}

void AllPairs::Meetings(std::uint32_t agent, Instant from, Instant until, Instant horizon,
                        const Skip& skip, std::vector<Meeting>* meetings) {
  const SpaceTimeBound& asked = *bounds_[agent];
  std::optional<Meeting> next;
  for (std::uint32_t partner = 0; partner < bounds_.size(); ++partner) {
    if (partner == agent || !bounds_[partner] || skip(partner)) continue;
    const Meeting meeting{partner, EarliestIntersection(asked, *bounds_[partner], from)};
    ++work_.pair_queries;
    const Instant when = meeting.time.instant();
    if (when <= until) {
      meetings->push_back(meeting);
    } else if (!when.is_never() && when <= horizon && (!next || when < next->time.instant())) {
      next = meeting;
    }
  }
  if (next) meetings->push_back(*next);
}

}  // namespace collision
