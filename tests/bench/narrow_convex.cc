// Capsules, boxes and hulls: the same contest against FCL's and Bullet's own.
#include "tests/bench/narrow_convex.h"

#include <algorithm>

#include "collision_core/narrow_phase/solid_pair.h"
#include "tests/bench/narrow_cell.h"
#include "tests/bench/narrow_ours.h"
#include "tests/collision_core/shape/meshes.h"

namespace collision::bench {
namespace {

constexpr std::uint64_t kUnlimited = std::uint64_t{1} << 60;
constexpr std::uint64_t kSeed = 5;

/// Points on an ellipsoid: as many as engines make of a body.
PlainMesh HullMesh() {
  TriangleMesh mesh = Sphere(1);
  for (Eigen::Vector3d& p : mesh.vertices) p = p.cwiseProduct(Eigen::Vector3d(1, 0.7, 0.5));
  return PlainOf(mesh);
}

/// All of a bounding diameter of 2 m.
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

struct Pair {
  ConvexSolid a, b;

  Verdict VerdictAt(const RelativePose& pose) const {
    Work work(kUnlimited);
    return DecideSolids(a.set(), b.set(), pose, &work);
  }

  Interval DistanceAt(const RelativePose& pose, double share, double width) const {
    Work work(kUnlimited);
    const Interval separation =
        SeparationOfSolids(a.set(), b.set(), pose,
                           {.goal = ConvexGoal::kDistance, .share = share, .width = width}, &work);
    return {std::max(0.0, separation.lower), std::max(0.0, separation.upper)};
  }
};

PairOracle OracleOf(const Pair& pair) {
  return {
      [pair](const RelativePose& pose) { return pair.VerdictAt(pose); },
      [pair](const RelativePose& pose, double width) { return pair.DistanceAt(pose, 0, width); }};
}

NarrowQueries OurConvexQueries(const Pair& pair) {
  const auto decide = [pair](const PlainPose& at) -> Reply {
    switch (pair.VerdictAt(PoseOf(at))) {
      case Verdict::kApart:
        return Plain(0);
      case Verdict::kTouching:
        return Plain(1);
      case Verdict::kUndecided:
        break;
    }
    return {0, 1};
  };
  const auto measure = [pair](const PlainPose& at) -> Reply {
    const Interval distance = pair.DistanceAt(PoseOf(at), kDistanceShare, 0);
    return {distance.lower, distance.upper};
  };
  return {{"ours", Task::kDecision, Who::kOurs, decide},
          {"ours", Task::kDistance, Who::kOurs, measure}};
}

void Contest(const NarrowSettings& settings, const PlainConvex& a, const PlainConvex& b,
             NarrowReport* report) {
  const Pair pair{SolidOf(a), SolidOf(b)};
  NarrowQueries queries = OurConvexQueries(pair);
  for (NarrowQuery& query : ConvexPeerQueries(a, b)) queries.push_back(std::move(query));
  for (const GapClass& gap : GapClasses()) {
    Cell cell{"convex ", a.name + " " + b.name,
              std::max(a.hull.triangles.size(), b.hull.triangles.size()), 2, gap};
    NarrowQueries wanted;
    std::copy_if(queries.begin(), queries.end(), std::back_inserter(wanted),
                 [&](const NarrowQuery& query) { return Wanted(settings, RowOf(cell, query)); });
    if (wanted.empty()) continue;
    cell.sample = SamplePoses(OracleOf(pair), cell.diameter, gap, settings.poses(), kSeed);
    if (cell.sample.poses.empty()) continue;
    for (const PlainPose& pose : cell.sample.poses) {
      cell.distances.push_back(queries[1].ask(pose));
    }
    Measure(settings, cell, wanted, report);
  }
}

}  // namespace

void ConvexPart(const NarrowSettings& settings, NarrowReport* report) {
  const std::vector<PlainConvex> all = Convexes();
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t k = i; k < all.size(); ++k) Contest(settings, all[i], all[k], report);
  }
}

}  // namespace collision::bench
