// Distances of bodies in long double, written from the definitions and not from the code.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "collision_core/narrow_phase/pose/body_segment.h"
#include "tests/support/truth/true_motion.h"

namespace collision {

using TrueTriangle = std::array<Vector, 3>;

inline Real ToSegment(const Vector& p, const Vector& a, const Vector& b) {
  const Real length = (b - a).squaredNorm();
  const Real t = length > 0 ? std::clamp((p - a).dot(b - a) / length, Real(0), Real(1)) : 0;
  return (p - a - t * (b - a)).norm();
}

inline Real ToTriangle(const Vector& p, const TrueTriangle& t) {
  const Vector n = (t[1] - t[0]).cross(t[2] - t[0]);
  bool over = n.squaredNorm() > 0;
  for (int i = 0; i < 3 && over; ++i) over = (t[(i + 1) % 3] - t[i]).cross(p - t[i]).dot(n) >= 0;
  if (over) return std::abs((p - t[0]).dot(n)) / n.norm();
  return std::min({ToSegment(p, t[0], t[1]), ToSegment(p, t[1], t[2]), ToSegment(p, t[2], t[0])});
}

inline Real OfSegments(const Vector& a, const Vector& b, const Vector& c, const Vector& d) {
  Real least =
      std::min({ToSegment(a, c, d), ToSegment(b, c, d), ToSegment(c, a, b), ToSegment(d, a, b)});
  const Vector n = (b - a).cross(d - c), r = c - a;
  const Real square = n.squaredNorm();
  if (!(square > 0)) return least;
  const Real s = r.cross(d - c).dot(n) / square, t = r.cross(b - a).dot(n) / square;
  if (s < 0 || s > 1 || t < 0 || t > 1) return least;
  return std::min(least, std::abs(r.dot(n)) / n.norm());
}

inline bool Pierces(const Vector& p, const Vector& q, const TrueTriangle& t) {
  const Vector n = (t[1] - t[0]).cross(t[2] - t[0]);
  const Real from = (p - t[0]).dot(n), to = (q - t[0]).dot(n);
  if ((from > 0) == (to > 0)) return false;
  const Vector x = p + from / (from - to) * (q - p);
  for (int i = 0; i < 3; ++i) {
    if ((t[(i + 1) % 3] - t[i]).cross(x - t[i]).dot(n) < 0) return false;
  }
  return true;
}

inline Real OfTriangles(const TrueTriangle& a, const TrueTriangle& b) {
  Real least = ToTriangle(a[0], b);
  for (int i = 0; i < 3; ++i) {
    const int n = (i + 1) % 3;
    if (Pierces(a[i], a[n], b) || Pierces(b[i], b[n], a)) return 0;
    least = std::min({least, ToTriangle(a[i], b), ToTriangle(b[i], a)});
    for (int j = 0; j < 3; ++j)
      least = std::min(least, OfSegments(a[i], a[n], b[j], b[(j + 1) % 3]));
  }
  return least;
}

/// A body in the world: a mesh, or a ball of `radius` where there is none.
struct TrueBody {
  std::vector<TrueTriangle> triangles;
  bool closed = false;
  Vector centre = Vector::Zero();
  Real radius = 0;

  TrueBody(const shape::Shape* shape, double ball_radius, const TruePose& pose)
      : centre(pose.p), radius(shape ? 0 : ball_radius) {
    if (!shape) return;
    closed = shape->closed();
    for (const geometry::Triangle& t : shape->mesh().triangles) {
      const auto& vertices = shape->mesh().vertices;
      triangles.push_back({pose.ToWorld(vertices[t[0]]), pose.ToWorld(vertices[t[1]]),
                           pose.ToWorld(vertices[t[2]])});
    }
  }

  TrueBody Moved(const Vector& by) const {
    TrueBody moved = *this;
    moved.centre += by;
    for (TrueTriangle& t : moved.triangles) {
      for (Vector& p : t) p += by;
    }
    return moved;
  }

  /// Inside the solid, by the sum of solid angles.
  bool Contains(const Vector& p) const {
    if (triangles.empty()) return (p - centre).norm() <= radius;
    if (!closed) return false;
    Real sum = 0;
    for (const TrueTriangle& t : triangles) {
      const Vector a = t[0] - p, b = t[1] - p, c = t[2] - p;
      const Real la = a.norm(), lb = b.norm(), lc = c.norm();
      sum += 2 * std::atan2(a.dot(b.cross(c)),
                            la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
    }
    return std::abs(sum) > 2 * 3.14159L;
  }

  Real DistanceTo(const Vector& p) const {
    if (Contains(p)) return 0;
    if (triangles.empty()) return (p - centre).norm() - radius;
    Real least = INFINITY;
    for (const TrueTriangle& t : triangles) least = std::min(least, ToTriangle(p, t));
    return least;
  }
};

/// The distance of the surfaces (a ball is a solid); insides do not count.
inline Real SurfaceDistance(const TrueBody& a, const TrueBody& b) {
  if (a.triangles.empty() && b.triangles.empty()) {
    return std::max(Real(0), (a.centre - b.centre).norm() - a.radius - b.radius);
  }
  if (a.triangles.empty()) return SurfaceDistance(b, a);
  Real least = INFINITY;
  for (const TrueTriangle& t : a.triangles) {
    if (b.triangles.empty()) least = std::min(least, ToTriangle(b.centre, t) - b.radius);
    const Vector lower = t[0].cwiseMin(t[1]).cwiseMin(t[2]),
                 upper = t[0].cwiseMax(t[1]).cwiseMax(t[2]);
    for (const TrueTriangle& u : b.triangles) {
      const Vector low = u[0].cwiseMin(u[1]).cwiseMin(u[2]),
                   up = u[0].cwiseMax(u[1]).cwiseMax(u[2]);
      const Vector gap = (lower - up).cwiseMax(low - upper).cwiseMax(Vector::Zero());
      if (gap.norm() < least) least = std::min(least, OfTriangles(t, u));
      if (least == 0) return 0;
    }
  }
  return std::max(Real(0), least);
}

/// The distance of the solids; of connected surfaces only.
inline Real SolidDistance(const TrueBody& a, const TrueBody& b) {
  const Real surfaces = SurfaceDistance(a, b);
  if (surfaces == 0) return 0;
  for (const TrueTriangle& t : a.triangles) {
    if (b.Contains(t[0])) return 0;
  }
  for (const TrueTriangle& t : b.triangles) {
    if (a.Contains(t[0])) return 0;
  }
  if (a.triangles.empty() && b.Contains(a.centre)) return 0;
  if (b.triangles.empty() && a.Contains(b.centre)) return 0;
  return surfaces;
}

/// A body whose motion is not asked for.
inline narrow_phase::BodySegment BodyOf(std::shared_ptr<const shape::Shape> shape,
                                        double radius = 0) {
  narrow_phase::BodySegment body;
  body.ball.radius = shape ? shape->facts().radius : radius;
  body.shape = std::move(shape);
  return body;
}

}  // namespace collision
