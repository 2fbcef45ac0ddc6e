#include "collision_core/broad_phase/index/windowed_search.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "collision_core/base/check.h"

namespace collision::broad_phase {
namespace {

/// All agents are placed anew if more than this number, and more than this share, have moved.
constexpr std::size_t kMovedMin = 64;
constexpr double kMovedShare = 1.0 / 16;

/// From this number of agents on, a crowd of this multiple of the number's root is tested first:
/// all pairs among them cost as much as a few tests of each agent.
constexpr std::uint32_t kCrowdMin = 2048;
constexpr double kCrowdOfRoot = 1.5;

/// The crowd is chosen from agents at equal steps of the index: at least kSomeMin of them, and at
/// least every kStrideMax-th.
constexpr std::uint32_t kSomeMin = 8192, kStrideMax = 16;

/// The number of queries after a placement whose mean cost is that of a fresh placement.
constexpr std::uint32_t kFreshQueries = 64;

/// A sum of two rounded lengths in single precision, rounded up.
constexpr double kUpToFloat = 1 + 0x1p-20;

}  // namespace

WindowedSearch::WindowedSearch(std::unique_ptr<PlacedStore> store) : store_(std::move(store)) {
  CORE_CHECK(store_ != nullptr, "a windowed search has a store");
  table_.UseRules(&rules());
}

void WindowedSearch::Set(std::uint32_t agent, const AgentBound& bound) {
  mutable_half_spaces().Remove(agent);
  table_.Set(agent, bound);
  if (placed_) MarkMoved(agent);
}

void WindowedSearch::Tighten(std::uint32_t agent, const AgentBound& bound) {
  if (!table_.contains(agent)) return Set(agent, bound);
  const bool was_unfilterable = table_.row(agent).unfilterable;
  table_.Set(agent, bound);
  if (placed_ && table_.row(agent).unfilterable != was_unfilterable) MarkMoved(agent);
}

void WindowedSearch::Remove(std::uint32_t agent) {
  ForgetRules(agent);
  mutable_half_spaces().Remove(agent);
  Drop(agent);
}

void WindowedSearch::Drop(std::uint32_t agent) {
  if (!table_.contains(agent)) return;
  table_.Remove(agent);
  if (placed_) MarkMoved(agent);
}

bool WindowedSearch::SetHalfSpace(std::uint32_t agent, const HalfSpace& half_space) {
  if (!mutable_half_spaces().Set(agent, half_space)) return false;
  Drop(agent);
  return true;
}

// A smaller margin leaves the placement valid.
void WindowedSearch::UpdateRules(std::uint32_t agent) {
  if (!table_.contains(agent)) return;
  const HornRow before = table_.row(agent);
  table_.UpdateRules(agent);
  const HornRow& row = table_.row(agent);
  if (placed_ && (row.ball.s0 > before.ball.s0 || row.unfilterable != before.unfilterable))
    MarkMoved(agent);
}

// The next query places the agent, or all of them if too many have moved.
void WindowedSearch::MarkMoved(std::uint32_t agent) {
  if (has_moved_.size() <= agent) has_moved_.resize(table_.size());
  if (has_moved_[agent]) return;
  has_moved_[agent] = true;
  moved_.push_back(agent);
  const double many = kMovedShare * static_cast<double>(table_.count());
  if (moved_.size() > kMovedMin && static_cast<double>(moved_.size()) > many) placed_ = false;
}

void WindowedSearch::StartAnew(const PlacementFrame& frame) {
  ++cost_.work.rebuilds;
  frame_ = frame;
  cost_.wasted = 0;
  fresh_ = 0;
  fresh_units_ = excess_units_ = 0;
  for (const std::uint32_t agent : moved_) has_moved_[agent] = false;
  moved_.clear();
  placed_ = false;
  unfilterable_.clear();
  if (table_.unfilterable_count() == 0 && !frame_.is_unfilterable()) return;
  for (std::uint32_t agent = 0; agent < table_.size(); ++agent) {
    if (table_.contains(agent) && scene().IsUnfilterable(agent)) unfilterable_.push_back(agent);
  }
}

PlacedBall WindowedSearch::Placed(std::uint32_t agent) {
  const PlacedBall horn = frame_.Place(table_, agent);
  fastest_ = std::max(fastest_, horn.speed);
  most_bent_ = std::max(most_bent_, horn.bend);
  return horn;
}

void WindowedSearch::PlaceEveryAgent() {
  horns_.resize(table_.count());
  fastest_ = most_bent_ = 0;
  std::size_t placed = 0;
  for (std::uint32_t agent = 0; agent < table_.size(); ++agent) {
    if (!table_.contains(agent) || scene().IsUnfilterable(agent)) continue;
    horns_[placed++] = Placed(agent);
  }
  horns_.resize(placed);
  store_->PlaceAll(scene(), &horns_);
  placed_ = true;
#ifndef NDEBUG
  Validate();
#endif
}

void WindowedSearch::PlaceMoved() {
  if (moved_.empty()) return;
  for (const std::uint32_t agent : moved_) {
    has_moved_[agent] = false;
    store_->Unplace(agent);
    std::erase(unfilterable_, agent);
    if (!table_.contains(agent)) continue;
    if (scene().IsUnfilterable(agent)) {
      unfilterable_.push_back(agent);
    } else {
      store_->Place(Placed(agent));
    }
  }
  moved_.clear();
#ifndef NDEBUG
  Validate();
#endif
}

// Tests some agents that are close to each other: a first answer shortens the window.
void WindowedSearch::OfferCrowd(PairSink* sink) {
  if (table_.count() < kCrowdMin || frame_.is_unfilterable()) return;
  const std::uint32_t stride = std::min(table_.size() / kSomeMin + 1, kStrideMax);
  const double count = kCrowdOfRoot * std::sqrt(static_cast<double>(table_.count()));
  const Region region = frame_.Crowd(table_, static_cast<std::size_t>(count * stride));
  crowd_.Clear();
  for (std::uint32_t agent = 0; agent < table_.size(); agent += stride) {
    if (!table_.contains(agent) || scene().IsUnfilterable(agent)) continue;
    PlacedBall horn = frame_.AtBegin(table_, agent);
    if (crowd_.size() >= 4 * count || !region.Contains(horn.c)) continue;
    frame_.ToMiddle(&horn);
    crowd_.Add(horn);
  }
  crowd_.Join(frame_, {0, frame_.window()}, &cost_.work, sink);
  frame_.Shorten(sink->limit());
}

// Brings the placement up to date for queries about horns from `from` on.
void WindowedSearch::Refresh(Instant from) {
  const bool usable = placed_ && frame_.bound() == intersection::BoundKind::kHorn &&
                      !(frame_.is_unfilterable() && HornTable::Near(from));
  const double frame_units = BroadPhaseWork::kPlaceUnits * static_cast<double>(table_.count());
  if (usable && cost_.wasted <= table_.count() && excess_units_ <= frame_units) {
    return PlaceMoved();
  }
  StartAnew(
      PlacementFrame(table_, {intersection::BoundKind::kHorn, from, Instant::Never()}, kWindowMax));
  PlaceEveryAgent();
}

// Called after each query.
void WindowedSearch::RecordCost(const BroadPhaseWork& before) {
  const double units = cost_.work.search_units() - before.search_units();
  if (fresh_ < kFreshQueries) {
    ++fresh_;
    fresh_units_ += units;
  } else {
    excess_units_ = std::max(0.0, excess_units_ + units - fresh_units_ / kFreshQueries);
  }
}

void WindowedSearch::OfferUnfilterable(PairSink* sink) const {
  for (const std::uint32_t agent : unfilterable_) {
    for (std::uint32_t other = 0; other < table_.size(); ++other) {
      if (!table_.contains(other)) continue;
      // A pair of two unfilterable agents is offered once.
      const bool is_offered = other <= agent && scene().IsUnfilterable(other);
      if (!is_offered) sink->Offer(agent, other);
    }
  }
}

void WindowedSearch::Join(TimeWindow window, PairSink* sink) {
  if (store_->Join(scene(), window, &cost_, sink)) return;
  PlaceEveryAgent();
  const bool joined = store_->Join(scene(), window, &cost_, sink);
  CORE_CHECK(joined, "a store joins after it has placed all agents");
}

// Whether a query about the agent tests all others at once, in the first window.
bool WindowedSearch::TestsAll(std::uint32_t agent, Instant from) const {
  return scene().IsUnfilterable(agent) || !HornTable::Near(from);
}

void WindowedSearch::FindNear(std::uint32_t agent, Instant from, double seconds) {
  near_.clear();
  if (TestsAll(agent, from)) {
    FindAllBut(agent);
  } else {
    FindNear(frame_.Place(table_, agent), from, seconds);
  }
  CountSearch();
}

void WindowedSearch::CountSearch() {
  ++cost_.work.searches;
  cost_.work.neighbours += near_.size();
}

void WindowedSearch::FindAllBut(std::uint32_t agent) {
  for (std::uint32_t other = 0; other < table_.size(); ++other) {
    if (other != agent && table_.contains(other)) near_.push_back(other);
  }
}

// Placed balls have SphereFilter's slack for the way to the middle and from there on. A query
// from before the begin looks farther back, which takes more slack, and where paths bend more
// reach.
void WindowedSearch::FindNear(PlacedBall horn, Instant from, double seconds) {
  const TimeWindow window = frame_.After(from, seconds);
  const double farther = -window.first - frame_.middle();
  if (farther > 0) {
    const double speeds = static_cast<double>(horn.speed) + static_cast<double>(fastest_);
    constexpr double kSlack = kFilterSlack, kLeast = kReachLeast;
    horn.s0 += static_cast<float>((kSlack * speeds + 2 * kLeast) * farther * kUpToFloat);
  }
  if (window.first < 0) {
    const double bends = static_cast<double>(horn.bend) + static_cast<double>(most_bent_);
    horn.s0 += static_cast<float>(bends * window.first * window.first * kUpToFloat);
  }
  store_->FindNear(scene(), horn, window, &cost_, &near_);
  near_.insert(near_.end(), unfilterable_.begin(), unfilterable_.end());
}

void WindowedSearch::Validate() const {
  AgentBounds::Validate();
  table_.Validate();
  std::vector<bool> marked = has_moved_;
  for (const std::uint32_t agent : moved_) {
    CORE_CHECK(agent < marked.size() && marked[agent],
               "an agent that is due to be placed is marked, and listed once", agent);
    marked[agent] = false;
  }
  CORE_CHECK(std::find(marked.begin(), marked.end(), true) == marked.end(),
             "an agent that is marked is due to be placed", moved_.size());
  if (placed_) ValidatePlaced();
}

// What is due may still be where it was.
void WindowedSearch::ValidatePlaced() const {
  store_->Validate();
  std::vector<bool> listed(table_.size());
  for (const std::uint32_t agent : unfilterable_) {
    CORE_CHECK(agent < listed.size() && !listed[agent], "an agent is on the unfilterable list once",
               agent);
    listed[agent] = true;
  }
  for (std::uint32_t agent = 0; agent < table_.size(); ++agent) {
    if (agent < has_moved_.size() && has_moved_[agent]) continue;
    const bool is_held = table_.contains(agent);
    const bool is_direct = is_held && scene().IsUnfilterable(agent);
    CORE_CHECK(listed[agent] == is_direct,
               "an agent is on the unfilterable list if it is held and unfilterable", agent);
    CORE_CHECK(store_->Holds(agent) == (is_held && !is_direct),
               "an agent is in the store if it is held and filters can compare it", agent);
  }
}

}  // namespace collision::broad_phase
