// The partners that a question leaves out.
#pragma once

#include <cstdint>

#include "collision_core/base/ids.h"
#include "collision_core/detection/pairs/pair_table.h"

namespace collision::detection {

/// A set of partners of one agent, emptied in O(1); kept for its memory from one question to the
/// next.
class PartnerMarks {
 public:
  /// The agent and the partners that it is tracked with; `agents`: no index is as great.
  void Start(AgentIndex agent, const PairTable& pairs, std::size_t agents) {
    ++mark_;
    if (marks_.size() < agents) marks_.resize(agents, 0);
    for (const PairSlot slot : pairs.Of(agent)) {
      marks_.at(pairs[slot].lower) = marks_.at(pairs[slot].higher) = mark_;
    }
  }
  void Add(AgentIndex partner) { marks_.at(partner) = mark_; }
  /// False for an index beyond those that were there at Start().
  bool Contains(AgentIndex partner) const {
    return marks_.contains(partner) && marks_[partner] == mark_;
  }

 private:
  IndexedVector<AgentIndex, std::uint64_t> marks_;
  std::uint64_t mark_ = 0;
};

}  // namespace collision::detection
