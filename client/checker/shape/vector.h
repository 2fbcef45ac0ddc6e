// The checker's own vectors, rotations and poses: it shares none with the service.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace collision::checker {

struct Vector {
  double x = 0, y = 0, z = 0;

  double operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
  friend bool operator==(const Vector&, const Vector&) = default;
};

inline Vector operator+(const Vector& a, const Vector& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Vector operator-(const Vector& a, const Vector& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Vector operator*(double s, const Vector& a) { return {s * a.x, s * a.y, s * a.z}; }
inline Vector operator-(const Vector& a) { return {-a.x, -a.y, -a.z}; }
inline double Dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vector Cross(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double Squared(const Vector& a) { return Dot(a, a); }
inline double Length(const Vector& a) { return std::sqrt(Squared(a)); }
inline Vector LeastOf(const Vector& a, const Vector& b) {
  return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}
inline Vector GreatestOf(const Vector& a, const Vector& b) {
  return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}

/// The pose of body B in the frame of body A: x_A = R_AB x_B + p_AB.
struct Pose {
  std::array<Vector, 3> R_AB = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};  ///< Rows.
  Vector p_AB;

  Vector operator()(const Vector& p_B) const {
    return Vector{Dot(R_AB[0], p_B), Dot(R_AB[1], p_B), Dot(R_AB[2], p_B)} + p_AB;
  }
  /// The pose of A in the frame of B.
  Pose Inverse() const {
    Pose inverse;
    for (int i = 0; i < 3; ++i) inverse.R_AB[i] = {R_AB[0][i], R_AB[1][i], R_AB[2][i]};
    inverse.p_AB = Back({});
    return inverse;
  }
  /// A point in the frame of A, in the frame of B.
  Vector Back(const Vector& p_A) const {
    const Vector d = p_A - p_AB;
    return d.x * R_AB[0] + d.y * R_AB[1] + d.z * R_AB[2];
  }
};

}  // namespace collision::checker
