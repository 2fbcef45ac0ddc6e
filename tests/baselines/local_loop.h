// The paper's loop made local: each agent is asked again when its own time comes.
#pragma once

#include <memory>
#include <vector>

#include "collision_core/base/event_queue.h"
#include "collision_core/broad_phase/neighbour_index.h"
#include "tests/baselines/collision_loop.h"

namespace collision::baselines {

/// A queue of agents by the earliest time at which one of their pairs may meet. Only when an
/// agent's time comes are its bound and its partner's built from their newest states, and is it
/// asked again. Pairs that could overlap within the minimum temporal resolution Δt (a frame) leave
/// the queue and are tested in each frame, until they are well apart.
class LocalLoop : public CollisionLoop {
 public:
  explicit LocalLoop(std::unique_ptr<broad_phase::NeighbourIndex> phase)
      : phase_(std::move(phase)) {}

  std::optional<CubePair> Look(const MovingCubes& cubes) override;

 private:
  void Start(const MovingCubes& cubes);
  /// The cube's bound as of the present frame. False: it was so already.
  bool Renew(const MovingCubes& cubes, std::uint32_t cube);
  void Ask(const MovingCubes& cubes, std::uint32_t cube);
  /// Tests the pairs at hand; those well apart go back to the queue.
  std::optional<CubePair> TestClosePairs(const MovingCubes& cubes);
  bool IsClose(std::uint32_t a, std::uint32_t b) const;

  std::unique_ptr<broad_phase::NeighbourIndex> phase_;
  EventQueue<AgentIndex> queue_;
  std::vector<Instant> keys_;                         ///< By cube, as in the queue.
  std::vector<std::int64_t> frame_of_bound_;          ///< By cube.
  std::vector<CubePair> close_;                       ///< Pairs that could overlap.
  std::vector<std::vector<std::uint32_t>> partners_;  ///< By cube: those in `close_`.
  std::vector<broad_phase::Neighbour> meetings_;
};

}  // namespace collision::baselines
