#include "tests/bench/pairs/convex_pair.h"

#include <algorithm>

#include "collision_core/narrow_phase/convex_pair/convex_pair_query.h"
#include "tests/bench/pairs/bench_mesh.h"
#include "tests/collision_core/sphere_tree/meshes.h"

namespace collision::bench {
namespace {

/// Points on an ellipsoid: as many as engines make of a body.
PlainMesh HullMesh() {
  geometry::TriangleMesh mesh = Sphere(1);
  for (Eigen::Vector3d& p : mesh.vertices) p = p.cwiseProduct(Eigen::Vector3d(1, 0.7, 0.5));
  return PlainOf(mesh);
}

}  // namespace

std::vector<PlainConvex> Convexes() {
  return {{"capsule", PlainConvex::Kind::kCapsule, {0, 0, 0.6}, 0.4, {}},
          // 2² + 3² + 6² = 7².
          {"box", PlainConvex::Kind::kBox, {2.0 / 7, 3.0 / 7, 6.0 / 7}, 0, {}},
          {"hull", PlainConvex::Kind::kHull, {}, 0, HullMesh()}};
}

shape::ConvexDescription DescriptionOf(const PlainConvex& convex) {
  shape::ConvexDescription description;
  description.half = {convex.half[0], convex.half[1], convex.half[2]};
  description.rounding = convex.radius;
  switch (convex.kind) {
    case PlainConvex::Kind::kCapsule:
      description.core = geometry::ConvexCore::kSegment;
      break;
    case PlainConvex::Kind::kBox:
      description.core = geometry::ConvexCore::kBox;
      break;
    case PlainConvex::Kind::kHull:
      description.core = geometry::ConvexCore::kHull;
      for (const auto& p : convex.hull.vertices) description.points.emplace_back(p[0], p[1], p[2]);
  }
  return description;
}

narrow_phase::Verdict ConvexPair::VerdictAt(const narrow_phase::RelativePose& pose) const {
  WorkBudget work(kUnlimited);
  return DecideConvexPair(a.set(), b.set(), pose, &work);
}

numeric::Interval ConvexPair::DistanceAt(const narrow_phase::RelativePose& pose, double share,
                                         double width) const {
  WorkBudget work(kUnlimited);
  const numeric::Interval separation =
      SeparationOfConvexPair(a.set(), b.set(), pose,
                             {.goal = narrow_phase::ConvexGoal::kDistance,
                              .relative_tolerance = share,
                              .absolute_tolerance = width},
                             &work);
  return {std::max(0.0, separation.lower), std::max(0.0, separation.upper)};
}

PairOracle OracleOf(const ConvexPair& pair) {
  return {[pair](const narrow_phase::RelativePose& pose) { return pair.VerdictAt(pose); },
          [pair](const narrow_phase::RelativePose& pose, double width) {
            return pair.DistanceAt(pose, 0, width);
          }};
}

}  // namespace collision::bench
