// Which agents can one agent meet: the incremental interface of the broad phase.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <vector>

#include "collision_core/broad_phase/agent_bounds.h"
#include "collision_core/broad_phase/broad_phase_work.h"
#include "collision_core/intersection/intersection_query.h"

namespace collision::broad_phase {

/// A partner, and the earliest possible intersection with it.
struct Neighbour {
  std::uint32_t partner;
  intersection::IntersectionTime time;
};

/// When neighbours are looked for: all in [from, until], and the earliest in (until, horizon].
struct NeighbourWindow {
  Instant from, until, horizon;
};

/// Finds the neighbours of an agent, or of any bound, among the bounds that are held, while these
/// change one at a time.
///
/// Methods differ in cost, never in their answers: each time is EarliestIntersectionOf() of the two
/// bounds, or of a half-space and a bound, with the pair's margin, bit for bit. Excluded pairs
/// never meet. methods_test compares every method with the canonical routine for every pair.
class NeighbourIndex : public virtual AgentBounds {
 public:
  using Skip = std::function<bool(std::uint32_t)>;

  /// Replaces the bound of an agent by one that lies inside it; cheaper than Set(). Unchecked:
  /// it does lie inside.
  virtual void Tighten(std::uint32_t agent, const AgentBound& bound) { Set(agent, bound); }

  /// Appends each partner whose earliest possible intersection with `agent` (an agent or a
  /// half-space; by horns) lies in [window.from, window.until], and of the others the earliest up
  /// to window.horizon. Sorted by partner; partners for which `skip` holds are left out. Appends
  /// nothing if no agent or half-space has this index.
  virtual void FindNeighbours(std::uint32_t agent, const NeighbourWindow& window, const Skip& skip,
                              std::vector<Neighbour>* neighbours) = 0;

  /// Appends each agent or half-space that may first meet `bound` in [from, until], likewise in
  /// order. `bound` is of no agent that is held, so no rule applies to it.
  virtual void FindNeighbours(const AgentBound& bound, Instant from, Instant until,
                              const Skip& skip, std::vector<Neighbour>* neighbours) = 0;

  virtual BroadPhaseWork work() const = 0;
};

/// Sorts the entries from `first` on by partner.
inline void SortByPartner(std::size_t first, std::vector<Neighbour>* neighbours) {
  std::sort(neighbours->begin() + static_cast<std::ptrdiff_t>(first), neighbours->end(),
            [](const Neighbour& a, const Neighbour& b) { return a.partner < b.partner; });
}

/// Appends the neighbour if its time is `until` or earlier.
inline void AppendIfBy(Instant until, const Neighbour& neighbour,
                       std::vector<Neighbour>* neighbours) {
  const Instant when = neighbour.time.instant();
  if (when <= until && !when.is_never()) neighbours->push_back(neighbour);
}

}  // namespace collision::broad_phase
