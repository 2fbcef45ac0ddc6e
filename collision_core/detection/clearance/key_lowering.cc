#include "collision_core/detection/clearance/key_lowering.h"

#include <algorithm>

namespace collision::detection {
namespace {

/// Up to this number of keys, all are examined one by one.
constexpr std::size_t kFewKeys = 32;

/// Costs in units of one filter test, about in proportion to time: a key looked at, a place
/// visited, a partner offered by the broad phase, and a pair query.
constexpr std::uint64_t kKeyUnits = 16;
constexpr std::uint64_t kVisitUnits = 16;
constexpr std::uint64_t kOfferUnits = 32;
constexpr std::uint64_t kQueryUnits = 256;

/// How many times more a query costs if it looks one horizon farther, about.
constexpr std::uint64_t kFartherCosts = 2;

}  // namespace

void KeyLowering::Lower(AgentIndex agent, Instant from, const PartnerMarks& tracked) {
  if (coverage_->settled() == 0) return;
  const Renewed renewed{agent, from, tracked};
  const Instant until = context_.clock.announce_until();
  const bool few = coverage_->settled() <= kFewKeys;
  const Instant split = few ? Instant::Always() : std::max(until, horizons_.At(split_));
  const Instant last = coverage_->LatestKey();
  far_.clear();
  if (last > split) coverage_->AppendLowerableFrom(split, &far_);
  const std::uint64_t queried = few ? 0 : LowerNear(renewed, std::min(last, split));
  const std::uint64_t looks = kKeyUnits * far_.size();
  const std::uint64_t spared = kKeyUnits * LowerFar(renewed, horizons_.At(split_ + 1), &far_);
  if (few) return;
  if (spared > kFartherCosts * queried) {
    split_ = std::min(split_ + 1, QueryHorizons::kLast + 1);
  } else if (queried > looks) {
    split_ = std::max(split_ - 1, 1);
  }
}

// Returns how many keys of `far` are not later than `next`.
std::uint64_t KeyLowering::LowerFar(const Renewed& renewed, Instant next,
                                    std::vector<AgentIndex>* far) {
  std::uint64_t sooner = 0;
  examined_ += far->size();
  std::erase_if(*far, [&](AgentIndex partner) {
    const Instant key = coverage_->KeyOf(partner, renewed.agent);
    sooner += key <= next;
    return renewed.tracked.Contains(partner) || filter_.CertainlyLater(renewed.agent, partner, key);
  });
  if (far->empty()) return sooner;
  std::sort(far->begin(), far->end());
  const broad_phase::AgentBound bound = context_.agents[renewed.agent].wide_bound();
  for (const AgentIndex partner : *far) {
    const broad_phase::AgentBound of_partner = context_.agents[partner].wide_bound();
    LowerOne(partner, renewed.agent,
             queries_.EarliestUnder({renewed.agent, bound}, {partner, of_partner}, renewed.from));
  }
  return sooner;
}

// Lowers all keys that are not later than `horizon`, and perhaps others. Returns what it cost.
std::uint64_t KeyLowering::LowerNear(const Renewed& renewed, Instant horizon) {
  std::uint64_t offers = 0;
  const auto skip = [&](std::uint32_t index) {
    const AgentIndex partner(index);
    ++offers;
    return renewed.tracked.Contains(partner) || !coverage_->IsLowerable(partner) ||
           filter_.CertainlyLater(renewed.agent, partner, coverage_->KeyOf(partner, renewed.agent));
  };
  const broad_phase::BroadPhaseWork before = broad_phase_->work();
  found_.clear();
  broad_phase_->FindNeighbours(renewed.agent.value(), {renewed.from, horizon, horizon}, skip,
                               &found_);
  const broad_phase::BroadPhaseWork after = broad_phase_->work();
  examined_ += offers;
  SortByPartner(0, &found_);
  for (const broad_phase::Neighbour& neighbour : found_) {
    LowerOne(AgentIndex(neighbour.partner), renewed.agent, neighbour.time.instant());
  }
  return after.filter_tests - before.filter_tests + kVisitUnits * (after.visits - before.visits) +
         kQueryUnits * (after.pair_queries - before.pair_queries) + kOfferUnits * offers;
}

void KeyLowering::LowerOne(AgentIndex partner, AgentIndex agent, Instant when) {
  if (when >= coverage_->KeyOf(partner, agent)) return;
  AgentCoverage& record = (*coverage_)[partner];
  const bool sooner = when < record.keys.earliest();
  if (when <= context_.clock.announce_until()) {
    coverage_->Saturate(partner, agent);  // there was no room to track the two
  } else {
    if (sooner) record.next_partner = agent;
    coverage_->LowerKey(partner, agent, when);
  }
  if (sooner) reported_->NotifyPartner(partner, agent);
}

}  // namespace collision::detection
