#include "tests/bench/precision_truth.h"

#include <algorithm>
#include <cmath>

#include "collision_core/geometry/triangle/triangle_pair.h"
#include "tests/bench/narrow_convex_pair.h"
#include "tests/support/exact_convex.h"
#include "tests/support/exact_triangle.h"

namespace collision::bench {
namespace {

/// What posing in doubles may move a vertex by, coordinates of a few metres: far beyond [m].
constexpr double kSlack = 1e-13;

using Wide = boost::multiprecision::mpf_float_100;

/// The root of an exact square, less `less`.
double Rooted(const Exact& square, const Exact& less) {
  const Wide root = sqrt(Wide(square));
  return std::max(0.0, static_cast<double>(Wide(root - Wide(less))));
}

struct Placed {
  Eigen::Matrix3d matrix;
  Eigen::Vector3d offset;

  explicit Placed(const PlainPose& pose) {
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) matrix(i, j) = pose.rotation[i][j];
      offset[i] = pose.offset[i];
    }
  }
};

/// A triangle where it is, about, with its box.
struct Boxed {
  geometry::TrianglePoints points;
  Eigen::Vector3d lower, upper;
  std::uint32_t index;

  double DistanceTo(const Eigen::Vector3d& low, const Eigen::Vector3d& high) const {
    return (low - upper).cwiseMax(lower - high).cwiseMax(0).norm();
  }
};

std::vector<Boxed> BoxedTriangles(const geometry::TriangleMesh& mesh,
                                  const std::vector<Eigen::Vector3d>& at) {
  std::vector<Boxed> all;
  for (const geometry::Triangle& t : mesh.triangles) {
    Boxed boxed{{at[t[0]], at[t[1]], at[t[2]]}, {}, {}, static_cast<std::uint32_t>(all.size())};
    boxed.lower = boxed.points[0].cwiseMin(boxed.points[1]).cwiseMin(boxed.points[2]);
    boxed.upper = boxed.points[0].cwiseMax(boxed.points[1]).cwiseMax(boxed.points[2]);
    all.push_back(boxed);
  }
  return all;
}

/// Leaves those that may be as near to any of the others.
void KeepNear(const std::vector<Boxed>& others, double within, std::vector<Boxed>* some) {
  if (others.empty()) return;
  Eigen::Vector3d lower = others[0].lower, upper = others[0].upper;
  for (const Boxed& other : others) {
    lower = lower.cwiseMin(other.lower), upper = upper.cwiseMax(other.upper);
  }
  std::erase_if(*some, [&](const Boxed& one) { return one.DistanceTo(lower, upper) > within; });
}

struct NearPairOfTriangles {
  double lower;
  std::uint32_t a, b;
};

/// Those that certified distances leave, nearest first.
std::vector<NearPairOfTriangles> NearTriangles(std::vector<Boxed> of_a, std::vector<Boxed> of_b,
                                               double within) {
  for (int i = 0; i < 2; ++i) {
    KeepNear(of_b, within, &of_a);
    KeepNear(of_a, within, &of_b);
  }
  std::vector<NearPairOfTriangles> near;
  for (const Boxed& a : of_a) {
    for (const Boxed& b : of_b) {
      if (a.DistanceTo(b.lower, b.upper) > within) continue;
      const double lower = geometry::DistanceOf(a.points, b.points).distance.lower;
      if (lower <= within) near.push_back({lower, a.index, b.index});
    }
  }
  std::sort(near.begin(), near.end(), [](const auto& one, const auto& other) {
    return std::tie(one.lower, one.a, one.b) < std::tie(other.lower, other.a, other.b);
  });
  return near;
}

ExactTriangle TriangleAt(const geometry::TriangleMesh& mesh, std::uint32_t index,
                         const ExactPlacement& placement) {
  ExactTriangle triangle;
  for (int i = 0; i < 3; ++i) {
    triangle[i] = placement(ExactVector(mesh.vertices[mesh.triangles[index][i]]));
  }
  return triangle;
}

shape::ConvexDescription DescriptionOf(const PlainConvex& convex) {
  shape::ConvexDescription description;
  description.half = {convex.half[0], convex.half[1], convex.half[2]};
  description.core = convex.kind == PlainConvex::Kind::kCapsule ? geometry::ConvexCore::kSegment
                     : convex.kind == PlainConvex::Kind::kBox   ? geometry::ConvexCore::kBox
                                                                : geometry::ConvexCore::kHull;
  for (const auto& p : convex.hull.vertices) description.points.emplace_back(p[0], p[1], p[2]);
  return description;
}

}  // namespace

double MeshTruth::DistanceAt(const PlainPose& pose, double upper) const {
  const Placed placed(pose);
  std::vector<Eigen::Vector3d> moved;
  for (const Eigen::Vector3d& p : mesh_.vertices) {
    moved.push_back(placed.matrix * p + placed.offset);
  }
  const auto near = NearTriangles(BoxedTriangles(mesh_, mesh_.vertices),
                                  BoxedTriangles(mesh_, moved), upper + kSlack);
  const ExactPlacement still, there = PlacementOf(placed.matrix, placed.offset);
  Exact least = -1;
  for (const NearPairOfTriangles& pair : near) {
    const Exact square =
        SquareOfTriangles(TriangleAt(mesh_, pair.a, still), TriangleAt(mesh_, pair.b, there));
    if (least < 0 || square < least) least = square;
    if (least == 0) break;
  }
  return least < 0 ? numeric::kInfinity : Rooted(least, 0);
}

double ConvexTruthAt(const PlainConvex& a, const PlainConvex& b, const PlainPose& pose) {
  const Placed placed(pose);
  const ExactPlacement there = PlacementOf(placed.matrix, placed.offset);
  const ExactVector nearest = NearestToZero(Difference(
      ExactCorners(DescriptionOf(a)), collision::Placed(ExactCorners(DescriptionOf(b)), there)));
  return Rooted(Square(nearest), Exact(a.radius) + Exact(b.radius));
}

}  // namespace collision::bench
