#include "collision_core/broad_phase/face_sweep/face_sweep.h"

#include <algorithm>

#include "collision_core/broad_phase/face_sweep/face_sweep_window.h"
#include "collision_core/broad_phase/index/pair_time.h"

namespace collision::broad_phase {
namespace {

Instant Add(Instant t, std::int64_t nanoseconds, Instant latest) {
  const __int128 sum = static_cast<__int128>(t.nanoseconds()) + nanoseconds;
  return sum < latest.nanoseconds() ? Instant::FromNanoseconds(static_cast<std::int64_t>(sum))
                                    : latest;
}

/// Agents that are tested first of all once a pair meets at once.
constexpr std::size_t kLowest = 16;

constexpr double kFractionOfTick = 1.0 / CrossingOrder::kTicks;

/// Crossings at later ticks lie after `time`, as seen in a window of 2^30 ticks.
std::uint32_t TickLimit(Instant start, Instant end, Instant time) {
  if (time >= end) return CrossingOrder::kTicks;
  if (time < start) return 0;
  const __int128 length = static_cast<__int128>(end.nanoseconds()) - start.nanoseconds();
  const __int128 passed = static_cast<__int128>(time.nanoseconds()) - start.nanoseconds();
  // What crosses in (j − 1, j] is reported at tick j.
  const __int128 tick = (passed << CrossingOrder::kTickBits) / length + 1;
  return static_cast<std::uint32_t>(std::min<__int128>(tick, CrossingOrder::kTicks));
}

}  // namespace

/// The state of one call of Earliest().
struct FaceSweep::Search {
  const intersection::BroadQuery& query;
  Instant first;  ///< No pair meets before.
  Instant last;   ///< Every pair that meets within the query overlaps by then.
  std::optional<intersection::IntersectingPair> best;
  bool is_settled = false;  ///< No other pair can come before the best answer.

  /// Every pair that meets no later than the best answer overlaps by then.
  Instant limit() const {
    return best ? std::min(WithEarliness(first, best->time.instant()), last) : last;
  }

  bool meets_at_once() const { return best && best->time.instant() <= first; }

  /// Whether an intersection of these agents can come before the best answer.
  bool IsOpen(std::uint32_t lower, std::uint32_t higher) const {
    return !meets_at_once() || lower < best->lower ||
           (lower == best->lower && higher < best->higher);
  }
};

void FaceSweep::Set(std::uint32_t agent, const AgentBound& bound) {
  mutable_half_spaces().Remove(agent);
  if (bounds_.size() <= agent) bounds_.resize(agent + 1);
  bounds_[agent] = bound;
}

void FaceSweep::Remove(std::uint32_t agent) {
  ForgetRules(agent);
  mutable_half_spaces().Remove(agent);
  if (Holds(bounds_, agent)) bounds_[agent].reset();
}

bool FaceSweep::SetHalfSpace(std::uint32_t agent, const HalfSpace& half_space) {
  if (!mutable_half_spaces().Set(agent, half_space)) return false;
  if (Holds(bounds_, agent)) bounds_[agent].reset();
  return true;
}

std::optional<intersection::IntersectingPair> FaceSweep::Earliest(
    const intersection::BroadQuery& query) {
  candidates_.clear();
  Instant earliest = Instant::Never(), second = Instant::Never();
  for (std::uint32_t agent = 0; agent < bounds_.size(); ++agent) {
    if (!bounds_[agent] || bounds_[agent]->bound.state.expiry <= query.from) continue;
    candidates_.push_back(agent);
    second = std::min(second, std::max(earliest, bounds_[agent]->bound.state.stamp));
    earliest = std::min(earliest, bounds_[agent]->bound.state.stamp);
  }
  Search search{query, query.from, query.until, std::nullopt, false};
  for (const HalfSpaces::Entry& entry : half_spaces()) {
    for (const std::uint32_t agent : candidates_) Test(entry.agent, agent, &search);
  }
  if (candidates_.size() < 2) return search.best;
  // A pair's time counts from the later of its stamps on.
  if (query.bound == intersection::BoundKind::kHorn) search.first = std::max(query.from, second);
  if (query.bound == intersection::BoundKind::kHypertrapezoid) {
    SweepWindow(query.from, query.until, &search);
  } else if (search.first <= query.until) {
    SweepHorns(&search);
  }
  return search.best;
}

void FaceSweep::SweepHorns(Search* search) {
  search->last = WithEarliness(search->first, search->query.until);
  std::int64_t length = FirstWindow(bounds_, candidates_);
  Instant start = search->first;
  for (;;) {
    const Instant end = Add(start, length, search->last);
    SweepWindow(start, end, search);
    if (end >= search->limit() || search->is_settled || candidates_.size() < 2) return;
    start = end;
    length = std::min(length, Instant::Never().nanoseconds() / 2) * 2;
  }
}

void FaceSweep::SweepWindow(Instant start, Instant end, Search* search) {
  ++work_.rebuilds;
  faces_.Build(bounds_, candidates_, start, end, rules());
  TestApart(search);
  if (faces_.agents().size() < 2) return;
  for (int axis = 0; axis < 3; ++axis) orders_[axis].Start(faces_.faces(axis));
  TestOverlapsAtStart(start, end, search);
  if (start < end && !search->is_settled) TestCrossings(start, end, search);
  for (const CrossingOrder& order : orders_) {
    queued_max_ = std::max(queued_max_, order.queued_max());
  }
}

void FaceSweep::TestApart(Search* search) {
  for (const std::uint32_t agent : faces_.apart()) {
    candidates_.erase(std::lower_bound(candidates_.begin(), candidates_.end(), agent));
    for (const std::uint32_t partner : candidates_) Test(agent, partner, search);
  }
}

void FaceSweep::TestOverlapsAtStart(Instant start, Instant end, Search* search) {
  const std::vector<std::uint32_t>& agents = faces_.agents();
  bool has_tested_lowest = false;
  const auto ceiling = [&] {
    if (!search->meets_at_once()) return ~0u;
    if (!has_tested_lowest) TestLowest(start, end, search);
    has_tested_lowest = true;
    if (search->is_settled) return 0u;
    const auto above = std::upper_bound(agents.begin(), agents.end(), search->best->lower);
    return static_cast<std::uint32_t>(std::max<std::ptrdiff_t>(above - agents.begin(), 1) - 1);
  };
  work_.filter_tests +=
      at_start_.ForEach({&orders_[0].faces(), &orders_[1].faces(), &orders_[2].faces()}, ceiling(),
                        [&](std::uint32_t lower, std::uint32_t higher) {
                          Test(agents[lower], agents[higher], search);
                          return ceiling();
                        });
}

void FaceSweep::TestLowest(Instant start, Instant end, Search* search) {
  const std::vector<std::uint32_t>& agents = faces_.agents();
  const double fraction =
      start < end ? TickLimit(start, end, search->limit()) * kFractionOfTick : 0;
  const std::size_t lowest = std::min(kLowest, agents.size());
  for (std::uint32_t slot = 0; slot < lowest; ++slot) {
    for (std::uint32_t other = slot + 1; other < agents.size(); ++other) {
      if (!search->IsOpen(agents[slot], agents[other])) break;
      ++work_.filter_tests;
      if (faces_.MayOverlap(slot, other, 0, fraction)) Test(agents[slot], agents[other], search);
    }
  }
  search->is_settled = search->best->lower <= agents[lowest - 1];
}

void FaceSweep::TestCrossings(Instant start, Instant end, Search* search) {
  const std::vector<std::uint32_t>& agents = faces_.agents();
  std::uint32_t limit = TickLimit(start, end, search->limit());
  for (;;) {
    CrossingOrder* next = nullptr;
    for (CrossingOrder& order : orders_) {
      if (order.HasNext(limit) && (!next || order.tick() < next->tick())) next = &order;
    }
    if (!next) return;
    const FaceCrossing crossing = next->Next();
    ++work_.visits;
    if (!crossing.rising.is_upper() || crossing.falling.is_upper()) continue;
    const std::uint32_t slot = crossing.rising.slot(), other = crossing.falling.slot();
    if (slot == other) continue;
    ++work_.filter_tests;
    if (!faces_.MayOverlap(slot, other, (crossing.tick - 1) * kFractionOfTick,
                           crossing.tick * kFractionOfTick)) {
      continue;
    }
    Test(agents[slot], agents[other], search);
    limit = TickLimit(start, end, search->limit());
  }
}

void FaceSweep::Test(std::uint32_t agent, std::uint32_t partner, Search* search) {
  const auto [lower, higher] = std::minmax(agent, partner);
  if (!search->IsOpen(lower, higher)) return;
  const intersection::IntersectingPair pair{
      lower, higher, PairTimeOf(search->query, *this, bounds_, {lower, higher}, &work_)};
  if (pair.time.instant().is_never()) return;
  if (!search->best || pair < *search->best) search->best = pair;
}

}  // namespace collision::broad_phase
