#include "collision_core/broad_phase/near_search.h"

#include <algorithm>
#include <cmath>

namespace collision {
namespace {

/// Each window is so many times the one before.
constexpr double kWindowFactor = 4;

/// Beyond so many that have moved, and that share of all, everybody is placed anew.
constexpr std::size_t kMovedMin = 64;
constexpr double kMovedShare = 1.0 / 16;

/// With at least so many agents, a crowd of this part of the root of their number is asked first:
/// all pairs among them cost as much as a few tests of each agent.
constexpr std::uint32_t kCrowdMin = 2048;
constexpr double kCrowdOfRoot = 1.5;

}  // namespace

bool NearSearch::IsWild(std::uint32_t agent) const {
  return table_.row(agent).wild || placing_.blind();
}

void NearSearch::Put(std::uint32_t agent, const SpaceTimeBound& bound) {
  table_.Put(agent, bound);
  if (placed_) Move(agent);
}

void NearSearch::Narrow(std::uint32_t agent, const SpaceTimeBound& bound) {
  const bool was_wild = table_.row(agent).wild;
  table_.Put(agent, bound);
  if (placed_ && table_.row(agent).wild != was_wild) Move(agent);
}

void NearSearch::Remove(std::uint32_t agent) {
  if (!table_.contains(agent)) return;
  table_.Remove(agent);
  if (placed_) Move(agent);
}

// The next question places him, or everybody where too many have moved.
void NearSearch::Move(std::uint32_t agent) {
  if (has_moved_.size() <= agent) has_moved_.resize(table_.size());
  if (has_moved_[agent]) return;
  has_moved_[agent] = true;
  moved_.push_back(agent);
  if (moved_.size() > kMovedMin && moved_.size() > kMovedShare * table_.count()) placed_ = false;
}

template <typename Each>
void NearSearch::PlaceAtBegin(Each each) {
  const bool all_wild = placing_.blind();
  std::size_t placed = 0;
  for (std::uint32_t agent = 0; agent < table_.size(); ++agent) {
    if (!table_.contains(agent)) continue;
    if (all_wild || table_.row(agent).wild) {
      wild_.push_back(agent);
      continue;
    }
    horns_[placed] = placing_.AtBegin(table_, agent);
    each(horns_[placed++]);
  }
  horns_.resize(placed);
}

void NearSearch::PlaceMoved() {
  for (const std::uint32_t agent : moved_) {
    has_moved_[agent] = false;
    Unplace(agent);
    std::erase(wild_, agent);
    if (!table_.contains(agent)) continue;
    if (IsWild(agent)) {
      wild_.push_back(agent);
    } else {
      PlaceOne(placing_.Place(table_, agent));
    }
  }
  moved_.clear();
}

// Everybody is placed where he is at the begin, and then moved to the middle of the window: a few
// who are close to each other are asked in between, since a first answer makes the window short.
void NearSearch::PlaceAnew(const Placing& placing, BestMeeting* best) {
  ++work_.rebuilds;
  placing_ = placing;
  wasted_ = 0;
  placed_ = true;
  for (const std::uint32_t agent : moved_) has_moved_[agent] = false;
  moved_.clear();
  wild_.clear();
  horns_.resize(table_.count());
  const bool asks_crowd = best != nullptr && table_.count() >= kCrowdMin && !placing_.blind();
  if (asks_crowd) {
    crowd_.Clear();
    const double count = kCrowdOfRoot * std::sqrt(static_cast<double>(table_.count()));
    const Region region = placing_.Crowd(table_, static_cast<std::size_t>(count));
    PlaceAtBegin([&](PlacedHorn horn) {
      if (crowd_.size() >= 4 * count || !region.Contains(horn.c)) return;
      placing_.ToMiddle(&horn);
      crowd_.Add(horn);
    });
    crowd_.Join(placing_, {0, placing_.window()}, &work_, best);
    placing_.Shorten(best->limit());
  } else {
    PlaceAtBegin([](const PlacedHorn&) {});
  }
  PlaceAll();
}

// Placing everybody costs about one test for each: it is done when as many were wasted.
void NearSearch::Refresh(Instant from) {
  const bool usable = placed_ && placing_.bound() == BoundKind::kHorn;
  if (usable && wasted_ <= table_.count()) return PlaceMoved();
  PlaceAnew(Placing(table_, {BoundKind::kHorn, from, Instant::Never()}, kWindowMax), nullptr);
}

std::optional<PairMeeting> NearSearch::Earliest(const BroadQuery& query) {
  BestMeeting best(table_, query, &work_);
  PlaceAnew(Placing(table_, query, best.limit()), &best);
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
  if (told_in_.size() < table_.size()) told_in_.resize(table_.size(), 0);
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
