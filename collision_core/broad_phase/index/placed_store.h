// Where a windowed search keeps the agents that it has placed: the part in which methods differ.
#pragma once

#include <cstdint>
#include <vector>

#include "collision_core/broad_phase/broad_phase_work.h"
#include "collision_core/broad_phase/filter/horn_table.h"
#include "collision_core/broad_phase/filter/pair_sink.h"
#include "collision_core/broad_phase/filter/placement_frame.h"

namespace collision::broad_phase {

/// What the searches of a store have cost.
struct SearchCost {
  BroadPhaseWork work;
  /// Tests since the last placement that a fresh one would have saved.
  std::uint64_t wasted = 0;
};

/// All agents, and the frame in which they are placed. Both belong to the search; they stay where
/// they are in memory as long as it exists.
struct PlacedScene {
  const HornTable* table;
  const PlacementFrame* frame;

  /// Whether the agent is too large or too far away for filters: then it is not placed, but tested
  /// directly.
  bool IsUnfilterable(std::uint32_t agent) const {
    return table->row(agent).unfilterable || frame->is_unfilterable();
  }
};

/// A structure over placed agents that finds those that come within reach of each other. Its
/// answers may contain other agents and pairs too (they are candidates), but never lack one.
class PlacedStore {
 public:
  virtual ~PlacedStore() = default;

  /// Replaces everything by `horns`: all agents of the scene that are not unfilterable, ascending.
  /// May swap the vector's memory with its own.
  virtual void PlaceAll(const PlacedScene& scene, std::vector<PlacedBall>* horns) = 0;
  /// Prepares for Join() alone, of a window up to `last` at first. Unchecked: FindNear() does
  /// not follow. Returns false if that would be no cheaper than PlaceAll().
  virtual bool PlaceForJoin(const PlacedScene& /*scene*/, double /*last*/) { return false; }
  /// Adds an agent that is not placed.
  virtual void Place(const PlacedBall& horn) = 0;
  /// Removes the agent, if it is placed.
  virtual void Unplace(std::uint32_t agent) = 0;

  /// Offers all pairs that come within reach of each other during the window, and others; for the
  /// one-shot queries (sweeping_index.h). Returns false, and offers none, if the store was only
  /// prepared for a shorter window: PlaceAll() first.
  virtual bool Join(const PlacedScene& scene, TimeWindow window, SearchCost* cost,
                    PairSink* sink) = 0;
  /// Appends all agents that come within reach of `horn` during the window, and others.
  virtual void FindNear(const PlacedScene& scene, const PlacedBall& horn, TimeWindow window,
                        SearchCost* cost, std::vector<std::uint32_t>* near) = 0;

  /// Whether FindNear() can find the agent: it is placed, and has not been taken away since.
  virtual bool Holds(std::uint32_t agent) const = 0;

  /// Walks the structure: every agent that is placed stands where FindNear() looks for it, once.
  /// Throws CheckFailure.
  virtual void Validate() const = 0;
};

}  // namespace collision::broad_phase
