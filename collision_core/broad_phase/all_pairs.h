// The plainest method: ask every partner.
#pragma once

#include <optional>
#include <vector>

#include "collision_core/broad_phase/broad_phase.h"

namespace collision {

/// Asks the canonical routine for every partner: the oracle of the other methods, and below about a
/// thousand agents as fast as any.
class AllPairs : public BroadPhase {
 public:
  void Put(std::uint32_t agent, const SpaceTimeBound& bound) override;
  void Remove(std::uint32_t agent) override;
  void Meetings(std::uint32_t agent, Instant from, Instant until,
                const std::function<bool(std::uint32_t)>& skip,
                std::vector<Meeting>* meetings) const override;
  std::uint64_t pair_queries() const override { return pair_queries_; }

 private:
  std::vector<std::optional<SpaceTimeBound>> bounds_;  // by agent
  mutable std::uint64_t pair_queries_ = 0;
};

}  // namespace collision
