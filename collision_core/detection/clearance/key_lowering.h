// Clearance keys that rely on more than a renewed agent still promises.
#pragma once

#include <cstdint>
#include <vector>

#include "collision_core/detection/clearance/clearance_filter.h"
#include "collision_core/detection/clearance/search/band_query.h"

namespace collision::detection {

/// After a renewal, every partner whose key is later than its intersection with the renewed agent
/// gets the earlier one. Only keys of earlier steps need it (CoverageTable::IsLowerable): a query
/// in the same step sees the new bound.
///
/// A query of the broad phase finds the keys up to a horizon; each later key is examined singly
/// (ClearanceFilter, about 20 ns), because a query that far ahead would reach every agent. The
/// horizon follows counted work: outward if the examinations that the next horizon saves cost more
/// than twice the query, inward if the query costs more than all examinations beyond the horizon.
class KeyLowering {
 public:
  /// All outlive the object.
  KeyLowering(const DetectorContext& context, const QueryTargets& targets,
              const ClearanceFilter& filter)
      : context_(context),
        queries_(context),
        coverage_(targets.coverage),
        reported_(targets.reported),
        broad_phase_(targets.broad_phase),
        filter_(filter),
        horizons_(context.clock) {}

  /// Lowers the keys of all partners of `agent` but those in `tracked`, for intersections from
  /// `from` on.
  void Lower(AgentIndex agent, Instant from, const PartnerMarks& tracked);

  /// Partners examined besides the broad phase's own tests, since the start.
  std::uint64_t examined() const { return examined_; }

 private:
  struct Renewed {
    AgentIndex agent;
    Instant from;
    const PartnerMarks& tracked;
  };

  std::uint64_t LowerNear(const Renewed& renewed, Instant horizon);
  std::uint64_t LowerFar(const Renewed& renewed, Instant next, std::vector<AgentIndex>* far);
  void LowerOne(AgentIndex partner, AgentIndex agent, Instant when);

  const DetectorContext context_;
  const PairQueries queries_;
  CoverageTable* coverage_;
  ReportedClearances* reported_;
  broad_phase::NeighbourIndex* broad_phase_;
  const ClearanceFilter& filter_;
  const QueryHorizons horizons_;
  int split_ = 4;  // keys beyond this horizon are lowered one by one
  std::uint64_t examined_ = 0;
  // Scratch of one renewal, kept for its memory.
  std::vector<broad_phase::Neighbour> found_;
  std::vector<AgentIndex> far_;
};

}  // namespace collision::detection
