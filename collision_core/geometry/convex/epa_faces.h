// The faces of a polytope that grows point by point.
#pragma once

#include "collision_core/geometry/convex/gjk.h"

namespace collision::geometry {

/// The most faces of the polytope.
inline constexpr int kEpaFacesMax = 256;

/// Triangles, each with its neighbours, that form a closed oriented surface at all times.
class PolytopeFaces {
 public:
  using Point = ConvexPair::Point;

  /// Four points that are not in one plane. `tolerance`: points beyond a face by less are in it
  /// [m].
  void Start(const std::array<Point, 4>& tetrahedron, double tolerance);

  /// The face whose plane is nearest to 0, or furthest on the wrong side of it, of those that are
  /// not final; −1: none is left.
  int Nearest() const;
  double DistanceOf(int face) const { return faces_[face].distance; }
  const Eigen::Vector3d& NormalOf(int face) const { return faces_[face].normal; }
  void SetFinal(int face) { faces_[face].is_final = true; }

  /// Replaces all faces that a point is beyond of, from one of them on. False, and nothing has
  /// changed: there is no room, or the surface would not stay one of proper triangles.
  bool Add(int beyond, const Point& point);

  /// The radius of a ball about 0 that is certainly inside; below 0: none is. Each point may be off
  /// by `point_error`; `size` bounds their coordinates.
  double CertainDistance(double point_error, double size) const;

 private:
  static constexpr int kPointsMax = kEpaFacesMax / 2 + 4;

  struct Face {
    std::array<int, 3> corners;     ///< Anticlockwise, seen from outside.
    std::array<int, 3> neighbours;  ///< Across the edge from corner i to the next.
    Eigen::Vector3d normal;         ///< Outward, unit.
    double distance;                ///< The least of the corners' along the normal.
    bool is_final;
    bool is_visible;
  };
  struct Edge {
    int from, to;
    int face, side;  ///< The face that stays, and which of its edges it is.
  };

  bool Make(int i, int j, int k, Face* face) const;
  bool FindHorizon(int beyond, const Eigen::Vector3d& y, double tolerance);
  bool MakeCone();
  bool JoinCone();
  void Replace();
  bool IsSeenFromWithin(const Face& face) const;

  std::array<Point, kPointsMax> points_;
  std::array<Face, kEpaFacesMax> faces_;
  int point_count_ = 0;
  int face_count_ = 0;
  double tolerance_ = 0;

  // Of the addition under way.
  std::array<int, kEpaFacesMax> visible_;
  int visible_count_ = 0;
  std::array<Edge, kEpaFacesMax> horizon_;
  std::array<Face, kEpaFacesMax> cone_;
  int edge_count_ = 0;
  std::array<int, kPointsMax> starts_;  ///< The cone's face whose edge starts at a point, or −1.
};

}  // namespace collision::geometry
