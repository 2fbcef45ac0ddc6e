// Motions of agents that their newest bounds do not contain.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <vector>

#include "collision_core/base/ids.h"
#include "collision_core/broad_phase/neighbour_index.h"

namespace collision::detection {

/// An agent whose newest state lies after a jump may have met others before the jump. Holds, by
/// time, the motions that a jump or a narrower declaration ended. It is empty, and costs nothing,
/// in a scene without either.
class PreJumpMotions {
 public:
  /// Keeps at most `motions_max`; beyond, it drops the oldest. Unchecked: `method` is empty.
  PreJumpMotions(std::unique_ptr<broad_phase::NeighbourIndex> method, std::size_t motions_max)
      : method_(std::move(method)), motions_max_(motions_max) {}

  /// The agent moved within `bound` up to `until`.
  void Record(AgentIndex agent, broad_phase::AgentBound bound, Instant until);

  /// No query will be about a time before `since`.
  void Forget(Instant since);

  /// Appends the agents whose former motion may meet `around` in [from, until]; an agent may appear
  /// several times.
  void Find(const broad_phase::AgentBound& around, Instant from, Instant until,
            std::vector<AgentIndex>* agents);

  std::size_t size() const { return motions_.size(); }

  /// Walks the motions and their index: each place has a motion that the index holds, or is free.
  void Validate() const;

 private:
  struct Motion {
    std::uint32_t place;  // in method_
    Instant until;
  };

  void DropFirst();

  std::unique_ptr<broad_phase::NeighbourIndex> method_;
  std::size_t motions_max_;
  std::deque<Motion> motions_;      // in the order of Record()
  std::vector<AgentIndex> agents_;  // by place
  std::vector<std::uint32_t> free_;
  std::vector<broad_phase::Neighbour> found_;  // scratch of one query, kept for its memory
};

}  // namespace collision::detection
