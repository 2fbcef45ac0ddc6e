// When two bodies that turn fast may first touch, whatever their angles are.
//
// Over spans in which a body turns by more than 6 rad, each body is replaced by everything that it
// sweeps in a full turn: a part that turns about an axis stays in a ring of heights and distances
// from it. Convex solids count by the box of their axes, capsules by their segment: with their
// balls alone a bar of 4 m at 10⁶ rad/s below a ball that falls on it took 17,600,000 units without
// an answer, with them 33,000 for all 12 digits. A body that flies past a rotor is certified free
// at the same cost, whether the rotor turns once or a hundred thousand times. ContactBoundary
// allows each query as much work as the sweeps since the last one, and at least 4,096 units.
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
