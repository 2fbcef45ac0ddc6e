#include "client/programs/simulators/player/known_acceleration.h"

#include <algorithm>
#include <cmath>

namespace collision::client {
namespace {

// Sums and products of a few doubles err by far less; what is computed from them is rounded up by
// this much.
constexpr double kComputedMargin = 1e-9;

Vector3 Towards(const Vector3& a, const Vector3& b, double share) {
  Vector3 mean;
  for (int axis = 0; axis < 3; ++axis) mean[axis] = a[axis] + share * (b[axis] - a[axis]);
  return mean;
}

double Apart(const Vector3& a, const Vector3& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

double Length(const Vector3& a) { return Apart(a, {}); }

/// What is nearest to `a` within `distance` of `centre`.
Vector3 Nearest(const Vector3& a, const Vector3& centre, double distance) {
  const double apart = Apart(a, centre);
  return apart <= distance ? a : Towards(centre, a, distance / apart);
}

double SecondsBetween(std::int64_t from_ns, std::int64_t to_ns) {
  return static_cast<double>(to_ns - from_ns) * 1e-9;
}

}  // namespace

double ReachAfter(double seconds, double deviation_max_m_s2, double jerk_max_m_s3) {
  return seconds * seconds * (deviation_max_m_s2 / 2 + jerk_max_m_s3 * seconds / 6);
}

KnownAcceleration::KnownAcceleration(const Trajectory& curve) {
  for (const CsvRow& row : curve.rows()) knots_ns_.push_back(row.time_ns);
  const std::size_t pieces = curve.pieces().size();
  begins_m_s2_.resize(pieces + 1);
  ends_m_s2_.resize(pieces);
  const auto follows = [&curve](std::size_t i) { return i > 0 && !curve.rows()[i].jump; };
  double step = 0, rounding = 0, greatest = 0;
  for (std::size_t i = 0; i < pieces; ++i) {
    const PieceAcceleration on = curve.AccelerationOn(i);
    begins_m_s2_[i] = on.first_m_s2;
    ends_m_s2_[i] = on.last_m_s2;
    rounding = std::max(rounding, on.rounding_m_s2);
    greatest = std::max({greatest, Length(on.first_m_s2), Length(on.last_m_s2)});
    if (!follows(i)) continue;
    const Vector3 before = curve.AccelerationOn(i - 1).last_m_s2;
    step = std::max(step, Apart(before, on.first_m_s2));
    begins_m_s2_[i] = ends_m_s2_[i - 1] = Towards(before, on.first_m_s2, 0.5);
  }
  for (std::size_t i = 0; i < pieces; ++i) {
    const bool before = follows(i), after = i + 1 < pieces && follows(i + 1);
    if (!before && after) begins_m_s2_[i] = Nearest(ends_m_s2_[i], begins_m_s2_[i], step / 2);
    if (before && !after) ends_m_s2_[i] = Nearest(begins_m_s2_[i], ends_m_s2_[i], step / 2);
    const double slope =
        Apart(begins_m_s2_[i], ends_m_s2_[i]) / SecondsBetween(knots_ns_[i], knots_ns_[i + 1]);
    jerk_max_m_s3_ = std::max(jerk_max_m_s3_, slope * (1 + kComputedMargin));
  }
  if (pieces > 0 && follows(pieces)) begins_m_s2_[pieces] = ends_m_s2_[pieces - 1];
  deviation_max_m_s2_ = step / 2 + kComputedMargin * greatest + rounding;
}

Vector3 KnownAcceleration::At(std::int64_t stamp_ns) const {
  const auto knot = std::lower_bound(knots_ns_.begin(), knots_ns_.end(), stamp_ns);
  const std::size_t i = knot - knots_ns_.begin();
  if (*knot == stamp_ns) return begins_m_s2_[i];
  const double share =
      SecondsBetween(knots_ns_[i - 1], stamp_ns) / SecondsBetween(knots_ns_[i - 1], knots_ns_[i]);
  return Towards(begins_m_s2_[i - 1], ends_m_s2_[i - 1], share);
}

}  // namespace collision::client
