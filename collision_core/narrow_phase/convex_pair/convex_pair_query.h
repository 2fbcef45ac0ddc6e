// Two convex solids at a pose: the fast answers to the most frequent queries.
//
// A query for yes or no, or for the distance alone, need not pay for points, normals and features.
// Each way below proves its answer; where it cannot, the full search (convex_search.h) answers.
//
// - A ball or capsule against a ball, capsule or box (capsule_distance.h): the nearest points of
//   two segments, or of a segment and a box, then the length between them and the gap along it.
// - Two boxes, or a box and a capsule (box_separating_axis.h): the separating axis test of all
//   fifteen axes, three at once, in the coordinates x' = Gᵀx of A's edges: the edges of
//   neither box need be exactly orthogonal.
// - Hulls of up to 64 points (gjk_small.h): GJK in plain numbers, all points of a hull at once.
//   It begins along (A + B)⁻¹ d, the normal where d leaves two ellipsoids about as large as the
//   two: that alone decides most that are a tenth of their diameter apart. A tetrahedron that holds
//   a small ball about 0 is contact.
//
// The same bits with AVX2 and without. `./run bench narrow-phase --only 'convex '` measures: boxes
// a tenth of their diameter apart in 40 ns, overlapping by a thousandth in 65 ns; a capsule against
// a box 37 and 130 ns; two capsules 34 ns; two hulls of 18 points 110 and 640 ns. The full
// search takes one and a half to six times as long.
#pragma once

#include "collision_core/narrow_phase/convex_pair/convex_distance.h"
#include "collision_core/narrow_phase/pose/verdict.h"

namespace collision::narrow_phase {

/// Units of work of a closed form, and of a quick search: some three to eight steps.
inline constexpr std::uint64_t kSeparatingAxisUnits = 1;
inline constexpr std::uint64_t kSmallGjkUnits = 8;

/// Whether they touch, each set given in its own body's frame. Includes all uncertainty of the
/// pose, also that of translation.
Verdict DecideConvexPair(const geometry::ConvexSet& a, const geometry::ConvexSet& b,
                         const RelativePose& pose, WorkBudget* work);

/// Only ConvexSeparation::separation, each set given in its own body's frame; the uncertainty of
/// translation is not included. With ConvexGoal::kDistance the lower end is no bound of the depth
/// where they overlap. Callers, none of them in the service: benchmarks (tests/bench/pairs/ours.cc)
/// and tests.
numeric::Interval SeparationOfConvexPair(const geometry::ConvexSet& a, const geometry::ConvexSet& b,
                                         const RelativePose& pose, const ConvexQuery& query,
                                         WorkBudget* work);

}  // namespace collision::narrow_phase
