// Where agents were on their way to before they jumped.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <vector>

#include "collision_core/broad_phase/neighbour_index.h"

namespace collision::detection {

/// An agent whose newest state lies after a jump may have met others before it, on its former
/// motion. Empty, and free of cost, in a scene where nobody jumps.
class FormerMotions {
 public:
  /// At most `motions_max` are kept; beyond, the oldest goes.
  FormerMotions(std::unique_ptr<broad_phase::NeighbourIndex> method, std::size_t motions_max)
      : method_(std::move(method)), motions_max_(motions_max) {}

  /// The agent moved within `bound` up to `until`.
  void Keep(std::uint32_t agent, motion::SpaceTimeBound bound, Instant until);

  /// Nobody will ask of a time before `since`.
  void Forget(Instant since);

  /// Appends the agents whose former motion may meet `around` in [from, until].
  void Find(const motion::SpaceTimeBound& around, Instant from, Instant until,
            std::vector<std::uint32_t>* agents);

  std::size_t size() const { return motions_.size(); }

 private:
  struct Motion {
    std::uint32_t index;  // in method_
    std::uint32_t agent;
    Instant until;
  };
  static constexpr std::uint32_t kAsking = 0;  // index of who asks

  void DropFirst();

  std::unique_ptr<broad_phase::NeighbourIndex> method_;
  std::size_t motions_max_;
  std::deque<Motion> motions_;         // in the order of their coming
  std::vector<std::uint32_t> agents_;  // by index in method_
  std::vector<std::uint32_t> free_;
  std::vector<broad_phase::Neighbour> found_;
};

}  // namespace collision::detection
