// The reference of the neighbour indices: every pair is given to the canonical routine.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "collision_core/broad_phase/sweeping_index.h"

namespace collision::broad_phase {

/// Asks EarliestIntersectionOf() about every pair, without a filter: the reference for the other
/// methods, and the only one for which the pairs that it examines depend on no other agent. O(N)
/// for one agent, O(N²) for all. Too slow to serve; no setting of the service selects it.
class ExhaustiveIndex : public SweepingIndex {
 public:
  explicit ExhaustiveIndex(SharedRules rules = NoRules()) : AgentBounds(std::move(rules)) {}

  void Set(std::uint32_t agent, const AgentBound& bound) override;
  void Remove(std::uint32_t agent) override;
  bool SetHalfSpace(std::uint32_t agent, const HalfSpace& half_space) override;
  void FindNeighbours(std::uint32_t agent, const NeighbourWindow& window, const Skip& skip,
                      std::vector<Neighbour>* neighbours) override;
  void FindNeighbours(const AgentBound& bound, Instant from, Instant until, const Skip& skip,
                      std::vector<Neighbour>* neighbours) override;
  std::optional<intersection::IntersectingPair> EarliestOf(
      std::uint32_t agent, const intersection::BroadQuery& query) override;
  void FindNearPairs(const intersection::BroadQuery& query, std::vector<NearPair>* pairs) override;
  std::optional<intersection::IntersectingPair> Earliest(
      const intersection::BroadQuery& query) override;
  BroadPhaseWork work() const override { return work_; }
  bool Contains(std::uint32_t agent) const override { return Holds(bounds_, agent); }

 private:
  /// One more than the greatest index, half-spaces included.
  std::uint32_t IndexEnd() const;
  /// When the two may first meet, if both are held and may meet at all.
  intersection::IntersectionTime TimeOf(const intersection::BroadQuery& query, std::uint32_t a,
                                        std::uint32_t b);

  BoundList bounds_;  // By agent.
  BroadPhaseWork work_;
};

}  // namespace collision::broad_phase
