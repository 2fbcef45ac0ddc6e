// A lower bound on the distance of two posed bodies, by the convex bodies around them.
#pragma once

#include "collision_core/base/work_budget.h"
#include "collision_core/narrow_phase/pose/posed_pair.h"

namespace collision::narrow_phase {

/// Directions tried at most; each costs a unit.
inline constexpr int kHullDirectionsMax = 5;
inline constexpr std::uint64_t kHullDirectionUnits = 1;

/// All of both bodies, including what is inside of them, is apart by at least this [m], translation
/// not included: the greatest gap between their shadows on the lines that were tried. No more lines
/// are tried once the gap exceeds `enough`, or where the bodies seem to be too deep in each other.
/// −infinity: nothing is known.
///
/// The first line is that of the shortest way between the middles, by the measure of both boxes,
/// across where a plane would stand between the boxes; then each line is mirrored at the plane
/// across the way between the two points that are foremost along it. Lines on which the bodies are
/// deep in each other are abandoned, the later the sooner. What is inside of a body is inside of
/// its convex body, so no containment test is needed. Source: Chung and Wang, "Quick collision
/// detection of polytopes in virtual environments", VRST 1996.
double HullGapOf(const PosedPair& pair, double enough, WorkBudget* work);

}  // namespace collision::narrow_phase
