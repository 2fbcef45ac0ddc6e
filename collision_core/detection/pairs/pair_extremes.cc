#include "collision_core/detection/pairs/pair_extremes.h"

#include <algorithm>
#include <utility>

namespace collision::detection {
namespace {

void Include(const PairExtremes& pair, PairExtremes* extremes) {
  extremes->clear_until = std::min(extremes->clear_until, pair.clear_until);
  extremes->unannounced_until = std::min(extremes->unannounced_until, pair.unannounced_until);
  extremes->needed_from = std::min(extremes->needed_from, pair.needed_from);
  extremes->unsettled_until = std::max(extremes->unsettled_until, pair.unsettled_until);
  extremes->contacts += pair.contacts;
}

/// Whether `before` may be one of the extremes and `after`, which takes its place, is not.
bool MovesAway(const PairExtremes& before, const PairExtremes& after,
               const PairExtremes& extremes) {
  const auto rises = [&](Instant PairExtremes::*least) {
    return before.*least == extremes.*least && after.*least > before.*least;
  };
  return rises(&PairExtremes::clear_until) || rises(&PairExtremes::unannounced_until) ||
         rises(&PairExtremes::needed_from) ||
         (before.unsettled_until == extremes.unsettled_until &&
          after.unsettled_until < before.unsettled_until);
}

}  // namespace

void AgentExtremes::AddAgent(AgentIndex agent) {
  if (!agents_.contains(agent)) agents_.resize(agent.value() + 1);
  agents_[agent] = Extremes();
}

void AgentExtremes::Set(PairSlot slot, AgentIndex a, AgentIndex b, const PairExtremes& pair) {
  if (!pairs_.contains(slot)) pairs_.resize(slot.value() + 1);
  const PairExtremes before = std::exchange(pairs_[slot], pair);
  for (const AgentIndex agent : {a, b}) {
    Extremes& extremes = agents_.at(agent);
    extremes.outdated = extremes.outdated || MovesAway(before, pair, extremes.of_pairs);
    extremes.of_pairs.contacts -= before.contacts;
    Include(pair, &extremes.of_pairs);
  }
}

const PairExtremes& AgentExtremes::Of(AgentIndex agent, const std::vector<PairSlot>& slots) const {
  Extremes& extremes = agents_.at(agent);
  if (extremes.outdated) extremes = {Over(slots)};
  return extremes.of_pairs;
}

PairExtremes AgentExtremes::Over(const std::vector<PairSlot>& slots) const {
  PairExtremes extremes;
  for (const PairSlot slot : slots) Include(pairs_.at(slot), &extremes);
  return extremes;
}

void AgentExtremes::Validate(AgentIndex agent, const std::vector<PairSlot>& slots) const {
  const Extremes& extremes = agents_.at(agent);
  CORE_CHECK(extremes.outdated || extremes.of_pairs == Over(slots),
             "an agent's extremes are those of its pairs", agent.value());
}

}  // namespace collision::detection
