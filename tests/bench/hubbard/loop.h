// The methods that find the ships that touch in each frame: a broad phase and an exact comparison.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "collision_core/broad_phase/sweeping_index.h"
#include "tests/baselines/bsp_tree.h"
#include "tests/bench/hubbard/flight.h"

namespace collision::bench {

/// Appends every pair whose balls overlap in the frame, in any order. Frames come one by one.
class ShipBroadPhase {
 public:
  virtual ~ShipBroadPhase() = default;
  virtual void Look(const Flight& flight, std::int64_t frame, std::vector<ShipPair>* near) = 0;
};

/// Turk's uniform grid in a hash table, made anew each frame, as baselines/turk_hash.h for balls.
std::unique_ptr<ShipBroadPhase> MakeTurk(double cell);

/// Pairs that may meet within a window, in one query; each of them is looked at again when it
/// may meet first, computed from its newest states. A ship that bounced is asked about anew.
std::unique_ptr<ShipBroadPhase> MakeHorns(std::unique_ptr<broad_phase::SweepingIndex> phase);

/// Whether two ships touch in a frame.
using ShipComparison = std::function<bool(const Flight&, std::int64_t, const ShipPair&)>;
ShipComparison BySphereTrees(const ShipKind& spaceship, const ShipKind& drone);
ShipComparison ByBspTrees(const ShipKind& spaceship, const ShipKind& drone);

}  // namespace collision::bench
