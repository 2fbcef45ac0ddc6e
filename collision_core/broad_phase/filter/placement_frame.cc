#include "collision_core/broad_phase/filter/placement_frame.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "collision_core/numeric/allowances.h"
#include "collision_core/numeric/cube_root.h"
#include "collision_core/numeric/seconds.h"

namespace collision::broad_phase {
namespace {

/// The number of agents that are sampled to choose frame and window.
constexpr std::uint32_t kSampleMax = 1024;

/// Places that come within reach of an agent's own during the first window: as many are looked at
/// for want of smaller cells.
constexpr double kNearPerAgent = 16;

/// Where agents are that near already, the window lets reaches grow by this part.
constexpr double kGrowthMin = 0.25;

/// The averages over a sample of agents.
struct Sample {
  double v[3] = {};
  double speed = 0;  ///< As seen from a frame that moves with v.
  double s0 = 0, s1 = 0, s2 = 0, s3 = 0;
  double volume = 0;  ///< The volume of the box around all, divided among them.
};

Sample TakeSample(const HornTable& table, Instant from) {
  Sample sample;
  const std::uint32_t stride = table.size() / kSampleMax + 1;
  double low[3] = {numeric::kInfinity, numeric::kInfinity, numeric::kInfinity},
         high[3] = {-numeric::kInfinity, -numeric::kInfinity, -numeric::kInfinity};
  double speed = 0, count = 0;
  for (std::uint32_t agent = 0; agent < table.size(); agent += stride) {
    if (!table.contains(agent) || table.row(agent).unfilterable) continue;
    const numeric::QuickBall horn = table.At(agent, from);
    count += 1;
    speed += Length(horn.v);
    sample.s0 += horn.s0, sample.s1 += horn.s1, sample.s2 += horn.s2 + Length(horn.bend);
    sample.s3 += horn.s3;
    for (int axis = 0; axis < 3; ++axis) {
      sample.v[axis] += horn.v[axis];
      low[axis] = std::min(low[axis], horn.c[axis]);
      high[axis] = std::max(high[axis], horn.c[axis]);
    }
  }
  if (count == 0) return sample;
  for (double* sum :
       {&sample.v[0], &sample.v[1], &sample.v[2], &sample.s0, &sample.s1, &sample.s2, &sample.s3})
    *sum /= count;
  for (std::uint32_t agent = 0; agent < table.size(); agent += stride) {
    if (!table.contains(agent) || table.row(agent).unfilterable) continue;
    const double* v = table.row(agent).ball.v;
    const double seen[3] = {v[0] - sample.v[0], v[1] - sample.v[1], v[2] - sample.v[2]};
    sample.speed += Length(seen);
  }
  // A single fast agent would drag a mean along with it.
  if (sample.speed > 0.5 * speed) {
    std::fill_n(sample.v, 3, 0.0);
    sample.speed = speed;
  }
  sample.speed /= count;
  sample.volume = 1 / static_cast<double>(table.count());
  for (int axis = 0; axis < 3; ++axis) {
    sample.volume *= std::max(high[axis] - low[axis], 4 * sample.s0);
  }
  return sample;
}

/// The time in which reaches grow so far that kNearPerAgent places lie within two of them: in a
/// ball of (4/3) π (2 R)³. The way counts half, as the middle is what it is measured from.
double WindowOf(const Sample& sample) {
  constexpr double kBall = 33.5;
  // In place of a volume that underflows, so that a root can be taken [m³].
  constexpr double kVolumeLeast = 1e-300;
  const double reach =
      numeric::CubeRoot(std::max(kNearPerAgent / kBall * sample.volume, kVolumeLeast));
  const double growth = std::max(reach - sample.s0, kGrowthMin * sample.s0);
  const double rate = sample.s1 + 0.5 * sample.speed;
  double window = kWindowMax;
  if (rate > 0 || sample.s2 > 0) {
    window = 2 * growth / (rate + std::sqrt(rate * rate + 4 * sample.s2 * growth));
  }
  if (sample.s3 > 0) window = std::min(window, numeric::CubeRoot(growth / sample.s3));
  return std::clamp(window, kWindowMin, kWindowMax);
}

double SignedSeconds(Instant from, Instant to) {
  return to < from ? -numeric::SecondsBetween(to, from).upper
                   : numeric::SecondsBetween(from, to).upper;
}

}  // namespace

PlacementFrame::PlacementFrame(const HornTable& table, const intersection::BroadQuery& query,
                               double seconds_max)
    : query_(query) {
  window_ = std::clamp(seconds_max, kWindowMin, kWindowMax);
  if (is_unfilterable()) return;
  if (query_.bound == intersection::BoundKind::kHypertrapezoid) {
    duration_ = SignedSeconds(query_.from, query_.until);
  }
  const Sample sample = TakeSample(table, query.from);
  std::copy_n(sample.v, 3, v_);
  Shorten(WindowOf(sample));
}

void PlacementFrame::Shorten(double seconds) {
  window_ = std::clamp(seconds, kWindowMin, window_);
  middle_ = 0.5 * window_;
  slack_ = static_cast<float>(middle_) * kFilterSlack * numeric::kSomeFloatRoundingsUp;
  least_ = static_cast<float>(middle_) * kReachLeast * numeric::kSomeFloatRoundingsUp;
}

// The middle part of the sample along x; of that the middle part along y, and then along z.
Region PlacementFrame::Crowd(const HornTable& table, std::size_t count) const {
  struct Point {
    double c[3];
  };
  std::vector<Point> points;
  const std::uint32_t stride = table.size() / kSampleMax + 1;
  for (std::uint32_t agent = 0; agent < table.size(); agent += stride) {
    if (!table.contains(agent) || table.row(agent).unfilterable) continue;
    const numeric::QuickBall horn = table.At(agent, query_.from);
    points.push_back({{horn.c[0], horn.c[1], horn.c[2]}});
  }
  const double part =
      numeric::CubeRoot(static_cast<double>(count) / static_cast<double>(table.count()));
  Region region;
  for (int axis = 0; axis < 3; ++axis) {
    region.low[axis] = numeric::kInfinity, region.high[axis] = -numeric::kInfinity;
    if (points.empty()) continue;
    std::sort(points.begin(), points.end(),
              [axis](const Point& a, const Point& b) { return a.c[axis] < b.c[axis]; });
    const auto size = static_cast<double>(points.size());
    const auto kept = static_cast<std::ptrdiff_t>(std::min(std::max(part * size, 2.0), size));
    const std::ptrdiff_t first = (std::ssize(points) - kept) / 2;
    points.erase(points.begin() + first + kept, points.end());
    points.erase(points.begin(), points.begin() + first);
    region.low[axis] = points.front().c[axis], region.high[axis] = points.back().c[axis];
  }
  return region;
}

TimeWindow PlacementFrame::After(Instant from, double seconds) const {
  const double first = SignedSeconds(query_.from, from);
  return {first, std::max(first, 0.0) + seconds};
}

}  // namespace collision::broad_phase
