#include "collision_core/broad_phase/near_search.h"

#include <algorithm>

namespace collision {
namespace {

/// Each window is so many times the one before.
constexpr double kWindowFactor = 4;

}  // namespace

bool NearSearch::IsWild(std::uint32_t agent) const {
  return table_.row(agent).wild || placing_.blind();
}

void NearSearch::Put(std::uint32_t agent, const SpaceTimeBound& bound) {
  if (placed_ && table_.contains(agent)) {
    Unplace(agent);
    std::erase(wild_, agent);
  }
  table_.Put(agent, bound);
  if (told_in_.size() <= agent) told_in_.resize(agent + 1, 0);
  if (!placed_) return;
  if (IsWild(agent)) {
    wild_.push_back(agent);
  } else {
    PlaceOne(agent);
  }
}

void NearSearch::Narrow(std::uint32_t agent, const SpaceTimeBound& bound) {
  const bool was_wild = table_.row(agent).wild;
  table_.Put(agent, bound);
  if (placed_ && table_.row(agent).wild != was_wild) Put(agent, bound);
}

void NearSearch::Remove(std::uint32_t agent) {
  if (!table_.contains(agent)) return;
  if (placed_) {
    Unplace(agent);
    std::erase(wild_, agent);
  }
  table_.Remove(agent);
}

void NearSearch::PlaceAnew(const Placing& placing) {
  ++work_.rebuilds;
  placing_ = placing;
  wasted_ = 0;
  wild_.clear();
  if (table_.wild_count() > 0 || placing_.blind()) {
    for (std::uint32_t agent = 0; agent < table_.size(); ++agent) {
      if (table_.contains(agent) && IsWild(agent)) wild_.push_back(agent);
    }
  }
  PlaceAll();
  placed_ = true;
}

// Placing everybody costs about one test for each: it is done when as many were wasted.
void NearSearch::Refresh(Instant from) {
  const bool usable = placed_ && placing_.bound() == BoundKind::kHorn;
  if (usable && wasted_ <= table_.count()) return;
  PlaceAnew(Placing(table_, {BoundKind::kHorn, from, Instant::Never()}, kWindowMax));
}

std::optional<PairMeeting> NearSearch::Earliest(const BroadQuery& query) {
  BestMeeting best(table_, query, &work_);
  PlaceAnew(Placing(table_, query, best.limit()));
  for (const std::uint32_t agent : wild_) {
    for (std::uint32_t other = 0; other < table_.size(); ++other) {
      if (table_.contains(other)) best.Offer(agent, other);
    }
  }
  for (double seconds = placing_.window();;) {
    Join(placing_.After(query.from, seconds), &best);
    if (best.limit() <= seconds || seconds >= kWindowMax) return best.best();
    seconds = std::min({kWindowFactor * seconds, best.limit(), kWindowMax});
  }
}

void NearSearch::FindNear(std::uint32_t agent, Instant from, double seconds) {
  near_.clear();
  if (IsWild(agent) || !HornTable::Near(from)) {
    for (std::uint32_t other = 0; other < table_.size(); ++other) {
      if (other != agent && table_.contains(other)) near_.push_back(other);
    }
    return;
  }
  FindNear(placing_.Place(table_, agent), placing_.After(from, seconds));
  near_.insert(near_.end(), wild_.begin(), wild_.end());
}

std::optional<PairMeeting> NearSearch::EarliestOf(std::uint32_t agent, const BroadQuery& query) {
  BestMeeting best(table_, query, &work_);
  if (query.bound == BoundKind::kHypertrapezoid) {
    for (std::uint32_t other = 0; other < table_.size(); ++other) {
      if (table_.contains(other)) best.Offer(agent, other);
    }
    return best.best();
  }
  Refresh(query.from);
  for (double seconds = std::min(placing_.window(), best.limit());;) {
    FindNear(agent, query.from, seconds);
    for (const std::uint32_t other : near_) best.Offer(agent, other);
    if (best.limit() <= seconds || seconds >= kWindowMax) return best.best();
    seconds = std::min({kWindowFactor * seconds, best.limit(), kWindowMax});
  }
}

void NearSearch::Meetings(std::uint32_t agent, Instant from, Instant until, Instant horizon,
                          const Skip& skip, std::vector<Meeting>* meetings) {
  Refresh(from);
  ++question_;
  const std::size_t told = meetings->size();
  BestMeeting next(table_, {BoundKind::kHorn, from, horizon}, &work_);
  const double first = BestMeeting(table_, {BoundKind::kHorn, from, until}, &work_).limit();
  for (double seconds = std::min(first, kWindowMax);;) {
    FindNear(agent, from, seconds);
    for (const std::uint32_t other : near_) {
      if (told_in_[other] == question_ || other == agent || skip(other)) continue;
      if (seconds <= first && MayMeet(table_, agent, other, from, first, &work_)) {
        const Meeting meeting{other,
                              EarliestIntersection(table_.bound(agent), table_.bound(other), from)};
        if (meeting.time.instant() <= until) {
          told_in_[other] = question_;
          meetings->push_back(meeting);
          continue;
        }
      }
      next.Offer(agent, other);
    }
    if (next.limit() <= seconds || seconds >= kWindowMax) break;
    seconds = std::min({kWindowFactor * seconds, next.limit(), kWindowMax});
  }
  if (next.best()) {
    const PairMeeting& best = *next.best();
    meetings->push_back({best.lower == agent ? best.higher : best.lower, best.time});
  }
  SortByPartner(told, meetings);
}

}  // namespace collision
