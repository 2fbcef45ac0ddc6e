// Points and triangles in exact rational arithmetic.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "collision_core/geometry/mesh/triangle_mesh.h"
#include "tests/support/exact.h"

namespace collision {

using ExactPoint = std::array<Exact, 3>;

inline ExactPoint ExactOf(const Eigen::Vector3d& p) {
  return {Exact(p.x()), Exact(p.y()), Exact(p.z())};
}

inline ExactPoint operator-(const ExactPoint& a, const ExactPoint& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

inline ExactPoint Along(const ExactPoint& a, const Exact& s, const ExactPoint& u) {
  return {a[0] + s * u[0], a[1] + s * u[1], a[2] + s * u[2]};
}

inline Exact DotOf(const ExactPoint& a, const ExactPoint& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline ExactPoint CrossOf(const ExactPoint& a, const ExactPoint& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

using ExactTriangle = std::array<ExactPoint, 3>;

inline ExactTriangle ExactOf(const geometry::TriangleMesh& mesh, const geometry::Triangle& t) {
  return {ExactOf(mesh.vertices[t[0]]), ExactOf(mesh.vertices[t[1]]), ExactOf(mesh.vertices[t[2]])};
}

inline Exact SquaredDistance(const ExactPoint& p, const ExactPoint& a, const ExactPoint& b) {
  const ExactPoint u = b - a, w = p - a;
  const Exact length2 = DotOf(u, u);
  Exact s = length2 == 0 ? Exact(0) : Exact(DotOf(w, u) / length2);
  if (s < 0) s = 0;
  if (s > 1) s = 1;
  const ExactPoint d = p - Along(a, s, u);
  return DotOf(d, d);
}

/// To the plane if the foot lies in the triangle, else to the nearest side.
inline Exact SquaredDistance(const ExactPoint& p, const ExactTriangle& t) {
  const ExactPoint n = CrossOf(t[1] - t[0], t[2] - t[0]);
  const Exact n2 = DotOf(n, n);
  const auto is_within = [&](int i) {
    return DotOf(CrossOf(t[(i + 1) % 3] - t[i], p - t[i]), n) >= 0;
  };
  if (n2 != 0 && is_within(0) && is_within(1) && is_within(2)) {
    const Exact height = DotOf(p - t[0], n);
    return height * height / n2;
  }
  return std::min({SquaredDistance(p, t[0], t[1]), SquaredDistance(p, t[1], t[2]),
                   SquaredDistance(p, t[2], t[0])});
}

inline Exact SquaredDistance(const ExactPoint& p, const geometry::TriangleMesh& mesh) {
  Exact least = -1;
  for (const geometry::Triangle& t : mesh.triangles) {
    const Exact d = SquaredDistance(p, ExactOf(mesh, t));
    if (least < 0 || d < least) least = d;
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
