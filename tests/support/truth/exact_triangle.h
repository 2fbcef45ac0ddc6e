// Triangles in exact arithmetic, written from the definitions and not from the code.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "tests/support/truth/exact.h"

namespace collision {

struct ExactVector {
  Exact x, y, z;

  ExactVector() = default;
  ExactVector(Exact along_x, Exact along_y, Exact along_z)
      : x(std::move(along_x)), y(std::move(along_y)), z(std::move(along_z)) {}
  explicit ExactVector(const Eigen::Vector3d& v) : x(v.x()), y(v.y()), z(v.z()) {}

  const Exact& operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
};

inline ExactVector operator+(const ExactVector& a, const ExactVector& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline ExactVector operator-(const ExactVector& a, const ExactVector& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline ExactVector operator*(const Exact& s, const ExactVector& v) {
  return {s * v.x, s * v.y, s * v.z};
}
inline Exact Dot(const ExactVector& a, const ExactVector& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline ExactVector Cross(const ExactVector& a, const ExactVector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Exact Square(const ExactVector& v) { return Dot(v, v); }

using ExactTriangle = std::array<ExactVector, 3>;

inline ExactTriangle Exactly(const std::array<Eigen::Vector3d, 3>& t) {
  return {ExactVector(t[0]), ExactVector(t[1]), ExactVector(t[2])};
}

inline Exact SquareToSegment(const ExactVector& p, const ExactVector& a, const ExactVector& b) {
  const Exact length = Square(b - a);
  if (length == 0) return Square(p - a);
  const Exact t = Dot(p - a, b - a) / length;
  if (t <= 0) return Square(p - a);
  if (t >= 1) return Square(p - b);
  return Square(p - a - t * (b - a));
}

inline Exact SquareToTriangle(const ExactVector& p, const ExactTriangle& t) {
  Exact least = SquareToSegment(p, t[0], t[1]);
  least = std::min(least, SquareToSegment(p, t[1], t[2]));
  least = std::min(least, SquareToSegment(p, t[2], t[0]));
  const ExactVector n = Cross(t[1] - t[0], t[2] - t[0]);
  if (Square(n) == 0) return least;
  for (int i = 0; i < 3; ++i) {
    if (Dot(Cross(t[(i + 1) % 3] - t[i], p - t[i]), n) < 0) return least;
  }
  const Exact height = Dot(p - t[0], n);
  return std::min(least, Exact(height * height / Square(n)));
}

inline Exact SquareOfSegments(const ExactVector& a, const ExactVector& b, const ExactVector& c,
                              const ExactVector& d) {
  Exact least = std::min(SquareToSegment(a, c, d), SquareToSegment(b, c, d));
  least = std::min(least, SquareToSegment(c, a, b));
  least = std::min(least, SquareToSegment(d, a, b));
  const ExactVector n = Cross(b - a, d - c), r = c - a;
  const Exact square = Square(n);
  if (square == 0) return least;
  const Exact s = Dot(Cross(r, d - c), n) / square, t = Dot(Cross(r, b - a), n) / square;
  if (s < 0 || s > 1 || t < 0 || t > 1) return least;
  const Exact height = Dot(r, n);
  return std::min(least, Exact(height * height / square));
}

/// Where the segment pq passes through the inside of a triangle, with both ends off its plane.
inline std::optional<ExactVector> PassagePoint(const ExactVector& p, const ExactVector& q,
                                               const ExactTriangle& t) {
  const ExactVector n = Cross(t[1] - t[0], t[2] - t[0]);
  const Exact from = Dot(p - t[0], n), to = Dot(q - t[0], n);
  if (from.sign() * to.sign() >= 0) return std::nullopt;
  const ExactVector x = p + (from / (from - to)) * (q - p);
  for (int i = 0; i < 3; ++i) {
    if (Dot(Cross(t[(i + 1) % 3] - t[i], x - t[i]), n) <= 0) return std::nullopt;
  }
  return x;
}

/// All points where an edge of one passes through the inside of the other.
inline std::vector<ExactVector> PassagePoints(const ExactTriangle& a, const ExactTriangle& b) {
  std::vector<ExactVector> points;
  for (int i = 0; i < 3; ++i) {
    if (const auto x = PassagePoint(a[i], a[(i + 1) % 3], b)) points.push_back(*x);
    if (const auto x = PassagePoint(b[i], b[(i + 1) % 3], a)) points.push_back(*x);
  }
  return points;
}

/// The square of the distance of two triangles.
inline Exact SquareOfTriangles(const ExactTriangle& a, const ExactTriangle& b) {
  if (!PassagePoints(a, b).empty()) return 0;
  Exact least = SquareToTriangle(a[0], b);
  for (int i = 0; i < 3; ++i) {
    least = std::min({least, SquareToTriangle(a[i], b), SquareToTriangle(b[i], a)});
    for (int j = 0; j < 3; ++j) {
      least = std::min(least, SquareOfSegments(a[i], a[(i + 1) % 3], b[j], b[(j + 1) % 3]));
    }
  }
  return least;
}

}  // namespace collision
