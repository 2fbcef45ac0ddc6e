// Whoever relied on more than a renewed agent still promises: the earlier keys of its partners.
#include <algorithm>

#include "collision_core/detection/detector_implementation.h"

namespace collision::detection {
namespace {

/// Keys beyond this horizon are far.
constexpr int kFarHorizon = 4;

/// With so few keys all are looked at one by one.
constexpr std::size_t kFewKeys = 32;

/// WorkBudget in units of a filter's test, about as it takes time: to look at one key, at a place, at a
/// partner that the broad phase offers, and a pair query.
constexpr std::uint64_t kKeyUnits = 16;
constexpr std::uint64_t kVisitUnits = 16;
constexpr std::uint64_t kOfferUnits = 32;
constexpr std::uint64_t kQueryUnits = 256;

/// A question one step farther costs about so many times more.
constexpr std::uint64_t kFartherCosts = 2;

}  // namespace

// Every partner whose key is later than its meeting with the renewed agent gets the earlier one.
// Only keys of earlier steps can be: whoever is asked in this step is asked about the new bound.
//
// Keys up to a horizon are found through the broad phase, by where their agents are; the later ones
// by a look at each. So those who are clear for long do not make a renewal look as far ahead, where
// it would meet everybody. By counted work the horizon goes to where both together cost least:
// farther where that spares more looks than it costs, nearer where the question costs more than all
// of them.
void Detector::Implementation::LowerKeys(std::uint32_t agent, Instant from) {
  if (latest_.empty()) return;
  const Instant until = AnnounceUntil();
  const bool few = latest_.size() <= kFewKeys;
  const Instant split = few ? Instant::Always() : std::max(until, Horizon(split_));
  const Instant last = Reversed(latest_.top_key());
  candidates_.clear();
  if (last > split) latest_.UpTo(Reversed(split), &candidates_);
  const std::uint64_t asked = few ? 0 : LowerNearKeys(agent, from, std::min(last, split));
  const std::uint64_t looks = kKeyUnits * candidates_.size();
  const std::uint64_t spared = kKeyUnits * LowerFarKeys(agent, from, Horizon(split_ + 1));
  if (few) return;
  if (spared > kFartherCosts * asked) {
    split_ = std::min(split_ + 1, kHorizons + 1);
  } else if (asked > looks) {
    split_ = std::max(split_ - 1, 1);
  }
}

// Of candidates_. Returns how many keys are not later than `next`.
std::uint64_t Detector::Implementation::LowerFarKeys(std::uint32_t agent, Instant from,
                                                     Instant next) {
  std::uint64_t sooner = 0;
  looks_ += candidates_.size();
  std::erase_if(candidates_, [&](std::uint32_t partner) {
    const Instant key = KeyOf(partner, agent);
    sooner += key <= next;
    return Marked(partner) || key_rows_.CertainlyLater(agent, partner, key);
  });
  if (candidates_.empty()) return sooner;
  std::sort(candidates_.begin(), candidates_.end());
  const motion::SpaceTimeBound bound = At(agent).margin.Widen(At(agent).bound());
  for (const std::uint32_t partner : candidates_) {
    const AgentRecord& other = At(partner);
    ++counters_.pair_queries;
    const motion::SpaceTimeBound bound_of_other = other.margin.Widen(other.bound());
    LowerKey(partner, agent,
             intersection::EarliestIntersection(bound, bound_of_other, from).instant());
  }
  return sooner;
}

// All that are not later than `horizon`, and perhaps others. Returns what it cost.
std::uint64_t Detector::Implementation::LowerNearKeys(std::uint32_t agent, Instant from,
                                                      Instant horizon) {
  std::uint64_t offers = 0;
  const auto skip = [&](std::uint32_t partner) {
    ++offers;
    return Marked(partner) || !latest_.Contains(partner) ||
           key_rows_.CertainlyLater(agent, partner, KeyOf(partner, agent));
  };
  const broad_phase::BroadPhaseWork before = broad_phase_.work();
  found_.clear();
  broad_phase_.FindNeighbours(agent, {from, horizon, horizon}, skip, &found_);
  const broad_phase::BroadPhaseWork after = broad_phase_.work();
  looks_ += offers;
  SortByPartner(0, &found_);
  for (const broad_phase::Neighbour& meeting : found_)
    LowerKey(meeting.partner, agent, meeting.time.instant());
  return after.filter_tests - before.filter_tests + kVisitUnits * (after.visits - before.visits) +
         kQueryUnits * (after.pair_queries - before.pair_queries) + kOfferUnits * offers;
}

// Where very many are renewed at once, a look of each at each far key would cost more than to ask
// those agents anew, once. They are asked after the renewed, as if their keys were due. Which these
// are depends on keys alone, not on what the broad phase costs: answers may be early, and the more so
// the farther ahead they were asked.
void Detector::Implementation::AskFarKeysAnew() {
  candidates_.clear();
  latest_.UpTo(Reversed(Horizon(kFarHorizon)), &candidates_);
  for (const std::uint32_t agent : candidates_) {
    latest_.Remove(agent);
    queue_.Set(agent, Instant::Always());
  }
}

// Who was asked, not renewed itself, and relied on a later key up to now: one of the renewed is
// why.
void Detector::Implementation::TellIfLowered(std::uint32_t agent, Instant before) {
  const AgentRecord& record = At(agent);
  if (record.renewed_cause != ClearanceCause::kNone || record.keys.first() >= before) return;
  const std::uint32_t cause = record.saturated ? record.crowded_with : record.next_partner;
  if (At(cause).renewed_cause != ClearanceCause::kNone) Tell(agent, cause);
}

void Detector::Implementation::LowerKey(std::uint32_t partner, std::uint32_t agent, Instant when) {
  AgentRecord& record = At(partner);
  if (when >= KeyOf(partner, agent)) return;
  const bool sooner = when < record.keys.first();
  if (when <= AnnounceUntil()) {
    Saturate(partner, agent);  // there was no room to track the two
  } else {
    if (sooner) record.next_partner = agent;
    LowerKeyOf(partner, agent, when);
  }
  if (sooner) Tell(partner, agent);
}

}  // namespace collision::detection
