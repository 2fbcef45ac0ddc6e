#include "collision_core/detection/clearance/search/next_neighbour_search.h"

#include <algorithm>

namespace collision::detection {
namespace {

/// Up to this many partners are queried at once; beyond, one in kSampleShare is queried first.
constexpr std::size_t kAllAsked = 64;
constexpr std::size_t kSampleShare = 32;

/// A search without an answer goes on one horizon farther, then two at a time.
constexpr int kStrideMax = 2;

}  // namespace

NextNeighbour NextNeighbourSearch::EarliestOf(const std::vector<broad_phase::Neighbour>& neighbours,
                                              const PartnerMarks& tracked) {
  NextNeighbour next;
  for (const broad_phase::Neighbour& neighbour : neighbours) {
    const AgentIndex partner(neighbour.partner);
    if (tracked.Contains(partner) || neighbour.time.instant() >= next.when) continue;
    next = {neighbour.time.instant(), partner};
  }
  return next;
}

NextNeighbour NextNeighbourSearch::Find(const ClearanceQuery& query, Instant known) {
  NextNeighbour next;
  int stride = 0;
  for (int step = Begin(query); next.when.is_never() && !known.is_never(); step += stride) {
    stride = std::min(stride + 1, kStrideMax);
    const Instant until = horizons_.At(step);
    if (until <= known) continue;
    FindUpTo(query, known, until);
    next = EarliestOf(found_, *query.tracked);
    known = until;
  }
  Record(query, next.when);
  return next;
}

void NextNeighbourSearch::FindUpTo(const ClearanceQuery& query, Instant known, Instant horizon) {
  const std::uint32_t agent = query.agent.value();
  std::size_t offered = 0, left_out = 0;
  const auto sample = [&](std::uint32_t partner) {
    if (query.LeavesOut(AgentIndex(partner), tiers_)) return true;
    if (++offered <= kAllAsked || offered % kSampleShare == 0) return false;
    ++left_out;
    return true;
  };
  found_.clear();
  broad_phase_->FindNeighbours(agent, {query.from, known, horizon}, sample, &found_);
  examined_ += offered - left_out;
  if (left_out == 0) return;
  if (!found_.empty()) horizon = found_.front().time.instant();
  const auto all = [&](std::uint32_t partner) {
    if (query.LeavesOut(AgentIndex(partner), tiers_)) return true;
    ++examined_;
    return false;
  };
  found_.clear();
  broad_phase_->FindNeighbours(agent, {query.from, known, horizon}, all, &found_);
}

}  // namespace collision::detection
