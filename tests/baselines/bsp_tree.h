// Hubbard's exact comparison: solids as binary space partitioning trees.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "collision_core/geometry/mesh/triangle_mesh.h"

namespace collision::baselines {

/// A closed solid, cut by the planes of its own faces until every cell is inside or outside. In
/// plain doubles, not certified: a point within 1e-12 of the largest coordinate counts as on the
/// plane.
/// Source: Thibault and Naylor, "Set operations on polyhedra using binary space partitioning
/// trees", SIGGRAPH 1987, named by Hubbard for the exact comparison of two objects.
class BspTree {
 public:
  /// Requires closed, outward triangles that do not cross each other. Each cut is the best of a few
  /// candidates: it splits few faces and leaves as many on one side as on the other.
  explicit BspTree(const geometry::TriangleMesh& mesh);

  /// Whether the two solids have a point in common. B's faces go down A's tree, split where they
  /// cross its planes, until a piece arrives inside; and A's down B's. x_A = rotation x_B + offset.
  static bool Intersect(const BspTree& a, const BspTree& b, const Eigen::Matrix3d& rotation,
                        const Eigen::Vector3d& offset);

 private:
  using Polygon = std::vector<Eigen::Vector3d>;  ///< Convex.
  struct Plane {
    Eigen::Vector3d normal;  ///< Unit, outward.
    double offset;

    double HeightOf(const Eigen::Vector3d& point) const { return normal.dot(point) - offset; }
  };
  struct Face {
    Polygon polygon;
    Plane plane;
  };
  struct Node {
    Plane plane;
    std::int32_t front, back;
  };
  enum class Side { kOn, kFront, kBack, kBoth };

  Side SideOf(const Polygon& polygon, const Plane& plane) const;
  static void Split(const Polygon& polygon, const Plane& plane, Polygon* front, Polygon* back);
  std::size_t BestCut(const std::vector<Face>& faces) const;
  std::int32_t Build(std::vector<Face> faces, std::int32_t if_empty);
  bool ArrivesInside(Polygon polygon, std::int32_t node) const;

  std::vector<Node> nodes_;
  std::vector<Polygon> faces_;  ///< As they came.
  std::int32_t root_;
  double tolerance_ = 0;
};

}  // namespace collision::baselines
