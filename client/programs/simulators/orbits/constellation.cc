#include "client/programs/simulators/orbits/constellation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "client/library/vector.h"
#include "client/programs/simulators/motion/random.h"
#include "client/programs/simulators/orbits/orbit.h"

namespace collision::client {
namespace {

constexpr double kCrossingFrom = 90;   // [s] look-ahead and more, so that all are far apart before
constexpr double kCrossingUntil = 20;  // [s] before the end: contacts are over by then
constexpr double kSpeedSpread = 1e-3;  // of a circle's speed
constexpr std::uint64_t kSatelliteSeeds = 0x10001;  // satellites and crossings draw different ones
constexpr std::uint64_t kCrossingSeeds = 0x20003;

Vector3 UnitOf(const Vector3& v) { return Scaled(v, 1 / Norm(v)); }

}  // namespace

Crossing CrossingOf(const ConstellationOptions& options, std::size_t number) {
  SeededRandom random(options.seed ^ (kCrossingSeeds * (number + 1)));
  const double until = std::max(kCrossingFrom, options.seconds - kCrossingUntil);
  Crossing crossing;
  crossing.seconds = random.Uniform(kCrossingFrom, until);
  crossing.middle_m = Scaled(UnitOf(random.InUnitBall()), kEarthRadius + options.altitude_m);
  return crossing;
}

PositionAndVelocity SatelliteAtStart(const ConstellationOptions& options, std::size_t number) {
  const Crossing crossing = CrossingOf(options, number % options.crossings);
  SeededRandom random(options.seed ^ (kSatelliteSeeds * (number + 1)));
  const Vector3 position = Sum(crossing.middle_m, Scaled(random.InUnitBall(), options.spread_m));
  const Vector3 up = UnitOf(position);
  const Vector3 east = UnitOf(Cross(up, UnitOf(random.InUnitBall())));  // any horizontal direction
  const double azimuth = random.Uniform(0, 2 * std::numbers::pi);
  const Vector3 heading =
      Sum(Scaled(east, std::cos(azimuth)), Scaled(Cross(up, east), std::sin(azimuth)));
  const double circular = std::sqrt(kEarthMu / Norm(position));
  const double speed = circular * (1 + random.Uniform(-kSpeedSpread, kSpeedSpread));
  return Integrated({position, Scaled(heading, speed)}, -crossing.seconds, options.step_s);
}

}  // namespace collision::client
