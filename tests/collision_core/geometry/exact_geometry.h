// Points, triangles and meshes in exact rational arithmetic, by the names of the shape's tests.
#pragma once

#include <algorithm>
#include <cmath>

#include "collision_core/geometry/mesh/triangle_mesh.h"
#include "tests/support/truth/exact_triangle.h"

namespace collision {

using ExactPoint = ExactVector;

inline ExactPoint ExactOf(const Eigen::Vector3d& p) { return ExactPoint(p); }

inline ExactTriangle ExactOf(const geometry::TriangleMesh& mesh, const geometry::Triangle& t) {
  return {ExactOf(mesh.vertices[t[0]]), ExactOf(mesh.vertices[t[1]]), ExactOf(mesh.vertices[t[2]])};
}

inline ExactPoint Along(const ExactPoint& a, const Exact& s, const ExactPoint& u) {
  return a + s * u;
}

inline Exact DotOf(const ExactPoint& a, const ExactPoint& b) { return Dot(a, b); }

inline ExactPoint CrossOf(const ExactPoint& a, const ExactPoint& b) { return Cross(a, b); }

inline Exact SquaredDistance(const ExactPoint& p, const ExactTriangle& t) {
  return SquareToTriangle(p, t);
}

/// Triangles whose box is certainly farther than a corner of the mesh are left aside.
inline Exact SquaredDistance(const Eigen::Vector3d& p, const geometry::TriangleMesh& mesh) {
  double corner = HUGE_VAL;
  for (const geometry::Triangle& t : mesh.triangles) {
    for (const std::uint32_t i : t) corner = std::min(corner, (mesh.vertices[i] - p).norm());
  }
  Exact least = -1;
  for (const geometry::Triangle& t : mesh.triangles) {
    const Eigen::Vector3d &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]],
                          &c = mesh.vertices[t[2]];
    const Eigen::Vector3d below = a.cwiseMin(b).cwiseMin(c) - p,
                          above = p - a.cwiseMax(b).cwiseMax(c);
    const double box = below.cwiseMax(above).cwiseMax(Eigen::Vector3d::Zero()).norm();
    // Both lengths are relatively exact to a few units of 2^-53.
    if (box > corner * (1 + 1e-12)) continue;
    const Exact exact = SquaredDistance(ExactOf(p), ExactOf(mesh, t));
    if (least < 0 || exact < least) least = exact;
  }
  return least;
}

inline Exact Squared(double x) { return Exact(x) * Exact(x); }

/// The solid angle of the whole surface over 4π: the winding number, about (van Oosterom and
/// Strackee, "The solid angle of a plane triangle", 1983).
inline double SolidAngleWinding(const geometry::TriangleMesh& mesh, const Eigen::Vector3d& p) {
  using Vector = Eigen::Matrix<long double, 3, 1>;
  long double sum = 0;
  for (const geometry::Triangle& t : mesh.triangles) {
    Vector r[3];
    long double length[3];
    for (int i = 0; i < 3; ++i) {
      r[i] = (mesh.vertices[t[i]] - p).cast<long double>();
      length[i] = std::sqrt(r[i].dot(r[i]));
    }
    const long double volume = r[0].x() * (r[1].y() * r[2].z() - r[1].z() * r[2].y()) +
                               r[0].y() * (r[1].z() * r[2].x() - r[1].x() * r[2].z()) +
                               r[0].z() * (r[1].x() * r[2].y() - r[1].y() * r[2].x());
    const long double cosine = length[0] * length[1] * length[2] + r[0].dot(r[1]) * length[2] +
                               r[1].dot(r[2]) * length[0] + r[2].dot(r[0]) * length[1];
    sum += 2 * std::atan2(volume, cosine);
  }
  return static_cast<double>(sum / (4 * 3.14159265358979323846264338327950288L));
}

}  // namespace collision
