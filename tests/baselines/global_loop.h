// The paper's loop: nothing until t_end, then every bound anew.
#pragma once

#include <memory>
#include <vector>

#include "collision_core/broad_phase/earliest_sweep.h"
#include "collision_core/broad_phase/index/all_pairs.h"
#include "tests/baselines/collision_loop.h"

namespace collision::baselines {

/// Builds the bounds of all at t_build and asks for t_end, the earliest possible intersection of
/// all. Before t_end no frame is looked at. Then it builds again; if the new t_end is not later
/// than the minimum temporal resolution Δt (a frame), the pairs that could overlap are tested, and
/// the next frame is t_end. Source: Hubbard 1995, section 4.
class GlobalLoop : public CollisionLoop {
 public:
  explicit GlobalLoop(std::unique_ptr<broad_phase::EarliestSweep> sweep)
      : sweep_(std::move(sweep)) {}

  std::optional<CubePair> Look(const MovingCubes& cubes) override;

 private:
  std::unique_ptr<broad_phase::EarliestSweep> sweep_;
  broad_phase::AllPairs near_;  ///< The same bounds, for the pairs that could overlap.
  Instant t_end_ = Instant::Always();
  std::vector<intersection::IntersectingPair> could_overlap_;
};

}  // namespace collision::baselines
