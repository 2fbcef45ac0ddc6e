// When two bodies that turn fast may first touch, whatever their angles are.
//
// Beyond a turn the bodies are replaced by what they sweep in all their turns: a part that turns
// about an axis stays in a ring of heights and distances from it. Convex solids count by the box of
// their axes, capsules by their segment: with their balls alone a bar of 4 m at 10⁶ rad/s below a
// ball that falls on it took 17,600,000 units without an answer, with them 33,000 for all 12
// digits. What flies past a rotor is free at the cost of one turn, or of a hundred thousand. The
// query may cost as much again as the sweeps since it was made last.
#pragma once

#include "collision_core/base/work_budget.h"
#include "collision_core/narrow_phase/advancement/swept_pose.h"

namespace collision::narrow_phase {

/// A lower bound on the time at which the two may touch, as of LowerBoundOfImpact(), but with each
/// body that turns replaced by everything that it sweeps in a full turn about its axis: the times
/// do not depend on how often it turns. `swept.turning_A` and `turning_B` are without the tangents'
/// deviation. +infinity: not within the duration, its end included.
double SweptRingBound(const SweptPair& pair, double duration, WorkBudget* work);

}  // namespace collision::narrow_phase
