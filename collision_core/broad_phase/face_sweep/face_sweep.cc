#include "collision_core/broad_phase/face_sweep/face_sweep.h"

#include <algorithm>

#include "collision_core/broad_phase/face_sweep/face_sweep_window.h"

namespace collision::broad_phase {
namespace {

Instant Add(Instant t, std::int64_t nanoseconds, Instant latest) {
  const __int128 sum = static_cast<__int128>(t.nanoseconds()) + nanoseconds;
  return sum < latest.nanoseconds() ? Instant::FromNanoseconds(static_cast<std::int64_t>(sum))
                                    : latest;
}

/// Agents that are asked first of all once a pair meets at once.
constexpr std::size_t kLowest = 16;

constexpr double kFractionOfTick = 1.0 / CrossingOrder::kTicks;

/// What EarliestIntersectionOf() would say at once.
bool MayMeet(intersection::BoundKind kind, const motion::SpaceTimeBound& a,
             const motion::SpaceTimeBound& b) {
  if (kind == intersection::BoundKind::kHorn && NeverMoves(a) && NeverMoves(b)) return false;
  return CanMeet(a.declaration, b.declaration);
}

/// Crossings at later ticks lie after `time`, as seen in a window of 2^30 ticks.
std::uint32_t TickLimit(Instant start, Instant end, Instant time) {
  if (time >= end) return CrossingOrder::kTicks;
  if (time < start) return 0;
  const __int128 length = static_cast<__int128>(end.nanoseconds()) - start.nanoseconds();
  const __int128 passed = static_cast<__int128>(time.nanoseconds()) - start.nanoseconds();
  // What crosses in (j − 1, j] is told at tick j.
  const __int128 tick = (passed << CrossingOrder::kTickBits) / length + 1;
  return static_cast<std::uint32_t>(std::min<__int128>(tick, CrossingOrder::kTicks));
}

}  // namespace

/// What a question has found so far.
struct FaceSweep::Search {
  const intersection::BroadQuery& query;
  Instant first;  ///< No pair meets before.
  Instant last;   ///< Whatever meets within the query overlaps by then.
  std::optional<intersection::IntersectingPair> best;
  bool is_settled = false;  ///< No other pair can come before the best answer.

  /// What meets no later than the best answer overlaps by then.
  Instant limit() const {
    return best ? std::min(WithEarliness(first, best->time.instant()), last) : last;
  }

  bool meets_at_once() const { return best && best->time.instant() <= first; }

  /// Can a meeting of these agents come before the best answer?
  bool IsOpen(std::uint32_t lower, std::uint32_t higher) const {
    return !meets_at_once() || lower < best->lower ||
           (lower == best->lower && higher < best->higher);
  }
};

void FaceSweep::Put(std::uint32_t agent, const motion::SpaceTimeBound& bound) {
  half_spaces_.Remove(agent);
  if (bounds_.size() <= agent) bounds_.resize(agent + 1);
  bounds_[agent] = bound;
}

void FaceSweep::Remove(std::uint32_t agent) {
  ForgetRules(agent);
  half_spaces_.Remove(agent);
  if (Moves(agent)) bounds_[agent].reset();
}

bool FaceSweep::PutHalfSpace(std::uint32_t agent, const HalfSpace& half_space) {
  if (!half_spaces_.Put(agent, half_space)) return false;
  if (Moves(agent)) bounds_[agent].reset();
  return true;
}

std::uint32_t FaceSweep::IndexEnd() const {
  const auto end = static_cast<std::uint32_t>(bounds_.size());
  return half_spaces_.size() == 0 ? end : std::max(end, std::prev(half_spaces_.end())->agent + 1);
}

std::optional<intersection::IntersectingPair> FaceSweep::Earliest(
    const intersection::BroadQuery& query) {
  candidates_.clear();
  Instant earliest = Instant::Never(), second = Instant::Never();
  for (std::uint32_t agent = 0; agent < bounds_.size(); ++agent) {
    if (!bounds_[agent] || bounds_[agent]->state.expiry <= query.from) continue;
    candidates_.push_back(agent);
    second = std::min(second, std::max(earliest, bounds_[agent]->state.stamp));
    earliest = std::min(earliest, bounds_[agent]->state.stamp);
  }
  Search search{query, query.from, query.until, std::nullopt, false};
  for (const HalfSpaces::Entry& entry : half_spaces_) {
    for (const std::uint32_t agent : candidates_) Ask(entry.agent, agent, &search);
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
  AskApart(search);
  if (faces_.agents().size() < 2) return;
  for (int axis = 0; axis < 3; ++axis) orders_[axis].Start(faces_.faces(axis));
  AskOverlapsAtStart(start, end, search);
  if (start < end && !search->is_settled) AskCrossings(start, end, search);
  for (const CrossingOrder& order : orders_) {
    queued_max_ = std::max(queued_max_, order.queued_max());
  }
}

void FaceSweep::AskApart(Search* search) {
  for (const std::uint32_t agent : faces_.apart()) {
    candidates_.erase(std::lower_bound(candidates_.begin(), candidates_.end(), agent));
    for (const std::uint32_t partner : candidates_) Ask(agent, partner, search);
  }
}

void FaceSweep::AskOverlapsAtStart(Instant start, Instant end, Search* search) {
  const std::vector<std::uint32_t>& agents = faces_.agents();
  bool has_asked_lowest = false;
  const auto ceiling = [&] {
    if (!search->meets_at_once()) return ~0u;
    if (!has_asked_lowest) AskLowest(start, end, search);
    has_asked_lowest = true;
    if (search->is_settled) return 0u;
    const auto above = std::upper_bound(agents.begin(), agents.end(), search->best->lower);
    return static_cast<std::uint32_t>(std::max<std::ptrdiff_t>(above - agents.begin(), 1) - 1);
  };
  work_.filter_tests +=
      at_start_.ForEach({&orders_[0].faces(), &orders_[1].faces(), &orders_[2].faces()}, ceiling(),
                        [&](std::uint32_t lower, std::uint32_t higher) {
                          Ask(agents[lower], agents[higher], search);
                          return ceiling();
                        });
}

void FaceSweep::AskLowest(Instant start, Instant end, Search* search) {
  const std::vector<std::uint32_t>& agents = faces_.agents();
  const double fraction =
      start < end ? TickLimit(start, end, search->limit()) * kFractionOfTick : 0;
  const std::size_t lowest = std::min(kLowest, agents.size());
  for (std::uint32_t slot = 0; slot < lowest; ++slot) {
    for (std::uint32_t other = slot + 1; other < agents.size(); ++other) {
      if (!search->IsOpen(agents[slot], agents[other])) break;
      ++work_.filter_tests;
      if (faces_.MayOverlap(slot, other, 0, fraction)) Ask(agents[slot], agents[other], search);
    }
  }
  search->is_settled = search->best->lower <= agents[lowest - 1];
}

void FaceSweep::AskCrossings(Instant start, Instant end, Search* search) {
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
    Ask(agents[slot], agents[other], search);
    limit = TickLimit(start, end, search->limit());
  }
}

void FaceSweep::Ask(std::uint32_t agent, std::uint32_t partner, Search* search) {
  const auto [lower, higher] = std::minmax(agent, partner);
  if (!search->IsOpen(lower, higher)) return;
  const intersection::IntersectingPair meeting{lower, higher, TimeOf(search->query, lower, higher)};
  if (meeting.time.instant().is_never()) return;
  if (!search->best || meeting < *search->best) search->best = meeting;
}

intersection::IntersectionTime FaceSweep::TimeOf(const intersection::BroadQuery& query,
                                                 std::uint32_t a, std::uint32_t b) {
  const intersection::IntersectionTime never{query.from, numeric::kInfinity};
  const intersection::PairRule rule = rules().Of(a, b);
  const bool a_moves = Moves(a), b_moves = Moves(b);
  if (rule.excluded || a == b || !(a_moves || b_moves)) return never;
  if (a_moves && b_moves) {
    if (!MayMeet(query.bound, *bounds_[a], *bounds_[b])) return never;
    ++work_.pair_queries;
    return EarliestIntersectionOf(query, *bounds_[a], *bounds_[b], rule.margin);
  }
  const HalfSpaces::Entry* entry = half_spaces_.Find(a_moves ? b : a);
  const motion::SpaceTimeBound& bound = *bounds_[a_moves ? a : b];
  if (entry == nullptr || !CanMeet(entry->half_space, bound)) return never;
  ++work_.pair_queries;
  return EarliestIntersectionOf(query, entry->half_space, bound, rule.margin);
}

std::optional<intersection::IntersectingPair> FaceSweep::EarliestOf(
    std::uint32_t agent, const intersection::BroadQuery& query) {
  Search search{query, query.from, query.until, std::nullopt, false};
  for (std::uint32_t partner = 0; partner < IndexEnd(); ++partner) {
    Ask(agent, partner, &search);
  }
  return search.best;
}

void FaceSweep::NearPairs(const intersection::BroadQuery& query, std::vector<NearPair>* pairs) {
  std::vector<std::uint32_t> there;
  for (std::uint32_t agent = 0; agent < IndexEnd(); ++agent) {
    const bool held = agent < bounds_.size() && bounds_[agent];
    if (held || half_spaces_.Find(agent) != nullptr) there.push_back(agent);
  }
  for (const std::uint32_t a : there) {
    for (const std::uint32_t b : there) {
      if (a < b && !TimeOf(query, a, b).instant().is_never()) pairs->push_back({a, b});
    }
  }
}

void FaceSweep::Meetings(std::uint32_t agent, Instant from, Instant until, Instant horizon,
                         const Skip& skip, std::vector<Meeting>* meetings) {
  const std::size_t told = meetings->size();
  std::optional<Meeting> next;
  const intersection::BroadQuery query{intersection::BoundKind::kHorn, from,
                                       std::max(until, horizon)};
  const std::uint32_t end = IndexEnd();
  for (std::uint32_t partner = 0; partner < end; ++partner) {
    work_.filter_tests += Moves(partner);  // a partner that is only skipped costs as much
    if (partner == agent || skip(partner)) continue;
    const Meeting meeting{partner, TimeOf(query, agent, partner)};
    const Instant when = meeting.time.instant();
    if (when.is_never()) continue;
    if (when <= until) {
      meetings->push_back(meeting);
    } else if (when <= horizon && (!next || when < next->time.instant())) {
      next = meeting;
    }
  }
  if (next) meetings->push_back(*next);
  SortByPartner(told, meetings);
}

void FaceSweep::MeetingsOf(const motion::SpaceTimeBound& bound, Instant from, Instant until,
                           const Skip& skip, std::vector<Meeting>* meetings) {
  const intersection::BroadQuery query{intersection::BoundKind::kHorn, from, Instant::Never()};
  const std::uint32_t end = IndexEnd();
  for (std::uint32_t partner = 0; partner < end; ++partner) {
    work_.filter_tests += Moves(partner);
    if (skip(partner)) continue;
    intersection::IntersectionTime time{from, numeric::kInfinity};
    const HalfSpaces::Entry* entry = Moves(partner) ? nullptr : half_spaces_.Find(partner);
    if (Moves(partner) && MayMeet(query.bound, bound, *bounds_[partner])) {
      ++work_.pair_queries;
      time = EarliestIntersectionOf(query, bound, *bounds_[partner]);
    } else if (entry != nullptr && CanMeet(entry->half_space, bound)) {
      ++work_.pair_queries;
      time = EarliestIntersectionOf(query, entry->half_space, bound);
    }
    AppendIfBy(until, {partner, time}, meetings);
  }
}

}  // namespace collision::broad_phase
