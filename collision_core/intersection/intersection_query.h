// A query to the broad phase, and the one routine that answers it for a pair.
#pragma once

#include <cstdint>

#include "collision_core/intersection/earliest_intersection.h"

namespace collision::intersection {

/// Which bound of an agent a query is about. The service and the benchmarks ask about horns alone;
/// hypertrapezoids, the bounds that the paper sweeps, are kept so that tests compare the face sweep
/// and every index with them too (methods_test, face_sweep_test, pair_margin_test).
enum class BoundKind {
  kHorn,            ///< The parabolic horn: the canonical answer.
  kHypertrapezoid,  ///< Its box with flat faces over the window: an earlier, cheaper answer.
};

/// A query to the broad phase: which agents may first meet in [from, until]?
struct BroadQuery {
  BoundKind bound = BoundKind::kHorn;
  Instant from;   ///< For hypertrapezoids: not before any agent's stamp.
  Instant until;  ///< For hypertrapezoids: the window's end, not Never().
};

/// When the two may first meet within the query's window, rounded down; +infinity: not within it.
/// For horns EarliestIntersection(), for hypertrapezoids their FirstOverlap(). Every method gives
/// these values, bit for bit. Symmetric. With a `margin` [m], finite and >= 0, the two meet where
/// they come within it of each other; the faces of hypertrapezoids are moved outward by half of it
/// each.
IntersectionTime EarliestIntersectionOf(const BroadQuery& query, const motion::SpaceTimeBound& a,
                                        const motion::SpaceTimeBound& b, double margin = 0);

/// Two agents, by index, lower < higher, and when they may first meet.
struct IntersectingPair {
  std::uint32_t lower = 0;
  std::uint32_t higher = 0;
  IntersectionTime time;

  /// Orders intersections by their instants, and those of equal instants by the agents' indices.
  friend bool operator<(const IntersectingPair& a, const IntersectingPair& b) {
    const Instant at_a = a.time.instant(), at_b = b.time.instant();
    if (at_a != at_b) return at_a < at_b;
    return a.lower != b.lower ? a.lower < b.lower : a.higher < b.higher;
  }
};

}  // namespace collision::intersection
