// A lower bound on the distance of two posed bodies, from the outer hulls of both
// (shape/outer_hull.h).
#pragma once

#include "collision_core/base/work_budget.h"
#include "collision_core/narrow_phase/pose/posed_pair.h"

namespace collision::narrow_phase {

/// The largest number of directions that are tried, and the units of work of each.
inline constexpr int kHullDirectionsMax = 5;
inline constexpr std::uint64_t kHullDirectionUnits = 1;

/// Returns a lower bound [m] of the distance of the two bodies, their insides included: the
/// greatest gap between their projections onto the directions tried; −infinity: no bound is known.
/// The uncertainty of translation is not included. The search ends once the gap exceeds `enough`
/// [m], or where the bodies seem to overlap too deeply.
///
/// The first direction is S⁻¹ d, with d from the origin of A's hull to that of B's, and S the sum
/// of the matrices of two ellipsoids with the proportions of the boxes (OuterHull::measure()). Each
/// further direction is the last one reflected in the plane perpendicular to the vector between the
/// two foremost points. The search gives up while the least overlap found exceeds a share of the
/// extents, which halves with each direction. A hull contains the inside of its body, so no
/// containment test is needed. Source: Chung and Wang, "Quick collision detection of polytopes in
/// virtual environments", VRST 1996.
double HullGapOf(const PosedPair& pair, double enough, WorkBudget* work);

}  // namespace collision::narrow_phase
