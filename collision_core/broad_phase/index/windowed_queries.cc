// The queries that a windowed search answers (SweepingIndex).
#include <algorithm>

#include "collision_core/broad_phase/index/windowed_search.h"

namespace collision::broad_phase {
namespace {

/// Each window is this many times as long as the one before.
constexpr double kWindowFactor = 4;

}  // namespace

// Calls each(entry, agent) for every half-space if `asked` is an agent, and for every agent if it
// is a half-space.
template <typename Each>
void WindowedSearch::ForEachHalfSpace(std::uint32_t asked, Each each) const {
  const HalfSpaces::Entry* half_space = half_spaces().Find(asked);
  if (half_space == nullptr) {
    if (!table_.contains(asked)) return;
    for (const HalfSpaces::Entry& entry : half_spaces()) each(entry, asked);
    return;
  }
  for (std::uint32_t agent = 0; agent < table_.size(); ++agent) {
    if (table_.contains(agent)) each(*half_space, agent);
  }
}

std::optional<intersection::IntersectingPair> WindowedSearch::Earliest(
    const intersection::BroadQuery& query) {
  EarliestPairSink best(table_, query, &cost_.work);
  const auto offer = [&best](const HalfSpaces::Entry& half_space, std::uint32_t agent) {
    best.OfferHalfSpace(half_space, agent);
  };
  for (const HalfSpaces::Entry& entry : half_spaces()) ForEachHalfSpace(entry.agent, offer);
  StartAnew(PlacementFrame(table_, query, best.limit()));
  OfferCrowd(&best);
  if (frame_.is_unfilterable() || !store_->PlaceForJoin(scene(), frame_.window()))
    PlaceEveryAgent();
  OfferUnfilterable(&best);
  for (double seconds = frame_.window();;) {
    Join(frame_.After(query.from, seconds), &best);
    if (best.limit() <= seconds || seconds >= kWindowMax) return best.best();
    seconds = std::min({kWindowFactor * seconds, best.limit(), kWindowMax});
  }
}

namespace {

class NearPairList final : public PairSink {
 public:
  NearPairList(const HornTable& table, double limit, std::vector<NearPair>* pairs)
      : table_(table), pairs_(pairs) {
    limit_ = limit;
  }

  void Offer(std::uint32_t a, std::uint32_t b) override {
    if (a == b) return;
    if (table_.has_collision_filters() && !table_.CanMeetAtAll(a, b)) return;
    if (table_.RuleOf(a, b).excluded) return;
    pairs_->push_back({std::min(a, b), std::max(a, b)});
  }

 private:
  const HornTable& table_;
  std::vector<NearPair>* pairs_;
};

}  // namespace

void WindowedSearch::FindNearPairs(const intersection::BroadQuery& query,
                                   std::vector<NearPair>* pairs) {
  const double seconds = std::min(EarliestPairSink(table_, query, &cost_.work).limit(), kWindowMax);
  const auto before = static_cast<std::ptrdiff_t>(pairs->size());
  NearPairList list(table_, seconds, pairs);
  StartAnew(PlacementFrame(table_, query, seconds));
  if (frame_.is_unfilterable() || !store_->PlaceForJoin(scene(), seconds)) PlaceEveryAgent();
  OfferUnfilterable(&list);
  Join(frame_.After(query.from, seconds), &list);
  // A level that is taken whole offers a pair from both sides.
  if (placed_) {
    const auto first = pairs->begin() + before;
    std::sort(first, pairs->end());
    pairs->erase(std::unique(first, pairs->end()), pairs->end());
  }
  const auto tell = [&](const HalfSpaces::Entry& half_space, std::uint32_t agent) {
    if (!MayMeet(table_, half_space, agent, {query.from, seconds}, &cost_.work)) return;
    pairs->push_back({std::min(half_space.agent, agent), std::max(half_space.agent, agent)});
  };
  for (const HalfSpaces::Entry& entry : half_spaces()) ForEachHalfSpace(entry.agent, tell);
}

std::optional<intersection::IntersectingPair> WindowedSearch::EarliestOf(
    std::uint32_t agent, const intersection::BroadQuery& query) {
  EarliestPairSink best(table_, query, &cost_.work);
  ForEachHalfSpace(agent, [&best](const HalfSpaces::Entry& entry, std::uint32_t other) {
    best.OfferHalfSpace(entry, other);
  });
  if (!table_.contains(agent)) return best.best();
  if (query.bound == intersection::BoundKind::kHypertrapezoid) {
    for (std::uint32_t other = 0; other < table_.size(); ++other) {
      if (table_.contains(other)) best.Offer(agent, other);
    }
    return best.best();
  }
  Refresh(query.from);
  const BroadPhaseWork before = cost_.work;
  const bool all = TestsAll(agent, query.from);
  for (double seconds = std::min(frame_.window(), best.limit());;) {
    FindNear(agent, query.from, seconds);
    for (const std::uint32_t other : near_) best.Offer(agent, other);
    if (best.limit() <= seconds || seconds >= kWindowMax || all) break;
    seconds = std::min({kWindowFactor * seconds, best.limit(), kWindowMax});
  }
  RecordCost(before);
  return best.best();
}

// Appends the pair if the filters leave it open and it meets by `until`.
bool WindowedSearch::AppendIfIntersecting(std::uint32_t agent, std::uint32_t other,
                                          const Within& within, Instant until,
                                          std::vector<Neighbour>* neighbours) {
  if (!MayMeet(table_, agent, other, within, &cost_.work)) return false;
  const std::size_t before = neighbours->size();
  AppendIfBy(until,
             {other, EarliestIntersectionOf(
                         {intersection::BoundKind::kHorn, within.from, Instant::Never()}, table_,
                         agent, other)},
             neighbours);
  return neighbours->size() > before;
}

void WindowedSearch::FindNeighbours(std::uint32_t agent, const NeighbourWindow& window,
                                    const Skip& skip, std::vector<Neighbour>* neighbours) {
  const Instant from = window.from, until = window.until, horizon = window.horizon;
  Refresh(from);
  const BroadPhaseWork before = cost_.work;
  ++query_;
  if (reported_in_.size() < table_.size()) reported_in_.resize(table_.size(), 0);
  const std::size_t first_new = neighbours->size();
  EarliestPairSink next(table_, {intersection::BoundKind::kHorn, from, horizon}, &cost_.work);
  const intersection::BroadQuery by_until{intersection::BoundKind::kHorn, from, until};
  const double first = EarliestPairSink(table_, by_until, &cost_.work).limit();
  ForEachHalfSpace(agent, [&](const HalfSpaces::Entry& entry, std::uint32_t mover) {
    const std::uint32_t partner = mover == agent ? entry.agent : mover;
    if (skip(partner)) return;
    if (MayMeet(table_, entry, mover, {from, first}, &cost_.work)) {
      const intersection::IntersectionTime time =
          EarliestIntersectionOf(by_until, entry, table_, mover);
      if (time.seconds < numeric::kInfinity) return neighbours->push_back({partner, time});
    }
    next.OfferHalfSpace(entry, mover);
  });
  for (double seconds = std::min(first, kWindowMax); table_.contains(agent);) {
    FindNear(agent, from, seconds);
    for (const std::uint32_t other : near_) {
      if (reported_in_[other] == query_ || other == agent || skip(other)) continue;
      if (seconds <= first &&
          AppendIfIntersecting(agent, other, {from, first}, until, neighbours)) {
        reported_in_[other] = query_;
      } else {
        next.Offer(agent, other);
      }
    }
    if (next.limit() <= seconds || seconds >= kWindowMax || TestsAll(agent, from)) break;
    seconds = std::min({kWindowFactor * seconds, next.limit(), kWindowMax});
  }
  if (next.best()) {
    const intersection::IntersectingPair& best = *next.best();
    neighbours->push_back({best.lower == agent ? best.higher : best.lower, best.time});
  }
  SortByPartner(first_new, neighbours);
  RecordCost(before);
}

void WindowedSearch::FindNeighbours(const AgentBound& bound, Instant from, Instant until,
                                    const Skip& skip, std::vector<Neighbour>* neighbours) {
  Refresh(from);
  const BroadPhaseWork before = cost_.work;
  const std::size_t first_new = neighbours->size();
  AppendHalfSpaces(bound, from, until, skip, neighbours);
  const Guest guest(bound);
  const intersection::BroadQuery by_until{intersection::BoundKind::kHorn, from, until};
  const double limit = EarliestPairSink(table_, by_until, &cost_.work).limit();
  near_.clear();
  if (guest.row.unfilterable || frame_.is_unfilterable() || !HornTable::Near(from)) {
    FindAllBut(PlacedBall::kNoAgent);
  } else {
    FindNear(frame_.Place(guest.row), from, std::min(limit, kWindowMax));
  }
  CountSearch();
  const intersection::BroadQuery from_on{intersection::BoundKind::kHorn, from, Instant::Never()};
  for (const std::uint32_t other : near_) {
    if (skip(other) || !MayMeet(guest, table_, other, {from, limit}, &cost_.work)) continue;
    AppendIfBy(until, {other, EarliestIntersectionOf(from_on, bound.bound, table_.bound(other))},
               neighbours);
  }
  SortByPartner(first_new, neighbours);
  RecordCost(before);
}

void WindowedSearch::AppendHalfSpaces(const AgentBound& bound, Instant from, Instant until,
                                      const Skip& skip, std::vector<Neighbour>* neighbours) {
  const intersection::BroadQuery from_on{intersection::BoundKind::kHorn, from, Instant::Never()};
  for (const HalfSpaces::Entry& entry : half_spaces()) {
    if (skip(entry.agent) || !CanMeet(entry.half_space, bound)) continue;
    ++cost_.work.pair_queries;
    AppendIfBy(until, {entry.agent, EarliestIntersectionOf(from_on, entry.half_space, bound)},
               neighbours);
  }
}

}  // namespace collision::broad_phase
