// The exact distance of two posed bodies, in rational arithmetic: meshes by their triangles, convex
// solids by the corners of their cores. Link with gmp.
//
// A pose's matrix counts as the numbers that it has: as doubles they are no rotation.
#pragma once

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "collision_core/geometry/mesh/triangle_mesh.h"
#include "collision_core/geometry/triangle/triangle_pair.h"
#include "tests/support/truth/exact_convex.h"
#include "tests/support/truth/exact_triangle.h"

namespace collision {

inline ExactTriangle ExactTriangleOf(const geometry::TriangleMesh& mesh, std::size_t index,
                                     const ExactPlacement& placement) {
  ExactTriangle triangle;
  for (int i = 0; i < 3; ++i) {
    triangle[i] = placement(ExactVector(mesh.vertices[mesh.triangles[index][i]]));
  }
  return triangle;
}

/// The square of the distance of two surfaces, by all pairs of their triangles.
inline Exact SquareOfSurfaces(const geometry::TriangleMesh& a, const geometry::TriangleMesh& b,
                              const ExactPlacement& pose) {
  std::vector<ExactTriangle> of_b;
  for (std::size_t i = 0; i < b.triangles.size(); ++i) {
    of_b.push_back(ExactTriangleOf(b, i, pose));
  }
  Exact least = -1;
  for (std::size_t i = 0; i < a.triangles.size(); ++i) {
    const ExactTriangle of_a = ExactTriangleOf(a, i, {});
    for (const ExactTriangle& other : of_b) {
      const Exact square = SquareOfTriangles(of_a, other);
      if (least < 0 || square < least) least = square;
      if (least == 0) return least;
    }
  }
  return least;
}

/// The root of an exact square, less `less`; not below 0; rounded to the nearest double.
inline double Rooted(const Exact& square, const Exact& less) {
  using Wide = boost::multiprecision::mpf_float_100;
  const Wide root = sqrt(Wide(square));
  return std::max(0.0, static_cast<double>(Wide(root - Wide(less))));
}

/// Two bodies of one mesh. For meshes of thousands of triangles: exact arithmetic is used only for
/// pairs of triangles that a certified distance leaves as candidates.
class MeshTruth {
 public:
  explicit MeshTruth(geometry::TriangleMesh mesh) : mesh_(std::move(mesh)) {}

  /// [m], rounded to the nearest double; 0: the surfaces have a point in common. Requires that
  /// `upper` is not less than the distance by more than 1e-13.
  double DistanceAt(const Eigen::Matrix3d& matrix, const Eigen::Vector3d& offset,
                    double upper) const {
    std::vector<Eigen::Vector3d> moved;
    for (const Eigen::Vector3d& p : mesh_.vertices) moved.push_back(matrix * p + offset);
    const auto near = NearPairs(Boxed(mesh_.vertices), Boxed(moved), upper + kSlack);
    const ExactPlacement pose = PlacementOf(matrix, offset);
    Exact least = -1;
    for (const NearPair& pair : near) {
      const Exact square = SquareOfTriangles(ExactTriangleOf(mesh_, pair.a, {}),
                                             ExactTriangleOf(mesh_, pair.b, pose));
      if (least < 0 || square < least) least = square;
      if (least == 0) break;
    }
    return least < 0 ? numeric::kInfinity : Rooted(least, 0);
  }

 private:
  /// More than posing in doubles moves a vertex, for coordinates of a few metres [m].
  static constexpr double kSlack = 1e-13;

  /// A triangle at its rounded place, with its box.
  struct Box {
    geometry::TrianglePoints points;
    Eigen::Vector3d lower, upper;
    std::size_t index;

    double DistanceTo(const Eigen::Vector3d& low, const Eigen::Vector3d& high) const {
      return (low - upper).cwiseMax(lower - high).cwiseMax(0).norm();
    }
  };

  struct NearPair {
    double lower;
    std::size_t a, b;
  };

  std::vector<Box> Boxed(const std::vector<Eigen::Vector3d>& at) const {
    std::vector<Box> all;
    for (const geometry::Triangle& t : mesh_.triangles) {
      Box box{{at[t[0]], at[t[1]], at[t[2]]}, {}, {}, all.size()};
      box.lower = box.points[0].cwiseMin(box.points[1]).cwiseMin(box.points[2]);
      box.upper = box.points[0].cwiseMax(box.points[1]).cwiseMax(box.points[2]);
      all.push_back(box);
    }
    return all;
  }

  /// Leaves those that may be as near to any of the others.
  static void KeepNear(const std::vector<Box>& others, double within, std::vector<Box>* some) {
    if (others.empty()) return;
    Eigen::Vector3d lower = others[0].lower, upper = others[0].upper;
    for (const Box& other : others) {
      lower = lower.cwiseMin(other.lower), upper = upper.cwiseMax(other.upper);
    }
    std::erase_if(*some, [&](const Box& one) { return one.DistanceTo(lower, upper) > within; });
  }

  /// Those that certified distances leave, nearest first.
  static std::vector<NearPair> NearPairs(std::vector<Box> of_a, std::vector<Box> of_b,
                                         double within) {
    for (int i = 0; i < 2; ++i) {
      KeepNear(of_b, within, &of_a);
      KeepNear(of_a, within, &of_b);
    }
    std::vector<NearPair> near;
    for (const Box& a : of_a) {
      for (const Box& b : of_b) {
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

  const geometry::TriangleMesh mesh_;
};

/// The distance of two convex solids [m], by their cores' corners less the roundings; 0: they have
/// a point in common. Not for ellipsoids.
inline double ConvexDistanceAt(const shape::ConvexDescription& a, const shape::ConvexDescription& b,
                               const ExactPlacement& pose) {
  const ExactVector nearest =
      NearestToZero(Difference(ExactCorners(a), Placed(ExactCorners(b), pose)));
  return Rooted(Square(nearest), Exact(a.rounding) + Exact(b.rounding));
}

}  // namespace collision
