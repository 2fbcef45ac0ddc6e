// Orientation of bodies that turn evenly, in nothing but plain arithmetic: an input must be the
// same bits in every build, as std::sin need not be.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>

namespace collision::server {

/// w, x, y, z.
using PlainQuaternion = std::array<double, 4>;

inline PlainQuaternion Times(const PlainQuaternion& a, const PlainQuaternion& b) {
  return {a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
          a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
          a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
          a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0]};
}

/// A turn by `rate` [rad/s] for `t_ns`, right to 1e-12 for some ten turns: the turn's 1024th part
/// by its series, squared ten times.
inline PlainQuaternion Turned(const Eigen::Vector3d& rate, std::int64_t t_ns) {
  const Eigen::Vector3d half = rate * (0.5e-9 / 1024 * static_cast<double>(t_ns));
  const double x = half.squaredNorm();
  const double cosine = 1 - x / 2 * (1 - x / 12 * (1 - x / 30));
  const double sine_over = 1 - x / 6 * (1 - x / 20 * (1 - x / 42));
  PlainQuaternion q{cosine, sine_over * half.x(), sine_over * half.y(), sine_over * half.z()};
  for (int i = 0; i < 10; ++i) q = Times(q, q);
  return q;
}

}  // namespace collision::server
