// The earliest possible intersection over all agents.
#include <algorithm>
#include <tuple>

#include "collision_core/detection/detector_implementation.h"
#include "collision_core/detection/judge.h"
#include "collision_core/numeric/seconds.h"

namespace collision::detection {
namespace {

/// Lower bounds come from the canonical routine as well, asked at an earlier time, and what it tells
/// is early by up to 1e-9 of the way: now perhaps by nothing, then by all of that. Whoever may be
/// told as early as `told` meets, at the latest, by told + 1e-9 / (1 - 1e-9) of the way and 1 ns for
/// the rounding, so that its lower bound is not later than this. What the rounding of the inputs
/// forces beyond that, the margin in the lower bounds covers (KeyMargin).
Instant MeetsBy(Instant now, Instant told) {
  constexpr double kEarliness = 0x1p-29;
  constexpr double kInstantRounding = 2e-9;
  if (told.is_never() || told <= now) return told;
  return numeric::AddRoundedUp(
      told, kEarliness * numeric::SecondsBetween(now, told).upper + kInstantRounding);
}

}  // namespace

/// The best answer so far. Keys and PairRecord::not_before are lower bounds, so that only who stands
/// in a queue before the best answer is asked.
struct Detector::Implementation::EarliestSearch {
  Implementation& detector;
  EarliestAnswer best{};
  std::vector<std::uint32_t> pairs{};   // taken out of pairs_earliest_
  std::vector<std::uint32_t> agents{};  // taken out of queue_

  void Offer(std::uint32_t a, std::uint32_t b, Instant when) {
    if (when.is_never()) return;
    const auto [lower, higher] = std::minmax(detector.At(a).id, detector.At(b).id);
    if (best.found &&
        std::tie(best.earliest, best.lower, best.higher) <= std::tie(when, lower, higher)) {
      return;
    }
    best = {true, when, lower, higher};
  }

  /// Nobody whose lower bound is later betters the best answer.
  Instant Limit() const { return MeetsBy(detector.now_, best.earliest); }

  bool MayBetter(const EventQueue& queue) const {
    return !queue.empty() && queue.top_key() <= Limit() && !queue.top_key().is_never();
  }

  Instant Canonical(std::uint32_t a, std::uint32_t b) {
    ++detector.counters_.pair_queries;
    return intersection::EarliestIntersection(detector.At(a).bound(), detector.At(b).bound(),
                                              detector.now_)
        .instant();
  }

  void LookAtPairs();
  void OfferPair(PairRecord* pair);
  Instant NotBefore(const PairRecord& pair);
  void LookAtAgents();
  void OfferPartners(std::uint32_t agent);
  void OfferMeetings(std::uint32_t agent, Instant until, Instant horizon);
  void OfferSaturated();
};

void Detector::Implementation::EarliestSearch::LookAtPairs() {
  EventQueue& queue = detector.pairs_earliest_;
  while (MayBetter(queue)) {
    const std::uint32_t slot = queue.top();
    PairRecord& pair = detector.pairs_[slot];
    // What was judged in this step is known; of the others first a bound, which mostly is enough for
    // many steps.
    if (pair.turned != detector.step_ && pair.not_before == Instant::Always()) {
      pair.not_before = NotBefore(pair);
      queue.Set(slot, pair.not_before);
      continue;
    }
    queue.Remove(slot);
    pairs.push_back(slot);
    OfferPair(&pair);
  }
}

void Detector::Implementation::EarliestSearch::OfferPair(PairRecord* pair) {
  const Instant now = detector.now_;
  if (pair->asked != detector.step_) {
    pair->earliest = Canonical(pair->lower, pair->higher);
    pair->asked = detector.step_;
  }
  // The canonical answer begins at the newer state. Where that lies ahead of now (its owner was
  // granted more time than others), the pair must be certified free until there.
  const Instant known_from =
      std::max(detector.At(pair->lower).stamp(), detector.At(pair->higher).stamp());
  const bool known = pair->clear_until >= known_from;
  // States that lie ahead may tell of a contact that begins and ends before them.
  if (!pair->ahead_from.is_never() && pair->ahead_until > now) {
    Offer(pair->lower, pair->higher, std::max(now, pair->ahead_from));
  }
  if (!known) {
    return Offer(pair->lower, pair->higher,
                 std::min(pair->earliest, std::max(now, pair->clear_until)));
  }
  // Where balls may overlap, their shapes may be certified apart for longer. (Of balls, what an older
  // state certified could only be later by its rounding.)
  const bool shaped =
      HaveShapes(detector.At(pair->lower).history, detector.At(pair->higher).history);
  Offer(pair->lower, pair->higher,
        shaped ? std::max(pair->earliest, pair->clear_until) : pair->earliest);
}

// A lower bound of all that OfferPair() may offer until the pair is judged again.
Instant Detector::Implementation::EarliestSearch::NotBefore(const PairRecord& pair) {
  ++detector.counters_.pair_queries;
  const AgentRecord& a = detector.At(pair.lower);
  const AgentRecord& b = detector.At(pair.higher);
  Instant bound =
      intersection::EarliestIntersection(KeyMargin(a.bound()).Widen(a.bound()),
                                         KeyMargin(b.bound()).Widen(b.bound()), detector.now_)
          .instant();
  if (pair.clear_until < std::max(a.stamp(), b.stamp())) bound = std::min(bound, pair.clear_until);
  return std::max(Instant::FromNanoseconds(Instant::Always().nanoseconds() + 1),
                  std::min(bound, pair.ahead_from));
}

void Detector::Implementation::EarliestSearch::LookAtAgents() {
  EventQueue& queue = detector.queue_;
  while (MayBetter(queue)) {
    const std::uint32_t agent = queue.top();
    const AgentRecord& record = detector.At(agent);
    if (record.asked != detector.step_) {
      detector.Ask(agent);
      OfferSaturated();
      continue;
    }
    queue.Remove(agent);
    agents.push_back(agent);
    OfferPartners(agent);
  }
}

// Keys are computed with widened bounds, which cannot tell which of several partners comes first.
void Detector::Implementation::EarliestSearch::OfferPartners(std::uint32_t agent) {
  const AgentRecord& record = detector.At(agent);
  detector.MarkTracked(record);
  const std::uint32_t next = record.next_partner;
  const bool there = next != agent && next < detector.agents_.size() && detector.agents_[next] &&
                     !detector.At(next).expired && !detector.Marked(next);
  if (there) Offer(agent, next, Canonical(agent, next));
  if (!best.found) OfferMeetings(agent, record.keys.first(), Instant::Never());
  OfferMeetings(agent, Limit(), Limit());
}

void Detector::Implementation::EarliestSearch::OfferMeetings(std::uint32_t agent, Instant until,
                                                             Instant horizon) {
  std::vector<broad_phase::Neighbour>& found = detector.found_;
  found.clear();
  const auto skip = [this](std::uint32_t partner) { return detector.Marked(partner); };
  detector.broad_phase_.FindNeighbours(agent, {detector.now_, until, horizon}, skip, &found);
  for (const broad_phase::Neighbour& meeting : found) {
    Offer(agent, meeting.partner, Canonical(agent, meeting.partner));
  }
}

// A saturated agent may touch at any time; its key, later than now, does not count after that.
void Detector::Implementation::EarliestSearch::OfferSaturated() {
  for (std::size_t i = 0; i < detector.saturated_.size(); ++i) {
    const std::uint32_t agent = detector.saturated_[i];
    const AgentRecord& record = detector.At(agent);
    if (record.expired) continue;
    const bool there = detector.agents_[record.crowded_with] != nullptr;
    Offer(agent, there ? record.crowded_with : agent, detector.now_);
  }
}

EarliestAnswer Detector::Implementation::Earliest() {
  EarliestSearch search{*this};
  search.OfferSaturated();
  std::size_t tracked = 0;
  do {
    tracked = pairs_.size();
    search.LookAtPairs();
    search.LookAtAgents();
  } while (pairs_.size() != tracked);  // asking an agent may have added pairs
  for (const std::uint32_t slot : search.pairs) {
    pairs_earliest_.Set(slot, pairs_[slot].not_before);
  }
  for (const std::uint32_t agent : search.agents) {
    if (!At(agent).saturated) queue_.Set(agent, DueAt(At(agent)));
  }
  SettleKeys();
  return search.best;
}

}  // namespace collision::detection
