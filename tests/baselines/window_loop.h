// The global loop with a list: all pairs that may meet within a window, found in one pass.
#pragma once

#include <memory>
#include <vector>

#include "collision_core/broad_phase/filter/point_grid.h"
#include "collision_core/broad_phase/sweeping_index.h"
#include "tests/baselines/collision_loop.h"

namespace collision::baselines {

/// Builds the bounds of all at t_build and lists the pairs that may come near within a window;
/// until its end each frame tests those, and looks at nothing else. A window is the longer, the
/// fewer the pairs: so that to make a list and to test it cost about the same.
///
/// All cubes are alike: the pass needs of each horn only where it is half-way through the window
/// and how far it reaches from there. Crowds, which suit no grid, are left to the broad phase
/// given.
class WindowLoop : public CollisionLoop {
 public:
  explicit WindowLoop(std::unique_ptr<broad_phase::SweepingIndex> phase)
      : phase_(std::move(phase)) {}

  std::optional<CubePair> Look(const MovingCubes& cubes) override;

 private:
  void MakeList(const MovingCubes& cubes);
  void ListAll(const MovingCubes& cubes);
  bool ListInOnePass(const MovingCubes& cubes);
  void ListByPhase(const MovingCubes& cubes);

  std::unique_ptr<broad_phase::SweepingIndex> phase_;
  std::int64_t frames_ = 2;    ///< The window's length.
  std::int64_t covered_ = -1;  ///< The last frame of which the list knows.
  broad_phase::PointGrid grid_;
  std::vector<broad_phase::NearPair> list_;
};

}  // namespace collision::baselines
