#include "collision_core/shape/hull_builder.h"

#include "collision_core/base/check.h"
#include "collision_core/numeric/allowances.h"

namespace collision::shape {
namespace {

using Eigen::Vector3d;

/// Adds the corners of a box; the columns of `halves` are its half edges.
void AddBox(const Vector3d& centre, const Eigen::Matrix3d& halves, std::vector<Vector3d>* points) {
  for (int i = 0; i < 8; ++i) {
    const Vector3d signs(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    points->push_back(centre + halves * signs);
  }
}

/// Adds points whose hull contains the core, each off by less than kSupportError times its span.
void AddCorners(const geometry::ConvexSet& set, std::vector<Vector3d>* points) {
  switch (set.core) {
    case geometry::ConvexCore::kPoint:
      points->push_back(set.centre);
      break;
    case geometry::ConvexCore::kSegment:
      points->push_back(set.centre - set.generators.col(0));
      points->push_back(set.centre + set.generators.col(0));
      break;
    case geometry::ConvexCore::kTriangle:
      for (int i = 0; i < 3; ++i) points->push_back(set.centre + set.generators.col(i));
      break;
    case geometry::ConvexCore::kBox:
    case geometry::ConvexCore::kEllipsoid:
    case geometry::ConvexCore::kCylinder:
    case geometry::ConvexCore::kCone:
      AddBox(set.centre, set.generators, points);
      break;
    case geometry::ConvexCore::kHull:
      for (std::uint32_t i = 0; i < set.points->size(); ++i) {
        points->push_back(set.centre + set.PointAt((*set.points)[i]));
      }
      break;
  }
}

/// Relative to the coordinates' magnitudes: a corner is a sum of centre and halves, itself halved
/// sums; less than 8 · 2^-53 of them.
constexpr double kCornerRounding = 0x1p-50;

/// An upper bound of how far a solid reaches beyond the hull of its corners [m].
double MoreThanCorners(const geometry::ConvexSet& set) {
  const double rounded =
      4 * geometry::kSupportError * set.span + kCornerRounding * set.centre.cwiseAbs().sum();
  return (set.rounding + set.error + rounded) * numeric::kFewRoundingsUp;
}

void AddVertices(const geometry::TriangleMesh& mesh, std::vector<Vector3d>* points) {
  std::vector<bool> known(mesh.vertices.size());
  for (const geometry::Triangle& triangle : mesh.triangles) {
    for (const std::uint32_t vertex : triangle) {
      if (!known[vertex]) points->push_back(mesh.vertices[vertex]);
      known[vertex] = true;
    }
  }
}

}  // namespace

OuterHull HullAround(const geometry::TriangleMesh& mesh, std::span<const ConvexSolid> solids) {
  CORE_CHECK(!mesh.triangles.empty() || !solids.empty(), "a hull is around something");
  double common = mesh.triangles.empty() ? numeric::kInfinity : 0;
  for (const ConvexSolid& solid : solids) common = std::min(common, solid.set().rounding);
  std::vector<Vector3d> points;
  AddVertices(mesh, &points);
  double rounding = 0;
  for (const ConvexSolid& solid : solids) {
    if (solid.set().rounding == common) {
      AddCorners(solid.set(), &points);
      rounding = std::max(rounding, MoreThanCorners(solid.set()));
    } else {
      const ConvexFacts& facts = solid.facts();
      const Vector3d middle = 0.5 * facts.lower + 0.5 * facts.upper;
      AddBox(middle, (0.5 * facts.upper - 0.5 * facts.lower).asDiagonal(), &points);
      rounding = std::max(
          rounding, kCornerRounding * (facts.lower.cwiseAbs() + facts.upper.cwiseAbs()).sum());
    }
  }
  return {points, rounding};
}

}  // namespace collision::shape
