#include "collision_core/broad_phase/index/windowed_search.h"

#include <algorithm>
#include <cmath>

namespace collision::broad_phase {
namespace {

/// Each window is so many times the one before.
constexpr double kWindowFactor = 4;

/// Beyond so many that have moved, and that share of all, all agents are placed anew.
constexpr std::size_t kMovedMin = 64;
constexpr double kMovedShare = 1.0 / 16;

/// With at least so many agents, a crowd of this part of the root of their number is asked first:
/// all pairs among them cost as much as a few tests of each agent.
constexpr std::uint32_t kCrowdMin = 2048;
constexpr double kCrowdOfRoot = 1.5;

/// The crowd is chosen from so many at least, and from every kStrideMax-th, spread evenly over the
/// indices.
constexpr std::uint32_t kSomeMin = 8192, kStrideMax = 16;

/// So many questions after a placing say what a question costs when it is fresh.
constexpr std::uint32_t kFreshQuestions = 64;

}  // namespace

void WindowedSearch::Put(std::uint32_t agent, const motion::SpaceTimeBound& bound) {
  half_spaces_.Remove(agent);
  table_.Put(agent, bound);
  if (placed_) Move(agent);
}

void WindowedSearch::Narrow(std::uint32_t agent, const motion::SpaceTimeBound& bound) {
  if (!table_.contains(agent)) return Put(agent, bound);
  const bool was_wild = table_.row(agent).unfilterable;
  table_.Put(agent, bound);
  if (placed_ && table_.row(agent).unfilterable != was_wild) Move(agent);
}

void WindowedSearch::Remove(std::uint32_t agent) {
  ForgetRules(agent);
  half_spaces_.Remove(agent);
  Drop(agent);
}

void WindowedSearch::Drop(std::uint32_t agent) {
  if (!table_.contains(agent)) return;
  table_.Remove(agent);
  if (placed_) Move(agent);
}

bool WindowedSearch::PutHalfSpace(std::uint32_t agent, const HalfSpace& half_space) {
  if (!half_spaces_.Put(agent, half_space)) return false;
  Drop(agent);
  return true;
}

void WindowedSearch::ShareRules(std::shared_ptr<intersection::PairRules> rules) {
  BroadPhase::ShareRules(std::move(rules));
  table_.UseRules(rules_.get());
}

// A smaller margin leaves the placing valid.
void WindowedSearch::RulesChanged(std::uint32_t agent) {
  if (!table_.contains(agent)) return;
  const HornRow before = table_.row(agent);
  table_.UpdateRules(agent);
  const HornRow& row = table_.row(agent);
  if (placed_ && (row.u0 > before.u0 || row.unfilterable != before.unfilterable)) Move(agent);
}

// Of an agent every half-space, of a half-space every agent.
template <typename Each>
void WindowedSearch::ForEachHalfSpace(std::uint32_t asked, Each each) const {
  const HalfSpaces::Entry* half_space = half_spaces_.Find(asked);
  if (half_space == nullptr) {
    if (!table_.contains(asked)) return;
    for (const HalfSpaces::Entry& entry : half_spaces_) each(entry, asked);
    return;
  }
  for (std::uint32_t agent = 0; agent < table_.size(); ++agent) {
    if (table_.contains(agent)) each(*half_space, agent);
  }
}

// The next question places the agent, or all agents where too many have moved.
void WindowedSearch::Move(std::uint32_t agent) {
  if (has_moved_.size() <= agent) has_moved_.resize(table_.size());
  if (has_moved_[agent]) return;
  has_moved_[agent] = true;
  moved_.push_back(agent);
  if (moved_.size() <= kMovedMin) return;
  const double share = kMovedShare * static_cast<double>(table_.count());
  if (static_cast<double>(moved_.size()) > share) placed_ = false;
}

void WindowedSearch::SortOutWild() {
  wild_.clear();
  if (table_.wild_count() == 0 && !placing_.blind()) return;
  for (std::uint32_t agent = 0; agent < table_.size(); ++agent) {
    if (table_.contains(agent) && IsWild(agent)) wild_.push_back(agent);
  }
}

void WindowedSearch::PlaceEverybody() {
  horns_.resize(table_.count());
  fastest_ = 0;
  std::size_t placed = 0;
  for (std::uint32_t agent = 0; agent < table_.size(); ++agent) {
    if (!table_.contains(agent) || IsWild(agent)) continue;
    horns_[placed] = placing_.Place(table_, agent);
    fastest_ = std::max(fastest_, horns_[placed++].speed);
  }
  horns_.resize(placed);
  PlaceAll();
  placed_ = true;
}

void WindowedSearch::PlaceMoved() {
  for (const std::uint32_t agent : moved_) {
    has_moved_[agent] = false;
    Unplace(agent);
    std::erase(wild_, agent);
    if (!table_.contains(agent)) continue;
    if (IsWild(agent)) {
      wild_.push_back(agent);
    } else {
      const PlacedHorn horn = placing_.Place(table_, agent);
      fastest_ = std::max(fastest_, horn.speed);
      PlaceOne(horn);
    }
  }
  moved_.clear();
}

// Some agents close to each other are asked first: a first answer makes the window short.
void WindowedSearch::AskCrowd(PairSink* sink) {
  const std::uint32_t stride = std::min(table_.size() / kSomeMin + 1, kStrideMax);
  const double count = kCrowdOfRoot * std::sqrt(static_cast<double>(table_.count()));
  const Region region = placing_.Crowd(table_, static_cast<std::size_t>(count * stride));
  crowd_.Clear();
  for (std::uint32_t agent = 0; agent < table_.size(); agent += stride) {
    if (!table_.contains(agent) || IsWild(agent)) continue;
    PlacedHorn horn = placing_.AtBegin(table_, agent);
    if (crowd_.size() >= 4 * count || !region.Contains(horn.c)) continue;
    placing_.ToMiddle(&horn);
    crowd_.Add(horn);
  }
  crowd_.Join(placing_, {0, placing_.window()}, &work_, sink);
  placing_.Shorten(sink->limit());
}

void WindowedSearch::StartAnew(const PlacementFrame& placing) {
  ++work_.rebuilds;
  placing_ = placing;
  wasted_ = 0;
  fresh_ = 0;
  fresh_units_ = excess_units_ = 0;
  for (const std::uint32_t agent : moved_) has_moved_[agent] = false;
  moved_.clear();
  placed_ = false;
  SortOutWild();
}

// Places grow old: reaches grow, agents stray. All are placed anew when questions have cost
// more, by as much as placing costs, than they did at first (of all moments that one is the best if
// the excess grows evenly), or when as many tests as there are agents were plainly wasted.
void WindowedSearch::Refresh(Instant from) {
  const bool usable = placed_ && placing_.bound() == intersection::BoundKind::kHorn &&
                      !(placing_.blind() && HornTable::Near(from));
  const double placing_units = BroadPhaseWork::kPlaceUnits * static_cast<double>(table_.count());
  if (usable && wasted_ <= table_.count() && excess_units_ <= placing_units) return PlaceMoved();
  StartAnew(
      PlacementFrame(table_, {intersection::BoundKind::kHorn, from, Instant::Never()}, kWindowMax));
  PlaceEverybody();
}

// A question has been answered.
void WindowedSearch::NoteCost(const BroadPhaseWork& before) {
  const double units = work_.search_units() - before.search_units();
  if (fresh_ < kFreshQuestions) {
    ++fresh_;
    fresh_units_ += units;
  } else {
    excess_units_ = std::max(0.0, excess_units_ + units - fresh_units_ / kFreshQuestions);
  }
}

void WindowedSearch::OfferWild(PairSink* sink) const {
  for (const std::uint32_t agent : wild_) {
    for (std::uint32_t other = 0; other < table_.size(); ++other) {
      // Of two unfilterable ones once.
      const bool told = other <= agent && IsWild(other);
      if (table_.contains(other) && !told) sink->Offer(agent, other);
    }
  }
}

std::optional<intersection::IntersectingPair> WindowedSearch::Earliest(
    const intersection::BroadQuery& query) {
  EarliestPairSink best(table_, query, &work_);
  const auto offer = [&best](const HalfSpaces::Entry& half_space, std::uint32_t agent) {
    best.OfferHalfSpace(half_space, agent);
  };
  for (const HalfSpaces::Entry& entry : half_spaces_) ForEachHalfSpace(entry.agent, offer);
  StartAnew(PlacementFrame(table_, query, best.limit()));
  if (table_.count() >= kCrowdMin && !placing_.blind()) AskCrowd(&best);
  if (placing_.blind() || !PlaceOnce(placing_.window())) PlaceEverybody();
  OfferWild(&best);
  for (double seconds = placing_.window();;) {
    Join(placing_.After(query.from, seconds), &best);
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
    if (a == b || (table_.has_collision_filters() && !CanMeet(table_.row(a), table_.row(b))))
      return;
    if (table_.RuleOf(a, b).excluded) return;
    pairs_->push_back({std::min(a, b), std::max(a, b)});
  }

 private:
  const HornTable& table_;
  std::vector<NearPair>* pairs_;
};

}  // namespace

void WindowedSearch::NearPairs(const intersection::BroadQuery& query,
                               std::vector<NearPair>* pairs) {
  const double seconds = std::min(EarliestPairSink(table_, query, &work_).limit(), kWindowMax);
  const auto told = static_cast<std::ptrdiff_t>(pairs->size());
  NearPairList list(table_, seconds, pairs);
  StartAnew(PlacementFrame(table_, query, seconds));
  if (placing_.blind() || !PlaceOnce(seconds)) PlaceEverybody();
  OfferWild(&list);
  Join(placing_.After(query.from, seconds), &list);
  // A level that is taken whole tells pairs from both sides.
  if (placed_) {
    const auto first = pairs->begin() + told;
    std::sort(first, pairs->end());
    pairs->erase(std::unique(first, pairs->end()), pairs->end());
  }
  const auto tell = [&](const HalfSpaces::Entry& half_space, std::uint32_t agent) {
    if (!MayMeet(table_, half_space, agent, query.from, seconds, &work_)) return;
    pairs->push_back({std::min(half_space.agent, agent), std::max(half_space.agent, agent)});
  };
  for (const HalfSpaces::Entry& entry : half_spaces_) ForEachHalfSpace(entry.agent, tell);
}

// About all agents, in the first window.
bool WindowedSearch::AsksAll(std::uint32_t agent, Instant from) const {
  return IsWild(agent) || !HornTable::Near(from);
}

void WindowedSearch::FindNear(std::uint32_t agent, Instant from, double seconds) {
  FindNearOnce(agent, from, seconds);
  ++work_.searches;
  work_.neighbours += near_.size();
}

void WindowedSearch::FindNearOnce(std::uint32_t agent, Instant from, double seconds) {
  near_.clear();
  if (AsksAll(agent, from)) return FindAll(agent);
  FindNear(placing_.Place(table_, agent), from, seconds);
}

// All agents but one, if that is there.
void WindowedSearch::FindAll(std::uint32_t but) {
  for (std::uint32_t other = 0; other < table_.size(); ++other) {
    if (other != but && table_.contains(other)) near_.push_back(other);
  }
}

void WindowedSearch::FindNear(PlacedHorn horn, Instant from, double seconds) {
  const TimeWindow stretch = placing_.After(from, seconds);
  // Placed horns have SphereFilter's slack for the way to the middle and from there on. A question from
  // before the begin looks farther back.
  const double farther = -stretch.first - placing_.middle();
  if (farther > 0) {
    const double speeds = static_cast<double>(horn.speed) + static_cast<double>(fastest_);
    constexpr double kSlack = kFilterSlack, kLeast = kReachLeast;
    horn.s0 += static_cast<float>((kSlack * speeds + 2 * kLeast) * farther * (1 + 0x1p-20));
  }
  FindNear(horn, stretch);
  near_.insert(near_.end(), wild_.begin(), wild_.end());
}

std::optional<intersection::IntersectingPair> WindowedSearch::EarliestOf(
    std::uint32_t agent, const intersection::BroadQuery& query) {
  EarliestPairSink best(table_, query, &work_);
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
  const BroadPhaseWork before = work_;
  const bool all = AsksAll(agent, query.from);
  for (double seconds = std::min(placing_.window(), best.limit());;) {
    FindNear(agent, query.from, seconds);
    for (const std::uint32_t other : near_) best.Offer(agent, other);
    if (best.limit() <= seconds || seconds >= kWindowMax || all) break;
    seconds = std::min({kWindowFactor * seconds, best.limit(), kWindowMax});
  }
  NoteCost(before);
  return best.best();
}

void WindowedSearch::Meetings(std::uint32_t agent, Instant from, Instant until, Instant horizon,
                              const Skip& skip, std::vector<Meeting>* meetings) {
  Refresh(from);
  const BroadPhaseWork before = work_;
  ++question_;
  if (told_in_.size() < table_.size()) told_in_.resize(table_.size(), 0);
  const std::size_t told = meetings->size();
  EarliestPairSink next(table_, {intersection::BoundKind::kHorn, from, horizon}, &work_);
  const double first =
      EarliestPairSink(table_, {intersection::BoundKind::kHorn, from, until}, &work_).limit();
  ForEachHalfSpace(agent, [&](const HalfSpaces::Entry& entry, std::uint32_t mover) {
    const std::uint32_t partner = mover == agent ? entry.agent : mover;
    if (skip(partner)) return;
    if (MayMeet(table_, entry, mover, from, first, &work_)) {
      const intersection::IntersectionTime time = EarliestIntersectionOf(
          {intersection::BoundKind::kHorn, from, until}, entry, table_, mover);
      if (time.seconds < numeric::kInfinity) return meetings->push_back({partner, time});
    }
    next.OfferHalfSpace(entry, mover);
  });
  for (double seconds = std::min(first, kWindowMax); table_.contains(agent);) {
    FindNear(agent, from, seconds);
    for (const std::uint32_t other : near_) {
      if (told_in_[other] == question_ || other == agent || skip(other)) continue;
      if (seconds <= first && MayMeet(table_, agent, other, from, first, &work_)) {
        const Meeting meeting{
            other, EarliestIntersectionOf({intersection::BoundKind::kHorn, from, Instant::Never()},
                                          table_, agent, other)};
        const Instant when = meeting.time.instant();
        if (when <= until && !when.is_never()) {
          told_in_[other] = question_;
          meetings->push_back(meeting);
          continue;
        }
      }
      next.Offer(agent, other);
    }
    if (next.limit() <= seconds || seconds >= kWindowMax || AsksAll(agent, from)) break;
    seconds = std::min({kWindowFactor * seconds, next.limit(), kWindowMax});
  }
  if (next.best()) {
    const intersection::IntersectingPair& best = *next.best();
    meetings->push_back({best.lower == agent ? best.higher : best.lower, best.time});
  }
  SortByPartner(told, meetings);
  NoteCost(before);
}

void WindowedSearch::MeetingsOf(const motion::SpaceTimeBound& bound, Instant from, Instant until,
                                const Skip& skip, std::vector<Meeting>* meetings) {
  Refresh(from);
  const BroadPhaseWork before = work_;
  const std::size_t told = meetings->size();
  OfferHalfSpaces(bound, from, until, skip, meetings);
  const HornRow row = HornTable::RowOf(bound);
  const double limit =
      EarliestPairSink(table_, {intersection::BoundKind::kHorn, from, until}, &work_).limit();
  near_.clear();
  if (row.unfilterable || placing_.blind() || !HornTable::Near(from)) {
    FindAll(PlacedHorn::kNoAgent);
  } else {
    FindNear(placing_.Place(row), from, std::min(limit, kWindowMax));
  }
  ++work_.searches;
  work_.neighbours += near_.size();
  for (const std::uint32_t other : near_) {
    if (skip(other) || !MayMeet(row, table_, other, from, limit, &work_)) continue;
    const intersection::IntersectionTime time = EarliestIntersectionOf(
        {intersection::BoundKind::kHorn, from, Instant::Never()}, bound, table_.bound(other));
    AppendIfBy(until, {other, time}, meetings);
  }
  SortByPartner(told, meetings);
  NoteCost(before);
}

void WindowedSearch::OfferHalfSpaces(const motion::SpaceTimeBound& bound, Instant from,
                                     Instant until, const Skip& skip,
                                     std::vector<Meeting>* meetings) {
  for (const HalfSpaces::Entry& entry : half_spaces_) {
    if (skip(entry.agent) || !CanMeet(entry.half_space, bound)) continue;
    ++work_.pair_queries;
    const intersection::IntersectionTime time = EarliestIntersectionOf(
        {intersection::BoundKind::kHorn, from, Instant::Never()}, entry.half_space, bound);
    AppendIfBy(until, {entry.agent, time}, meetings);
  }
}

}  // namespace collision::broad_phase
