#include "collision_core/detection/clearance/search/due_neighbour_search.h"

#include <algorithm>

namespace collision::detection {

// Takes the intersections from `begin` on.
void DueNeighbourSearch::Take(const std::vector<broad_phase::Neighbour>& found, std::size_t begin,
                              Room* room) const {
  const Instant until = clock_.announce_until();
  std::vector<AgentIndex>& first = *room->first;
  for (std::size_t k = begin; k < found.size(); ++k) {
    if (found[k].time.instant() > until) continue;
    const AgentIndex partner(found[k].partner);
    if (pairs_.IsFull(partner)) {
      room->first_full = std::min(room->first_full, partner);
      continue;
    }
    first.push_back(partner);
    std::push_heap(first.begin(), first.end());
    if (first.size() <= room->pairs + 1) continue;
    std::pop_heap(first.begin(), first.end());
    first.pop_back();
  }
}

AgentIndex DueNeighbourSearch::Find(const ClearanceQuery& query, Instant horizon,
                                    std::vector<broad_phase::Neighbour>* found) {
  const Instant until = clock_.announce_until();
  const std::size_t pairs = pairs_.RoomFor(query.agent);
  Room seen{.pairs = pairs, .first = &first_};
  std::size_t taken = 0;
  found->clear();
  first_.clear();
  const auto skip = [&](std::uint32_t index) {
    const AgentIndex partner(index);
    Take(*found, taken, &seen);
    taken = found->size();
    if (query.LeavesOut(partner, tiers_)) return true;
    if (pairs_.IsFull(partner)) return partner > seen.first_full;
    return first_.size() > pairs && partner > first_.front();
  };
  broad_phase_->FindNeighbours(query.agent.value(), {query.from, until, horizon}, skip, found);
  // The neighbours have been sorted since: the order in which they were taken is lost.
  first_.clear();
  Room all{.pairs = pairs, .first = &first_};
  Take(*found, 0, &all);
  const bool overflows = first_.size() > pairs;
  if (overflows) all.first_full = std::min(all.first_full, first_.front());
  const AgentIndex end = overflows ? first_.front() : AgentIndex::None();
  std::erase_if(*found, [&](const broad_phase::Neighbour& neighbour) {
    const AgentIndex partner(neighbour.partner);
    return neighbour.time.instant() <= until && (pairs_.IsFull(partner) || partner >= end);
  });
  SortByPartner(0, found);
  return all.first_full;
}

}  // namespace collision::detection
