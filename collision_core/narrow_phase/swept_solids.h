// How long two convex elements in motion stay apart.
#pragma once

#include "collision_core/narrow_phase/convex_front.h"
#include "collision_core/narrow_phase/swept_pair.h"

namespace collision {

/// A convex set whose points move along their tangents.
struct MovingSet {
  ConvexSet set;  ///< At the start.
  TangentMotion motion;
};

/// Two sets, and what is used up of the gap between them t seconds after the start.
struct SweptSolids {
  MovingSet a, b;
  SweptPose::Growth used;  ///< c2 >= 0.
};

/// Apart at `h`, they stay apart for so many seconds more, along the direction between them there;
/// 0 where they are not certain to be apart, +infinity: beyond `duration`, it included.
///
/// Along a fixed direction n the front of a set that moves along tangents is the greatest of
/// functions that are linear in time, so that it is convex, and what is left of the gap concave: a
/// gap at two instants is a gap between them. So the time is found as closely as doubles allow, by
/// chords, and no speed of the fastest point comes in.
double StaysApart(const SweptSolids& solids, double h, double duration, Work* work);

}  // namespace collision
