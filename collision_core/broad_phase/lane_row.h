// Placed agents in one row, in no order: each is compared with all.
#pragma once

#include <cstdint>
#include <vector>

#include "collision_core/broad_phase/best_meeting.h"
#include "collision_core/broad_phase/lanes.h"

namespace collision {

class LaneRow {
 public:
  void Clear() { count_ = 0; }
  std::uint32_t size() const { return count_; }
  std::uint32_t agent(std::uint32_t k) const { return lanes_.agent(k); }

  void Add(const PlacedHorn& horn);
  /// Places between are vacant.
  void Set(std::uint32_t k, const PlacedHorn& horn);
  void Vacate(std::uint32_t k) { lanes_.Vacate(k); }

  /// Offers all pairs that come within reach of each other during the stretch, and others.
  void Join(const Placing& placing, Stretch stretch, BroadPhaseWork* work, PairSink* sink);

  /// Appends all who come within reach of `horn`.
  void FindNear(const PlacedHorn& horn, const Placing& placing, Stretch stretch,
                BroadPhaseWork* work, std::vector<std::uint32_t>* near);

 private:
  void Grow(std::uint32_t size);

  Lanes lanes_;
  std::uint32_t count_ = 0;
  double corner_[3] = {};
  std::vector<LaneRange> range_;  // kept for its memory, like these
  std::vector<std::uint32_t> hits_, near_;
};

}  // namespace collision
