// Our methods over their settings.
#pragma once

#include <memory>

#include "collision_core/shape/shape.h"
#include "tests/bench/narrow_convex_pair.h"
#include "tests/bench/precision_query.h"

namespace collision::bench {

/// Two trees of one mesh.
struct TwoTrees {
  std::shared_ptr<const shape::Shape> fitted, octree;
};

/// By budget, by width asked for, down to the triangles, yes or no, and many that share a budget.
PrecisionMethods OurMeshMethods(const TwoTrees& trees);

PrecisionMethods OurConvexMethods(const ConvexPair& pair);

}  // namespace collision::bench
