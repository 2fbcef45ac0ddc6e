// Peers of convex solids, over their tolerances.
#pragma once

#include "tests/bench/narrow_convex.h"
#include "tests/bench/precision_query.h"

namespace collision::bench {

/// Each library has routines of its own for a pair of kinds, or a search for all.
PrecisionMethods FclConvexMethods(const PlainConvex& a, const PlainConvex& b);
PrecisionMethods BulletConvexMethods(const PlainConvex& a, const PlainConvex& b);
PrecisionMethods ConvexPeers(const PlainConvex& a, const PlainConvex& b);

}  // namespace collision::bench
