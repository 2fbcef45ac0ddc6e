// Pairs of convex solids of ours, and the solids that are measured.
#pragma once

#include <vector>

#include "collision_core/shape/convex_solid.h"
#include "tests/bench/pairs/plain_convex.h"
#include "tests/bench/pairs/pose.h"

namespace collision::bench {

/// A capsule, a box and a hull of 18 points, all of a bounding diameter of 2 m.
std::vector<PlainConvex> Convexes();

shape::ConvexDescription DescriptionOf(const PlainConvex& convex);
inline shape::ConvexSolid SolidOf(const PlainConvex& convex) {
  return shape::ConvexSolid::Build(DescriptionOf(convex));
}

struct ConvexPair {
  shape::ConvexSolid a, b;

  narrow_phase::Verdict VerdictAt(const narrow_phase::RelativePose& pose) const;
  /// Until it is narrow enough: relative to its lower end `share`, or `width` [m].
  numeric::Interval DistanceAt(const narrow_phase::RelativePose& pose, double share,
                               double width) const;
};

PairOracle OracleOf(const ConvexPair& pair);

}  // namespace collision::bench
