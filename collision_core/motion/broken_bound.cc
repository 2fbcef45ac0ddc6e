#include "collision_core/motion/broken_bound.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "collision_core/base/check.h"

namespace collision::motion {
namespace {

/// What goes beyond this [SI units] counts as infinite. A position that jumps by 10^7 m within a
/// nanosecond takes 10^26 m/s²; squares of this are finite.
constexpr double kGreatest = 0x1p200;

/// What exceeds the declared value by less is not searched for: nearer than numbers print.
constexpr double kLeast = 0x1p-64;

bool IsBreached(const SpaceTimeBound& before, const MotionState& next) {
  return CheckContract(before, next, OrientationUse::kIgnored).verdict ==
         ContractVerdict::kBreached;
}

/// Requires that `declared` is refuted. First steps away from it whose logarithm doubles, up or
/// down from its own size, then halves the interval between a refuted and an allowed excess on a
/// logarithmic scale.
template <typename Refuted>
double LargestRefuted(double declared, const Refuted& refuted) {
  double low = std::max(declared, 1.0), high = low, factor = 2;
  if (refuted(declared + high)) {
    do {
      low = high;
      if (low >= kGreatest) return std::numeric_limits<double>::infinity();
      high *= factor;
      factor *= factor;
    } while (refuted(declared + high));
  } else {
    do {
      high = low;
      if (high < kLeast) return declared;
      low /= factor;
      factor *= factor;
    } while (!refuted(declared + low));
  }
  while (high > low * (1 + kSeenShortfall)) {
    const double middle = std::sqrt(low) * std::sqrt(high);
    if (!(low < middle && middle < high)) break;
    (refuted(declared + middle) ? low : high) = middle;
  }
  return declared + low;
}

SpaceTimeBound WithoutCap(SpaceTimeBound bound) {
  bound.limits.speed_max = numeric::kInfinity;
  return bound;
}

SpaceTimeBound WithoutDirection(SpaceTimeBound bound) {
  bound.state.direction.setZero();
  return bound;
}

double AccelerationSeen(SpaceTimeBound free, const MotionState& next) {
  return LargestRefuted(free.limits.acceleration_max, [&](double value) {
    free.limits.acceleration_max = value;
    return IsBreached(free, next);
  });
}

double AgainstDirectionSeen(const SpaceTimeBound& uncapped, const MotionState& next) {
  return LargestRefuted(0, [&](double value) {
    SpaceTimeBound shifted = uncapped;
    shifted.state.a_WA -= value * uncapped.state.direction.normalized();
    shifted.limits.acceleration_max = numeric::AddUp(uncapped.limits.acceleration_max, value);
    return IsBreached(shifted, next);
  });
}

double SpeedSeen(SpaceTimeBound before, const MotionState& next) {
  return LargestRefuted(before.limits.speed_max, [&](double value) {
    before.limits.speed_max = value;
    return IsBreached(before, next);
  });
}

double AngularAccelerationSeen(SpaceTimeBound before, const MotionState& next) {
  return LargestRefuted(before.limits.angular_acceleration_max, [&](double value) {
    before.limits.angular_acceleration_max = value;
    const ContractCheck check = CheckContract(before, next, OrientationUse::kMatters);
    return check.rotation_excess > 0 || check.angular_velocity_excess > 0;
  });
}

}  // namespace

BrokenBound ExplainBreach(const SpaceTimeBound& before, const MotionState& next,
                          OrientationUse orientation) {
  BrokenBound broken{.from = before.state.stamp, .at = next.stamp};
  const SpaceTimeBound uncapped = WithoutCap(before);
  const SpaceTimeBound free = WithoutDirection(uncapped);
  if (IsBreached(free, next)) {
    broken.bound = DeclaredBound::kAccelerationMax;
    broken.declared = before.limits.acceleration_max;
    broken.seen = AccelerationSeen(free, next);
  } else if (IsBreached(uncapped, next)) {
    broken.bound = DeclaredBound::kThrustDirection;
    broken.seen = AgainstDirectionSeen(uncapped, next);
  } else if (IsBreached(before, next)) {
    broken.bound = DeclaredBound::kSpeedMax;
    broken.declared = before.limits.speed_max;
    broken.seen = SpeedSeen(before, next);
  } else {
    CORE_CHECK(orientation == OrientationUse::kMatters, "only a breach is explained");
    broken.bound = DeclaredBound::kAngularAccelerationMax;
    broken.declared = before.limits.angular_acceleration_max;
    broken.seen = AngularAccelerationSeen(before, next);
  }
  return broken;
}

}  // namespace collision::motion
