// The pairs that may meet soon: who is tracked, when it is judged, what follows.
#include <algorithm>
#include <numeric>

#include "collision_core/detection/detector_implementation.h"
#include "collision_core/detection/judge.h"
#include "collision_core/numeric/seconds.h"

namespace collision::detection {
namespace {

// Shapes are looked at so far ahead, in units of announce_within: a little beyond what the
// announcer takes for "far apart again".
constexpr double kLookAhead = 1.3;

// Of the work that is left in a turn: for what is settled, then for what is heard; the rest is for
// what is promised.
constexpr double kSettledShare = 0.5;
constexpr double kHeardShare = 0.8;

// How much a pair counts beside one that is not announced, when a step's work is shared out: who is
// told "possible" waits for a verdict, and a contact for its end.
constexpr std::uint32_t kDoubtWeight = 4;
constexpr std::uint32_t kContactWeight = 2;

/// Beyond so many tracked pairs contacts that cannot end are not judged every step.
constexpr std::size_t kPairsJudgedEachStep = 512;

/// A contact that cannot end is then judged again after this share of announce_within, or half of
/// it.
constexpr double kRestShare = 0.125;

// Of the freedom that was found at `looked`, has half passed? Then it is time to look again.
bool WearsOut(Instant looked, Instant now, Instant free_until) {
  if (looked == Instant::Always() || free_until <= now) return true;
  return free_until.nanoseconds() - now.nanoseconds() <= now.nanoseconds() - looked.nanoseconds();
}

}  // namespace

// A pair is judged when one of its agents has news, and when it is due. In the order of the slots,
// which is the order of the events.
void Detector::Implementation::TurnAll() {
  slots_.clear();
  for (const std::uint32_t agent : changed_) {
    if (agents_[agent] == nullptr) continue;
    slots_.insert(slots_.end(), At(agent).pairs.begin(), At(agent).pairs.end());
  }
  while (!pairs_due_.empty() && pairs_due_.top_key() <= now_) {
    slots_.push_back(pairs_due_.top());
    pairs_due_.Remove(slots_.back());
  }
  std::sort(slots_.begin(), slots_.end());
  slots_.erase(std::unique(slots_.begin(), slots_.end()), slots_.end());
  if (options_.work_units_per_step > 0) {
    TurnSharing();
  } else {
    for (const std::uint32_t slot : slots_) Turn(slot, options_.work_units_per_turn, false);
  }
}

// What one leaves of its share goes to the next. Balls cost next to nothing and have none.
void Detector::Implementation::TurnSharing() {
  ShareOut();
  const std::uint64_t most = options_.work_units_per_turn;
  std::uint64_t left = 0;
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    if (claims_[i].wanted == 0) {
      Turn(slots_[i], most, false);
      continue;
    }
    left += given_[i];
    const std::uint64_t before = counters_.work_units;
    Turn(slots_[i], std::min(most, left), false);
    left -= std::min(left, counters_.work_units - before);
  }
}

// What a pair with shapes would use: what the last turn took, and something for what may have
// changed since.
WorkClaim Detector::Implementation::ClaimOf(std::uint32_t slot) const {
  const PairRecord& pair = pairs_[slot];
  WorkClaim claim;
  if (!HaveShapes(At(pair.lower).history, At(pair.higher).history)) return claim;
  claim.wanted = options_.work_units_per_turn;
  if (pair.spent < claim.wanted / 4) claim.wanted = 2 * pair.spent + claim.wanted / 16;
  if (pair.announced) claim.weight = pair.in_contact ? kContactWeight : kDoubtWeight;
  return claim;
}

// Of the step's work, one part for each of slots_.
void Detector::Implementation::ShareOut() {
  const std::uint64_t total = std::min(options_.work_units_per_step, WorkShares::kTotalMax);
  claims_.clear();
  for (const std::uint32_t slot : slots_) claims_.push_back(ClaimOf(slot));
  given_ = work_shares_.Of(claims_, total);
  const std::uint64_t left =
      total - std::accumulate(given_.begin(), given_.end(), std::uint64_t{0});
  const auto sharing = static_cast<std::uint64_t>(std::count_if(
      claims_.begin(), claims_.end(), [](const WorkClaim& claim) { return claim.wanted > 0; }));
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    if (claims_[i].wanted > 0) given_[i] += left / sharing;
  }
}

// The time from which the pair is judged every step: in a contact that may end, when contact is
// nearer than Δt, when it is to be announced, when what was heard of a contact that has ended is
// settled.
void Detector::Implementation::NoteDue(std::uint32_t slot) {
  const PairRecord& pair = pairs_[slot];
  const double ahead = pair.announced ? options_.temporal_resolution : options_.announce_within;
  // Rounded as now + ahead is: clear_until <= now + ahead exactly if due <= now.
  const Instant due = std::min(numeric::AddRoundedUp(pair.clear_until, -ahead), pair.settles);
  pairs_due_.Set(slot, pair.in_contact ? pair.rests_until : due);
}

// While two balls may not come apart, and neither tells anything new, nothing can be told of their
// contact but what has been: until then it rests. With u >= 0 no freedom can be certified where
// |Δc| <= r, and |Δc| is convex: it holds from where the two were judged up to now if at both ends,
// and from now on for as long as the relative speed takes to use up what is left. At the latest
// they are judged after a share of announce_within, each pair at another time of it.
Instant Detector::Implementation::RestOf(std::uint32_t slot, const ContactTracker& preview) const {
  constexpr double kMargin = 0x1p-40;
  constexpr std::uint32_t kTimes = 16;
  if (pairs_.size() <= kPairsJudgedEachStep) return Instant::Always();
  const PairRecord& pair = pairs_[slot];
  const bool begun = pair.tracker.in_contact() ||
                     (preview.in_contact() && preview.episode().begin.latest <= pair.tracker.at());
  if (!begun || !preview.in_contact() || !preview.finished().empty()) return Instant::Always();
  const motion::SpaceTimeBound& a = At(pair.lower).bound();
  const motion::SpaceTimeBound& b = At(pair.higher).bound();
  for (const motion::SpaceTimeBound* bound : {&a, &b}) {
    const motion::AgentDeclaration& declaration = bound->declaration;
    if (declaration.shape || declaration.shape_awaited) return Instant::Always();
    if (bound->state.stamp > preview.at()) return Instant::Always();
  }
  const Eigen::Vector3d w = b.state.v_WA - a.state.v_WA;
  double left = numeric::kInfinity;
  for (const Instant at : {preview.at(), now_}) {
    const double tau_A = numeric::SecondsBetween(a.state.stamp, at).middle();
    const double tau_B = numeric::SecondsBetween(b.state.stamp, at).middle();
    const Eigen::Vector3d d =
        (b.state.p_WA - a.state.p_WA) + tau_B * b.state.v_WA - tau_A * a.state.v_WA;
    const double sum = a.state.p_WA.norm() + b.state.p_WA.norm() + tau_A * a.state.v_WA.norm() +
                       tau_B * b.state.v_WA.norm() + a.declaration.radius + b.declaration.radius;
    left = a.declaration.radius + b.declaration.radius - d.norm() - kMargin * sum;
    if (!(left > 0)) return Instant::Always();
  }
  const double rest =
      kRestShare * options_.announce_within * (1 + static_cast<double>(slot % kTimes) / kTimes) / 2;
  const double speed = w.norm();
  const double apart = speed > 0 ? (1 - kMargin) * left / speed : numeric::kInfinity;
  return numeric::AddRoundedDown(now_, std::min(rest, apart));
}

// Up to here no later state of the agent is waited for. States of its own rate may still narrow
// what is known; an agent that speaks seldom, or once, is not waited for longer than twice its last
// interval.
double Detector::Implementation::Patience(const AgentRecord& agent) const {
  return std::max(options_.announce_within, 2 * agent.history.LastInterval());
}

Instant Detector::Implementation::SettledUntil(const AgentRecord& agent) const {
  return std::max(agent.stamp(),
                  std::min(agent.heard, numeric::AddRoundedDown(now_, -Patience(agent))));
}

// States may reach beyond now: then contacts that have not begun yet are known, and their ends.
void Detector::Implementation::NoteContactAhead(const ContactTracker& preview,
                                                PairRecord* pair) const {
  if (pair->ahead_until <= now_) pair->ahead_from = pair->ahead_until = Instant::Never();
  for (const std::vector<ContactEpisode>* episodes :
       {&pair->tracker.finished(), &preview.finished()}) {
    for (const ContactEpisode& episode : *episodes) {
      if (episode.end.latest <= now_ || pair->ahead_from <= episode.begin.earliest) continue;
      pair->ahead_from = episode.begin.earliest;
      pair->ahead_until = episode.end.latest;
    }
  }
}

// `last`: no more states will come, so that everything known is settled.
void Detector::Implementation::Turn(std::uint32_t slot, std::uint64_t allowed, bool last) {
  PairRecord& pair = pairs_[slot];
  const AgentRecord& a = At(pair.lower);
  const AgentRecord& b = At(pair.higher);
  if (!CanMeet(a.bound().declaration, b.bound().declaration)) {
    Drop(slot, false);
    return;
  }
  // One budget for all that this turn looks at, what is settled first.
  WorkBudget work(allowed);
  ContactTracker preview = pair.tracker;
  Judge(slot, last, &preview, &work);
  pair.work += work.spent();
  pair.spent = work.exhausted() ? kAllWanted : work.spent();
  counters_.work_units += work.spent();
  counters_.turns_cut_short += work.exhausted();
  NoteContactAhead(preview, &pair);
  pair.in_contact = preview.in_contact();
  pair.clear_until = preview.free_until();
  pair.settles = preview.finished().empty()
                     ? Instant::Never()
                     : numeric::AddRoundedUp(preview.finished().front().end.latest,
                                             std::max(Patience(a), Patience(b)));
  pair.unsettled_until =
      preview.finished().empty() ? Instant::Always() : preview.finished().back().end.latest;
  pair.turned = step_;
  Touch(pair.lower);
  Touch(pair.higher);
  if (!announcer_.Report(a, b, slot, preview, allowed, last, &pairs_) && Untrack(slot)) return;
  if (pair.in_contact) pair.rests_until = RestOf(slot, preview);
  NoteDue(slot);
  pair.not_before = Instant::Always();
  if (pair.in_contact) {
    pairs_earliest_.Remove(slot);
  } else {
    pairs_earliest_.Set(slot, pair.not_before);
  }
}

// Judges the pair's three horizons one after the other; `preview` ends at the last that holds.
void Detector::Implementation::Judge(std::uint32_t slot, bool last, ContactTracker* preview,
                                     WorkBudget* work) {
  PairRecord& pair = pairs_[slot];
  const AgentRecord& a = At(pair.lower);
  const AgentRecord& b = At(pair.higher);
  const auto judge = [&](Instant until, ContactTracker* tracker) {
    const Judged judged = detection::Judge(a.history, b.history, until, work, tracker);
    counters_.segments += judged.segments;
    counters_.glances += judged.at_a_glance;
  };
  // Settled: both owners' states reach up to here, so that the bounds of both directions count.
  const Instant there = std::min(a.bound().state.expiry, b.bound().state.expiry);
  const Instant heard = std::min({a.heard, b.heard, now_, there});
  {
    const WorkShare share(last ? 1 : kSettledShare, work);
    judge(last ? heard : std::min({SettledUntil(a), SettledUntil(b), there}), &pair.tracker);
  }
  // Heard: no jump that we do not know of lies before.
  *preview = pair.tracker;
  preview->TakeFinished();
  {
    const WorkShare share(kHeardShare, work);
    judge(heard, preview);
  }
  // Promised: free as long as both honour their newest bounds.
  if (!preview->free() || last) return;
  ContactTracker outlook = *preview;
  judge(std::min(std::max(a.stamp(), b.stamp()), there), &outlook);
  if (!outlook.free() || outlook.finished().size() != preview->finished().size()) return;
  const Instant from = std::min(now_, outlook.at());
  const Instant earliest = intersection::EarliestIntersection(a.bound(), b.bound(), from).instant();
  ++counters_.pair_queries;
  if (from == now_) {
    pair.earliest = earliest;
    pair.asked = step_;
  }
  outlook.ExtendFree(earliest);
  if (HaveShapes(a.history, b.history) && WearsOut(pair.looked_ahead, now_, outlook.at())) {
    pair.looked_ahead = now_;
    // Balls that overlap need not touch: as far ahead as decides what is announced.
    const Instant ahead = numeric::AddRoundedDown(now_, kLookAhead * options_.announce_within);
    outlook.ExtendFree(
        ShapesFreeAhead(a.history, b.history, outlook.at(), std::min(ahead, there), work));
  }
  *preview = outlook;
  const bool free_throughout = pair.tracker.free() && preview->finished().empty();
  if (free_throughout) pair.tracker.ExtendFree(preview->at());
}

void Detector::Implementation::Track(std::uint32_t a, std::uint32_t b, Instant free_until,
                                     bool began_before) {
  const std::uint32_t lower = At(a).id < At(b).id ? a : b;
  const std::uint32_t higher = lower == a ? b : a;
  std::optional<std::uint32_t> slot;
  if (RoomFor(At(a)) > 0 && RoomFor(At(b)) > 0) {
    slot = pairs_.Add({.lower = lower,
                       .higher = higher,
                       .tracker = ContactTracker(free_until, began_before),
                       .clear_until = free_until});
  }
  if (!slot) {
    Saturate(a, b);
    Saturate(b, a);
    return;
  }
  for (const std::uint32_t agent : {a, b}) {
    At(agent).pairs.push_back(*slot);
    NoteFull(agent);
    Touch(agent);
  }
  NoteDue(*slot);
  pairs_earliest_.Set(*slot, Instant::Always());
}

void Detector::Implementation::NoteFull(std::uint32_t agent) {
  full_[agent] = At(agent).pairs.size() >= options_.pairs_per_agent_max;
}

// Both keys cover the pair from now on. False: they cannot, since a state lies beyond what is
// certain of the two, or since they graze each other and may meet soon under the wider bounds that
// keys come from.
bool Detector::Implementation::Untrack(std::uint32_t slot) {
  const PairRecord& pair = pairs_[slot];
  const AgentRecord& a = At(pair.lower);
  const AgentRecord& b = At(pair.higher);
  Instant key = pair.clear_until;
  if (!HaveShapes(a.history, b.history)) {
    ++counters_.pair_queries;
    const intersection::IntersectionTime wide = intersection::EarliestIntersection(
        a.margin.Widen(a.bound()), b.margin.Widen(b.bound()), now_);
    key = std::min(key, wide.instant());
  }
  if (key <= AnnounceUntil() || key < std::max(a.stamp(), b.stamp())) return false;
  LowerKeyOf(pair.lower, pair.higher, key);
  LowerKeyOf(pair.higher, pair.lower, key);
  Release(slot);
  return true;
}

// The two will not meet any more, whatever they do.
void Detector::Implementation::Drop(std::uint32_t slot, bool gone) {
  const PairRecord& pair = pairs_[slot];
  announcer_.Leave(At(pair.lower), At(pair.higher), slot, gone, &pairs_);
  Release(slot);
}

void Detector::Implementation::Release(std::uint32_t slot) {
  const PairRecord& pair = pairs_[slot];
  for (const std::uint32_t agent : {pair.lower, pair.higher}) {
    std::erase(At(agent).pairs, slot);
    NoteFull(agent);
    Touch(agent);
  }
  pairs_due_.Remove(slot);
  pairs_earliest_.Remove(slot);
  pairs_.Remove(slot);
}

}  // namespace collision::detection
