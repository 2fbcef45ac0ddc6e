#include "client/programs/simulators/orbits/gravity.h"

#include <cmath>

#include "client/library/vector.h"

namespace collision::client {
namespace {

constexpr double kFlattening = kEarthJ2 * kEarthMu * kEarthRadius * kEarthRadius;  // c

}  // namespace

Vector3 Gravity(const Vector3& position_m) {
  const double square = Dot(position_m, position_m), r = std::sqrt(square);
  const double central = kEarthMu / (square * r);
  const double flattening = 1.5 * kFlattening / (square * square * r);
  const double tilt = 5 * position_m[2] * position_m[2] / square;
  const double level = flattening * (tilt - 1) - central;
  return {position_m[0] * level, position_m[1] * level,
          position_m[2] * (flattening * (tilt - 3) - central)};
}

double GravityRateMax(const PathExtent& path) {
  const double r = path.radius_min_m, v = path.speed_max_m_s;
  const double central = std::hypot(v, std::sqrt(3.0) * path.climb_max_m_s);
  return kEarthMu / std::pow(r, 3) * central + 12 * kFlattening / std::pow(r, 5) * v;
}

double GravityRateRateMax(const PathExtent& path) {
  const double r = path.radius_min_m, v = path.speed_max_m_s, climb = path.climb_max_m_s;
  const double turning =
      3 * kEarthMu / std::pow(r, 4) * (v * v + 2 * v * climb + 5 * climb * climb) +
      60 * kFlattening / std::pow(r, 6) * v * v;
  const double bending = 2 * kEarthMu / std::pow(r, 3) + 12 * kFlattening / std::pow(r, 5);
  return turning + bending * path.acceleration_max_m_s2;
}

}  // namespace collision::client
