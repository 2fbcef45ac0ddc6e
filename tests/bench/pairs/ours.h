// Our methods: as the service uses them, for the contest, and over their settings.
#pragma once

#include <memory>

#include "collision_core/shape/shape.h"
#include "tests/bench/pairs/convex_pair.h"
#include "tests/bench/pairs/method.h"

namespace collision::bench {

/// The accuracy asked of distances, relative to the distance, and of brackets, of the diameter.
inline constexpr double kDistanceShare = 1e-6;
inline constexpr double kBracketShare = 0.01;

/// Decision, distance and bracket; from the pose as the caller has it to the certified answer.
PairMethods OurMesh(std::shared_ptr<const shape::Shape> shape, double diameter,
                    const std::string& name, Origin origin);
/// Decision and distance.
PairMethods OurConvex(const ConvexPair& pair);

/// Two trees of one mesh.
struct TwoTrees {
  std::shared_ptr<const shape::Shape> fitted, octree;
};

/// By budget, by width asked for, down to the triangles, yes or no, and many that share a budget.
PairMethods OurMeshCurves(const TwoTrees& trees);
PairMethods OurConvexCurves(const ConvexPair& pair);

}  // namespace collision::bench
