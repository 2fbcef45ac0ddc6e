// The global loop with a list: all pairs that may meet within a window, found in one pass.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "collision_core/broad_phase/broad_phase.h"
#include "tests/baselines/collision_loop.h"

namespace collision::baselines {

/// Builds the bounds of all at t_build and asks for the earliest meeting within a window. None, or
/// one that comes late: nothing is looked at until then. Else it lists the pairs that may meet
/// within the window, in the order of their times; until the window's end each frame tests those
/// whose time has come, and looks at nothing else. The window grows while little comes of it, and
/// shrinks when the list is long.
class WindowLoop : public CollisionLoop {
 public:
  explicit WindowLoop(std::unique_ptr<BroadPhase> phase) : phase_(std::move(phase)) {}

  std::optional<CubePair> Look(const MovingCubes& cubes) override;

 private:
  void Rebuild(const MovingCubes& cubes);
  /// True if nothing meets for the greater part of the window, which is then all that is covered.
  bool IsClear(const MovingCubes& cubes);
  void MakeList(const MovingCubes& cubes);

  std::unique_ptr<BroadPhase> phase_;
  std::int64_t frames_ = 2;    ///< The window's length.
  std::int64_t covered_ = -1;  ///< The last frame of which the list knows.
  std::size_t due_ = 0;        ///< So many of the list may overlap by now.
  std::vector<PairMeeting> list_;
};

}  // namespace collision::baselines
