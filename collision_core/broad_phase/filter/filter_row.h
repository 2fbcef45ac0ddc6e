// Placed agents in one row, in no order: each is compared with all.
#pragma once

#include <cstdint>
#include <vector>

#include "collision_core/broad_phase/broad_phase_work.h"
#include "collision_core/broad_phase/filter/pair_sink.h"
#include "collision_core/broad_phase/filter/placed_balls.h"

namespace collision::broad_phase {

/// Placed balls in one row of lanes. Comparing a ball with the row costs a filter test for each
/// place.
class FilterRow {
 public:
  void Clear() { count_ = 0; }
  std::uint32_t size() const { return count_; }
  std::uint32_t agent(std::uint32_t k) const { return lanes_.agent(k); }

  /// Stores the ball at a new place.
  void Add(const PlacedBall& horn);
  /// Stores the ball at place k; new places before it are vacant.
  void Set(std::uint32_t k, const PlacedBall& horn);
  void Vacate(std::uint32_t k) { lanes_.Vacate(k); }

  /// Offers all pairs that come within reach of each other during the window, and possibly
  /// others.
  void Join(const PlacementFrame& frame, TimeWindow window, BroadPhaseWork* work, PairSink* sink);

  /// Appends all agents that come within reach of `horn`.
  void FindNear(const PlacedBall& horn, const PlacementFrame& frame, TimeWindow window,
                BroadPhaseWork* work, std::vector<std::uint32_t>* near);

  /// Walks the row: as many lanes as places, no agent twice, positions and reaches that a filter
  /// can compare. Throws CheckFailure.
  void Validate() const;

 private:
  void Grow(std::uint32_t size);

  PlacedBalls lanes_;
  std::uint32_t count_ = 0;
  double corner_[3] = {};
  std::vector<FilterRange> range_;  ///< Scratch, like the next line.
  std::vector<std::uint32_t> hits_, near_;
};

}  // namespace collision::broad_phase
