// A neighbour index that answers one-shot queries too.
#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <vector>

#include "collision_core/broad_phase/earliest_sweep.h"
#include "collision_core/broad_phase/neighbour_index.h"

namespace collision::broad_phase {

/// Two agents that may meet, lower < higher.
struct NearPair {
  std::uint32_t lower, higher;

  friend auto operator<=>(const NearPair&, const NearPair&) = default;
};

/// A method that answers both kinds of queries about the bounds it holds, and two one-shot queries
/// that only an index answers well. The detector calls none of the one-shot queries; all methods
/// but FaceSweep have them, so that the same code that serves is measured and tested by them.
class SweepingIndex : public NeighbourIndex, public EarliestSweep {
 public:
  /// The earliest possible intersection of one agent with any other within the query's window; of
  /// equal ones that of the lower indices. nullopt: none.
  ///
  /// Callers, none of them in the service: the incremental benchmark of the broad phase
  /// (tests/bench/broad_phase/incremental.cc) and the tests of the methods.
  virtual std::optional<intersection::IntersectingPair> EarliestOf(
      std::uint32_t agent, const intersection::BroadQuery& query) = 0;

  /// Appends every pair that may first meet within the query's window, and others that are near,
  /// each once; pairs that cannot meet at all are left out. Much cheaper than FindNeighbours() of
  /// every agent.
  ///
  /// Callers, none of them in the service: a collision loop that asks about one frame after the
  /// other (tests/baselines/window_loop.h) and the benchmark with the paper's ships
  /// (tests/bench/hubbard/loop.h).
  virtual void FindNearPairs(const intersection::BroadQuery& query,
                             std::vector<NearPair>* pairs) = 0;

  BroadPhaseWork work() const override = 0;
};

}  // namespace collision::broad_phase
