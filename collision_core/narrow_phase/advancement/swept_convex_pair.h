// How long two convex elements in motion stay apart.
//
// Along a fixed direction the front of a convex set that moves along tangents is convex in time, so
// what is left of a gap is concave: gaps at two instants are a gap between them. The time until it
// is used up is found by chords, to the last bits, and a direction serves until its own gap is
// gone: two boxes that meet face on are done in one step.
#pragma once

#include "collision_core/base/work_budget.h"
#include "collision_core/narrow_phase/advancement/swept_pose.h"
#include "collision_core/narrow_phase/convex_pair/convex_front.h"

namespace collision::narrow_phase {

/// A convex set whose points move along their tangents.
struct MovingSet {
  geometry::ConvexSet set;  ///< At the start.
  TangentMotion motion;
};

/// Two sets, and what is used up of the gap between them t seconds after the start.
struct SweptConvexPair {
  MovingSet a, b;
  SweptPose::Growth used;  ///< c2 >= 0.
};

/// Returns for how many seconds from `h` on the two certainly stay apart along the direction
/// between them at `h`: 0 if they are not certainly apart there, +infinity if they stay apart up to
/// `duration`, its end included.
double ApartFor(const SweptConvexPair& solids, double h, double duration, WorkBudget* work);

}  // namespace collision::narrow_phase
