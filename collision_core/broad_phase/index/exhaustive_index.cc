#include "collision_core/broad_phase/index/exhaustive_index.h"

#include <algorithm>
#include <iterator>

#include "collision_core/broad_phase/index/pair_time.h"

namespace collision::broad_phase {

void ExhaustiveIndex::Set(std::uint32_t agent, const AgentBound& bound) {
  mutable_half_spaces().Remove(agent);
  if (bounds_.size() <= agent) bounds_.resize(agent + 1);
  bounds_[agent] = bound;
}

void ExhaustiveIndex::Remove(std::uint32_t agent) {
  ForgetRules(agent);
  mutable_half_spaces().Remove(agent);
  if (Holds(bounds_, agent)) bounds_[agent].reset();
}

bool ExhaustiveIndex::SetHalfSpace(std::uint32_t agent, const HalfSpace& half_space) {
  if (!mutable_half_spaces().Set(agent, half_space)) return false;
  if (Holds(bounds_, agent)) bounds_[agent].reset();
  return true;
}

std::uint32_t ExhaustiveIndex::IndexEnd() const {
  const auto end = static_cast<std::uint32_t>(bounds_.size());
  if (half_spaces().size() == 0) return end;
  return std::max(end, std::prev(half_spaces().end())->agent + 1);
}

intersection::IntersectionTime ExhaustiveIndex::TimeOf(const intersection::BroadQuery& query,
                                                       std::uint32_t a, std::uint32_t b) {
  return PairTimeOf(query, *this, bounds_, {a, b}, &work_);
}

std::optional<intersection::IntersectingPair> ExhaustiveIndex::EarliestOf(
    std::uint32_t agent, const intersection::BroadQuery& query) {
  std::optional<intersection::IntersectingPair> best;
  for (std::uint32_t partner = 0; partner < IndexEnd(); ++partner) {
    const auto [lower, higher] = std::minmax(agent, partner);
    const intersection::IntersectingPair pair{lower, higher, TimeOf(query, lower, higher)};
    if (!pair.time.instant().is_never() && (!best || pair < *best)) best = pair;
  }
  return best;
}

std::optional<intersection::IntersectingPair> ExhaustiveIndex::Earliest(
    const intersection::BroadQuery& query) {
  std::optional<intersection::IntersectingPair> best;
  for (std::uint32_t lower = 0; lower < IndexEnd(); ++lower) {
    for (std::uint32_t higher = lower + 1; higher < IndexEnd(); ++higher) {
      const intersection::IntersectingPair pair{lower, higher, TimeOf(query, lower, higher)};
      if (!pair.time.instant().is_never() && (!best || pair < *best)) best = pair;
    }
  }
  return best;
}

void ExhaustiveIndex::FindNearPairs(const intersection::BroadQuery& query,
                                    std::vector<NearPair>* pairs) {
  std::vector<std::uint32_t> held;
  for (std::uint32_t agent = 0; agent < IndexEnd(); ++agent) {
    if (Holds(bounds_, agent) || half_spaces().Find(agent) != nullptr) held.push_back(agent);
  }
  for (const std::uint32_t a : held) {
    for (const std::uint32_t b : held) {
      if (a < b && !TimeOf(query, a, b).instant().is_never()) pairs->push_back({a, b});
    }
  }
}

void ExhaustiveIndex::FindNeighbours(std::uint32_t agent, const NeighbourWindow& window,
                                     const Skip& skip, std::vector<Neighbour>* neighbours) {
  const std::size_t first_new = neighbours->size();
  std::optional<Neighbour> next;
  const intersection::BroadQuery query{intersection::BoundKind::kHorn, window.from,
                                       std::max(window.until, window.horizon)};
  const std::uint32_t end = IndexEnd();
  for (std::uint32_t partner = 0; partner < end; ++partner) {
    work_.filter_tests += Holds(bounds_, partner);  // a partner that is skipped costs as much
    if (partner == agent || skip(partner)) continue;
    const Neighbour neighbour{partner, TimeOf(query, agent, partner)};
    const Instant when = neighbour.time.instant();
    if (when.is_never()) continue;
    if (when <= window.until) {
      neighbours->push_back(neighbour);
    } else if (when <= window.horizon && (!next || when < next->time.instant())) {
      next = neighbour;
    }
  }
  if (next) neighbours->push_back(*next);
  SortByPartner(first_new, neighbours);
}

void ExhaustiveIndex::FindNeighbours(const AgentBound& bound, Instant from, Instant until,
                                     const Skip& skip, std::vector<Neighbour>* neighbours) {
  const intersection::BroadQuery query{intersection::BoundKind::kHorn, from, Instant::Never()};
  const std::uint32_t end = IndexEnd();
  for (std::uint32_t partner = 0; partner < end; ++partner) {
    work_.filter_tests += Holds(bounds_, partner);
    if (skip(partner)) continue;
    intersection::IntersectionTime time{from, numeric::kInfinity};
    const HalfSpaces::Entry* entry =
        Holds(bounds_, partner) ? nullptr : half_spaces().Find(partner);
    if (Holds(bounds_, partner) && CanMeet(query.bound, bound, *bounds_[partner])) {
      ++work_.pair_queries;
      time = EarliestIntersectionOf(query, bound, *bounds_[partner]);
    } else if (entry != nullptr && CanMeet(entry->half_space, bound)) {
      ++work_.pair_queries;
      time = EarliestIntersectionOf(query, entry->half_space, bound);
    }
    AppendIfBy(until, {partner, time}, neighbours);
  }
}

}  // namespace collision::broad_phase
