// The input of each part of the canonical routine: two bounds, and when they count as meeting.
#pragma once

#include "collision_core/motion/space_time_bound.h"

namespace collision::intersection {

/// Two bounds as seen from `base`, from which seconds are counted. They meet where they come within
/// `margin` of each other. The base is not before either stamp (QuickHornPair() checks it); the
/// margin is finite and >= 0 (EarliestIntersection() checks it). The bounds outlive the pair.
struct BoundPair {
  const motion::SpaceTimeBound &a, &b;
  Instant base;
  double margin = 0;  ///< [m]
};

}  // namespace collision::intersection
