// Clearance keys that rely on more than a renewed agent still promises.
#pragma once

#include <cstdint>
#include <vector>

#include "collision_core/detection/clearance/clearance_filter.h"
#include "collision_core/detection/clearance/search/band_query.h"

namespace collision::detection {

/// After a renewal, every partner whose key is later than its intersection with the renewed agent
/// gets the earlier one. Only keys of earlier steps need it (CoverageTable::IsSettled): a query in
/// the same step sees the new bound.
///
/// Keys up to a horizon are found with the broad phase, by where their agents are; each later key
/// is looked at by itself (ClearanceFilter, some 20 ns). So agents that are clear for long do not
/// make the query look as far ahead, where the renewed agent would meet every other. By counted
/// work the horizon moves to where both together cost least: farther where that spares more looks
/// than it costs, nearer where the query costs more than looking at all keys.
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
