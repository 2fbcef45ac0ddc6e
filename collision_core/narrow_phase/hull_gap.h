// How far two posed bodies are apart at least, by convex bodies around them.
#pragma once

#include "collision_core/narrow_phase/separation.h"

namespace collision {

/// Directions tried at most; each costs a unit.
inline constexpr int kHullDirectionsMax = 5;
inline constexpr std::uint64_t kHullDirectionUnits = 1;

/// All of both bodies, what is inside of them included, is apart by at least this, translation not
/// counted: the greatest gap between their shadows on the lines that were tried. No more of them are
/// tried once it is more than `enough`, or where the bodies seem to be too deep in each other.
/// −infinity: nothing is known.
///
/// The first line is that of the shortest way between the middles, by the measure of both boxes; then
/// each one is mirrored at the plane across the way between the two points that are foremost along
/// it. Source: Chung and Wang, "Quick collision detection of polytopes in virtual environments", VRST
/// 1996.
double HullGapOf(const Surface& a, const Surface& b, const RelativePose& pose, double enough,
                 Work* work);

}  // namespace collision
