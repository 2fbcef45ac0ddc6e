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

  /// Starts with the tetrahedron of four points. A point beyond a face by less than `tolerance` [m]
  /// counts as in its plane. Unchecked: the points are not in one plane. If three of them are on a
  /// line, there are no faces.
  void Start(const std::array<Point, 4>& tetrahedron, double tolerance);

  /// The face, among those that are not final, whose plane has the least distance from 0, negative
  /// where 0 lies on its outer side; −1: all faces are final.
  int Nearest() const;
  double DistanceOf(int face) const { return faces_[face].distance; }
  const Eigen::Vector3d& NormalOf(int face) const { return faces_[face].normal; }
  void SetFinal(int face) { faces_[face].is_final = true; }

  /// Adds a point: replaces all faces that the point lies beyond by the cone from their horizon to
  /// the point. `beyond`: one of these faces. Returns false, and changes nothing, if there is no
  /// room or if the cone would have degenerate triangles.
  bool Add(int beyond, const Point& point);

  /// The radius of a ball about 0 that is certainly inside [m]; below 0: no ball is certain. Each
  /// point may be off by `point_error`; `size` bounds their coordinates.
  double CertainInnerRadius(double point_error, double size) const;

 private:
  static constexpr int kPointsMax = kEpaFacesMax / 2 + 4;

  struct Face {
    std::array<int, 3> corners;     ///< Anticlockwise, seen from outside.
    std::array<int, 3> neighbours;  ///< Across the edge from corner i to the next.
    Eigen::Vector3d normal;         ///< Outward, unit.
    double distance;                ///< The least normal · corner over the three corners.
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

  // Used by Add() only.
  std::array<int, kEpaFacesMax> visible_;
  int visible_count_ = 0;
  std::array<Edge, kEpaFacesMax> horizon_;
  std::array<Face, kEpaFacesMax> cone_;
  int edge_count_ = 0;
  /// For each point the face of the cone whose edge starts there, or −1.
  std::array<int, kPointsMax> starts_;
};

}  // namespace collision::geometry
