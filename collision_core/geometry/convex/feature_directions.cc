#include "collision_core/geometry/convex/feature_directions.h"

#include <Eigen/Geometry>

namespace collision::geometry {
namespace {

using Eigen::Vector3d;

struct Edges {
  std::array<Vector3d, 3> edges;
  int count = 0;
};

Edges EdgesOf(const ConvexSet& set) {
  const auto g = [&](int i) { return Vector3d(set.generators.col(i)); };
  switch (set.core) {
    case ConvexCore::kSegment:
      return {{g(0)}, 1};
    case ConvexCore::kTriangle:
      return {{g(1) - g(0), g(2) - g(1), g(0) - g(2)}, 3};
    case ConvexCore::kBox:
      return {{g(0), g(1), g(2)}, 3};
    default:
      return {};
  }
}

}  // namespace

FeatureDirections::FeatureDirections(const ConvexPair& pair, const Vector3d& about) {
  const Edges of[2] = {EdgesOf(pair.a()), EdgesOf(pair.b())};
  for (const Edges& set : of) {
    for (int i = 0; i < set.count; ++i) {
      const int next = (i + 1) % set.count;
      if (next != i) Take(set.edges[i].cross(set.edges[next]), about);
      const double square = set.edges[i].squaredNorm();
      if (square > 0) Take(about - about.dot(set.edges[i]) / square * set.edges[i], about);
    }
  }
  for (int i = 0; i < of[0].count; ++i) {
    for (int j = 0; j < of[1].count; ++j) Take(of[0].edges[i].cross(of[1].edges[j]), about);
  }
}

void FeatureDirections::Take(const Vector3d& direction, const Vector3d& about) {
  if (!(direction.squaredNorm() > 0)) return;
  directions_[count_++] = direction.dot(about) < 0 ? Vector3d(-direction) : direction;
}

}  // namespace collision::geometry
