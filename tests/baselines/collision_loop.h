// The loops that find the first collision of the moving cubes, frame by frame.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include "tests/baselines/moving_cubes.h"

namespace collision::baselines {

/// What a loop did since its start.
struct LoopWork {
  std::uint64_t pair_tests = 0;  ///< Of two cubes in one frame.
  std::uint64_t rebuilds = 0;    ///< Of one agent's bound, or its place in a grid.
  std::uint64_t queries = 0;     ///< To the broad phase.
};

/// Looks at every frame in turn, the first one included.
class CollisionLoop {
 public:
  virtual ~CollisionLoop() = default;
  /// The two that overlap in the present frame, of several those of the lowest indices; nullopt:
  /// none.
  virtual std::optional<CubePair> Look(const MovingCubes& cubes) = 0;
  const LoopWork& work() const { return work_; }

 protected:
  /// Tests two cubes and keeps the lower pair.
  void Test(const MovingCubes& cubes, std::uint32_t a, std::uint32_t b,
            std::optional<CubePair>* first) {
    ++work_.pair_tests;
    if (!cubes.Overlap(a, b)) return;
    const CubePair pair = std::minmax(a, b);
    if (!*first || pair < **first) *first = pair;
  }

  LoopWork work_;
};

/// The first collision of a run.
struct FirstCollision {
  std::int64_t frame = -1;  ///< -1: none within the frames looked at.
  CubePair pair{0, 0};

  friend bool operator==(const FirstCollision&, const FirstCollision&) = default;
};

/// Runs from the present frame on, for `frames` at most.
FirstCollision FindFirstCollision(MovingCubes* cubes, std::int64_t frames, CollisionLoop* loop);

}  // namespace collision::baselines
