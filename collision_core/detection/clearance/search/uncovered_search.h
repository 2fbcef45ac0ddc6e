// Intersections that lie before the newest states of two agents.
#pragma once

#include <vector>

#include "collision_core/detection/clearance/keys/coverage_table.h"
#include "collision_core/detection/clearance/search/clearance_query.h"
#include "collision_core/detection/clearance/search/pre_jump_motions.h"

namespace collision::detection {

/// A partner that the agent may have met before both newest states; the two were free up to here.
struct UncoveredPartner {
  AgentIndex partner;
  Instant free_until;
};

/// The broad phase answers from the newest states on. These may lie ahead of the time up to which a
/// pair is covered (an owner was granted more time than others, or news came out of order). Then
/// the time in between must be certified free as well, or the pair must be tracked and evaluated.
///
/// Each of the agent's motions since that time (a jump or a breach begins a new one) is replaced by
/// a ball at rest that contains it and is wider by as far as any agent of the scene may move in
/// that time. So a partner that met the agent overlaps that ball with its newest bound, or with the
/// motion it had before a jump. Among the partners found by their newest bounds, only those that
/// may have moved far enough are candidates: one very fast agent does not make all others
/// candidates of each other.
class UncoveredSearch {
 public:
  /// All outlive the search.
  UncoveredSearch(const DetectorContext& context, const CoverageTable& coverage,
                  broad_phase::NeighbourIndex* broad_phase, PreJumpMotions* former)
      : context_(context),
        queries_(context),
        coverage_(coverage),
        broad_phase_(broad_phase),
        former_(former) {}

  /// The partners to be tracked, in the order of their indices; valid until the next call.
  const std::vector<UncoveredPartner>& Find(const ClearanceQuery& query);

 private:
  void FindCandidates(const ClearanceQuery& query, Instant from);
  void AddAll();
  void FindAround(const ClearanceQuery& query, const motion::SpaceTimeBound& motion, Instant from);
  void Check(const ClearanceQuery& query, AgentIndex partner);
  double OwnReach(const motion::SpaceTimeBound& motion, Instant from) const;
  bool FreeOver(AgentIndex a, AgentIndex b, Instant from, Instant to) const;

  const DetectorContext context_;
  const PairQueries queries_;
  const CoverageTable& coverage_;
  broad_phase::NeighbourIndex* broad_phase_;
  PreJumpMotions* former_;
  // Scratch of one query, kept for its memory.
  std::vector<broad_phase::Neighbour> found_;
  std::vector<AgentIndex> candidates_;
  std::vector<UncoveredPartner> uncovered_;
};

/// The time from which the two are not certified free of each other; not before both were admitted.
Instant UncoveredFrom(const AgentRecord& a, const AgentRecord& b, Instant covered);

}  // namespace collision::detection
