#include "tests/bench/narrow_convex_pair.h"

#include <algorithm>

#include "collision_core/narrow_phase/solid_pair.h"
#include "tests/bench/narrow_mesh.h"
#include "tests/collision_core/shape/meshes.h"

namespace collision::bench {
namespace {

constexpr std::uint64_t kUnlimited = std::uint64_t{1} << 60;

/// Points on an ellipsoid: as many as engines make of a body.
PlainMesh HullMesh() {
  TriangleMesh mesh = Sphere(1);
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

ConvexSolid SolidOf(const PlainConvex& convex) {
  ConvexDescription description;
  description.half = {convex.half[0], convex.half[1], convex.half[2]};
  description.rounding = convex.radius;
  switch (convex.kind) {
    case PlainConvex::Kind::kCapsule:
      description.core = ConvexCore::kSegment;
      break;
    case PlainConvex::Kind::kBox:
      description.core = ConvexCore::kBox;
      break;
    case PlainConvex::Kind::kHull:
      description.core = ConvexCore::kHull;
      for (const auto& p : convex.hull.vertices) description.points.emplace_back(p[0], p[1], p[2]);
  }
  return ConvexSolid::Build(description);
}

Verdict ConvexPair::VerdictAt(const RelativePose& pose) const {
  Work work(kUnlimited);
  return DecideSolids(a.set(), b.set(), pose, &work);
}

Interval ConvexPair::DistanceAt(const RelativePose& pose, double share, double width) const {
  Work work(kUnlimited);
  const Interval separation =
      SeparationOfSolids(a.set(), b.set(), pose,
                         {.goal = ConvexGoal::kDistance, .share = share, .width = width}, &work);
  return {std::max(0.0, separation.lower), std::max(0.0, separation.upper)};
}

PairOracle OracleOf(const ConvexPair& pair) {
  return {
      [pair](const RelativePose& pose) { return pair.VerdictAt(pose); },
      [pair](const RelativePose& pose, double width) { return pair.DistanceAt(pose, 0, width); }};
}

}  // namespace collision::bench
