#include "tests/soak/plan.h"

#include <algorithm>
#include <cmath>

#include "tests/support/random.h"

namespace collision::soak {
namespace {

constexpr double kBetweenSites = 1000;   // [m] along x
constexpr double kBetweenWatches = 1e5;  // [m] along y, of a watch and the next one
constexpr double kHalfSide = 3;          // [m] of the cube that the agents of a site fly through
constexpr int kVisitors = 3;             // the crew of ever-new names
constexpr int kShapeEvery = 2;
constexpr int kLifeWatches = 240;
constexpr int kKilledEvery = 8;

Eigen::Vector3d InCube(Random* random) {
  const double x = random->Uniform(-kHalfSide, kHalfSide);
  const double y = random->Uniform(-kHalfSide, kHalfSide);
  const double z = random->Uniform(-kHalfSide, kHalfSide);
  return {x, y, z};
}

}  // namespace

Flight FlightOf(const Plan& plan, int watch, int crew, int site) {
  Random random(static_cast<std::uint64_t>((watch * kCrews + crew) * kSites + site));
  const Eigen::Vector3d origin(kBetweenSites * site, watch % 2 == 0 ? 0 : kBetweenWatches, 0);
  const Eigen::Vector3d from = InCube(&random), to = InCube(&random);
  return {.p_m = origin + from,
          .v_m_s = (to - from) / (1e-9 * static_cast<double>(plan.watch_ns())),
          .radius_m = random.Uniform(0.5, 1),
          .has_shape = (site + crew) % kShapeEvery == 0};
}

int SiteOf(double x_m) { return static_cast<int>(std::lround(x_m / kBetweenSites)); }

Meeting MeetingOf(const Plan& plan, int watch, int site, int crew, int other) {
  using Vector = Eigen::Matrix<long double, 3, 1>;
  const Flight a = FlightOf(plan, watch, crew, site), b = FlightOf(plan, watch, other, site);
  const Vector p = b.p_m.cast<long double>() - a.p_m.cast<long double>();
  const Vector v = b.v_m_s.cast<long double>() - a.v_m_s.cast<long double>();
  const long double reach = static_cast<long double>(a.radius_m) + b.radius_m;
  const long double watch_s = 1e-9L * static_cast<long double>(plan.watch_ns());
  const long double middle = -p.dot(v) / v.squaredNorm();
  const long double nearest = (p + std::clamp(middle, 0.0L, watch_s) * v).norm();
  Meeting meeting{.depth_m = static_cast<double>(reach - nearest)};
  if (meeting.depth_m <= 0) return meeting;
  // |p + v t| = reach at middle ± half.
  const long double least = (p + middle * v).squaredNorm();
  const long double half = std::sqrt((reach * reach - least) / v.squaredNorm());
  const auto instant = [&](long double seconds) {
    return plan.BeginOf(watch) +
           static_cast<std::int64_t>(std::floor(1e9L * std::clamp(seconds, 0.0L, watch_s)));
  };
  meeting.begin_ns = instant(middle - half);
  meeting.end_ns = instant(middle + half);
  meeting.begins_inside = middle - half > 0;
  return meeting;
}

Life LifeOf(const Plan& plan, int crew, int life) {
  Random random(static_cast<std::uint64_t>(1'000'000 * crew + life));
  if (crew == 0) return {.name = "crew-0", .watches = plan.watches()};
  const int watches = kLifeWatches / 2 + static_cast<int>(random.Below(kLifeWatches));
  if (crew == kVisitors) return {.name = "visitor-" + std::to_string(life), .watches = watches};
  // The first ones of two crews are killed at different times.
  return {.name = "crew-" + std::to_string(crew),
          .watches = watches,
          .killed = life % kKilledEvery == crew};
}

}  // namespace collision::soak
