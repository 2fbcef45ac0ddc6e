// The plainest method: ask every partner.
#pragma once

#include <optional>
#include <vector>

#include "collision_core/broad_phase/broad_phase.h"

namespace collision {

/// Looks at every pair: the oracle of the other methods, and below about a thousand agents as fast
/// as any.
class AllPairs : public BroadPhase {
 public:
  void Put(std::uint32_t agent, const SpaceTimeBound& bound) override;
  void Remove(std::uint32_t agent) override;
  std::optional<PairMeeting> Earliest(const BroadQuery& query) override;
  std::optional<PairMeeting> EarliestOf(std::uint32_t agent, const BroadQuery& query) override;
  void Meetings(std::uint32_t agent, Instant from, Instant until, Instant horizon, const Skip& skip,
                std::vector<Meeting>* meetings) override;
  BroadPhaseWork work() const override { return work_; }

 private:
  /// Offers every meeting of `agent` with partners from index `first` on.
  void OfferMeetings(std::uint32_t agent, std::uint32_t first, const BroadQuery& query,
                     std::optional<PairMeeting>* best);

  std::vector<std::optional<SpaceTimeBound>> bounds_;  // by agent
  BroadPhaseWork work_;
};

}  // namespace collision
