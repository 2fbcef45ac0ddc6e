#include "collision_core/broad_phase/face_sweep/face_sweep_window.h"

#include <algorithm>
#include <cmath>

#include "collision_core/numeric/seconds.h"

namespace collision::broad_phase {
namespace {

constexpr std::size_t kSampleMax = 1024;

/// A window is cut into 2^30 ticks; in a short one an agent moves by at most ℓ / 2^6.
constexpr double kTicksPerLength = 0x1p+24;

/// Longer than any window, and an integer when converted.
constexpr double kWindowMax = 0x1p+62;

double Quantile(std::vector<double>* values, std::size_t part, std::size_t parts) {
  const auto at = values->begin() + (values->size() - 1) * part / parts;
  std::nth_element(values->begin(), at, values->end());
  return *at;
}

/// A property of each of the sample's agents.
template <typename Property>
std::vector<double> Gather(const std::vector<const motion::SpaceTimeBound*>& sample,
                           Property property) {
  std::vector<double> values;
  values.reserve(sample.size());
  for (const motion::SpaceTimeBound* bound : sample) values.push_back(property(*bound));
  return values;
}

/// The mean distance of N agents in the inner three quarters of the sample's box.
double Spacing(const std::vector<const motion::SpaceTimeBound*>& sample, std::size_t count) {
  double extent = 0;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> p =
        Gather(sample, [&](const motion::SpaceTimeBound& bound) { return bound.state.p_WA[axis]; });
    extent = std::max(extent, Quantile(&p, 7, 8) - Quantile(&p, 1, 8));
  }
  std::size_t per_axis = 1;
  while (per_axis * per_axis * per_axis < count) ++per_axis;
  return extent / static_cast<double>(per_axis);
}

/// How fast the agents move relative to each other.
double Speed(const std::vector<const motion::SpaceTimeBound*>& sample) {
  std::vector<double> apart(sample.size(), 0);
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> v =
        Gather(sample, [&](const motion::SpaceTimeBound& bound) { return bound.state.v_WA[axis]; });
    const double middle = Quantile(&v, 1, 2);
    for (std::size_t i = 0; i < sample.size(); ++i) {
      apart[i] = std::max(apart[i], std::abs(sample[i]->state.v_WA[axis] - middle));
    }
  }
  return Quantile(&apart, 7, 8);
}

}  // namespace

std::int64_t FirstWindow(const BoundList& bounds, const std::vector<std::uint32_t>& agents) {
  std::vector<const motion::SpaceTimeBound*> sample;
  const std::size_t step = agents.size() / kSampleMax + 1;
  for (std::size_t i = 0; i < agents.size(); i += step) sample.push_back(&bounds[agents[i]]->bound);
  if (sample.empty()) return 1;
  std::vector<double> radii =
      Gather(sample, [](const motion::SpaceTimeBound& bound) { return bound.limits.radius; });
  std::vector<double> accelerations = Gather(sample, [](const motion::SpaceTimeBound& bound) {
    return bound.limits.acceleration_max + bound.state.a_WA.norm();
  });
  const double length = Quantile(&radii, 7, 8) + Spacing(sample, agents.size());
  // Infinite, or not a number, if nothing moves or has a length: any window will do then.
  const double seconds = std::min(std::sqrt(length / Quantile(&accelerations, 7, 8)),
                                  kTicksPerLength * length / Speed(sample));
  const double nanoseconds = numeric::kNanosecondsPerSecond * seconds;
  if (!(nanoseconds < kWindowMax)) return static_cast<std::int64_t>(kWindowMax);
  return std::max<std::int64_t>(static_cast<std::int64_t>(nanoseconds), 1);
}

Instant WithEarliness(Instant first, Instant time) {
  const __int128 distance = static_cast<__int128>(time.nanoseconds()) - first.nanoseconds();
  const __int128 last = time.nanoseconds() + (distance >> 29) + 3;
  const __int128 latest = Instant::Never().nanoseconds() - 1;
  return Instant::FromNanoseconds(static_cast<std::int64_t>(std::min(last, latest)));
}

}  // namespace collision::broad_phase
