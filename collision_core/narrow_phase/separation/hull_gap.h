// A lower bound on the distance of two posed bodies, by the convex bodies around them.
#pragma once

#include "collision_core/base/work_budget.h"
#include "collision_core/narrow_phase/pose/posed_pair.h"

namespace collision::narrow_phase {

/// The largest number of directions that are tried, and the units of work of each.
inline constexpr int kHullDirectionsMax = 5;
inline constexpr std::uint64_t kHullDirectionUnits = 1;

/// Returns a lower bound [m] of the distance of the two bodies, their insides included: the
/// greatest gap between their shadows on the lines that were tried; −infinity: no bound is known.
/// The uncertainty of translation is not included. The search ends once the gap exceeds `enough`
/// [m], or where the bodies seem to overlap too deeply.
///
/// The first line is that of the shortest way between the middles, by the measure of both boxes,
/// perpendicular to a plane that would separate the boxes; then each line is mirrored at the plane
/// perpendicular to the way between the two points that are foremost along it. Lines on which the
/// bodies are deep in each other are abandoned, the later the sooner. What is inside of a body is
/// inside of its convex body, so no containment test is needed. Source: Chung and Wang, "Quick
/// collision detection of polytopes in virtual environments", VRST 1996.
double HullGapOf(const PosedPair& pair, double enough, WorkBudget* work);

}  // namespace collision::narrow_phase
