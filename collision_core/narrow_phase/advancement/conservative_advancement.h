// Conservative advancement: when two moving bodies may first touch, by their sphere trees.
//
// Points are followed along their tangents. What turning bends them away from these, ½ ω² |x| h²,
// counts as uncertainty, so that one sweep covers a quarter of a radian at most. Pairs of nodes are
// opened in the order of the times at which their moving balls may touch first, two leaves by their
// triangles. Each pair is convex, so its own direction may be used: bodies that pass by each other
// cost little. At equal times the pair that was opened the farthest comes first; balls within the
// solids that overlap at the start end a sweep at once.
//
// A leaf of a few large triangles (the floor below a landscape) has a ball that holds nearly
// everything; against a ball of less than an eighth of its radius its triangles are examined
// themselves. For a drone above such a closed landscape with a coarse tree that takes 12,000 units
// in the median instead of 70,000, and 50,000 at most instead of 3,100,000. A triangle may belong
// to several leaves, but two triangles are examined only once, from the time of the first pair of
// leaves on; the order of the search justifies this (derived at OfferElements).
//
// One choice of bounds serves a whole sweep, and all of them hold throughout; a sweep ends half-way
// between two states, where the other bounds become the narrower ones.
#pragma once

#include "collision_core/base/work_budget.h"
#include "collision_core/narrow_phase/advancement/swept_pose.h"
#include "collision_core/narrow_phase/pose/pair_parts.h"

namespace collision::narrow_phase {

/// Steps shorter than this share of the duration gain too little, unless the caller asks for more.
inline constexpr double kSweepStepWorth = 1e-3;

/// How far a search refines a time before it returns it.
struct SweepDetail {
  /// A pair of nodes is opened while the sum of its radii exceeds this share of the uncertainty at
  /// that time.
  double fine_enough = 0.25;
  /// A step shorter than this share of the duration ends the search.
  double step_worth = kSweepStepWorth;
};

/// A lower bound on the time at which the two may touch, and where.
struct ImpactBound {
  double seconds = 0;      ///< +infinity: not within the duration, its end included.
  bool exhausted = false;  ///< The work allowed was spent: the true time may be later.
  bool resolved = false;   ///< The bound comes from a pair of elements, not of nodes.
  NodePair leaves;         ///< If resolved: the leaves that may touch first; else the roots.
};

/// Best-first over pairs of nodes by the time at which their moving balls may touch first; two
/// leaves by their triangles. A pair of balls or of triangles is convex, so that for each the
/// direction between the two may be used: bodies that pass by each other cost little.
ImpactBound LowerBoundOfImpact(const SweptPair& pair, double duration, WorkBudget* work,
                               const SweepDetail& detail = {});

}  // namespace collision::narrow_phase
