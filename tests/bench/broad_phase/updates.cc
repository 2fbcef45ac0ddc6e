#include "tests/bench/broad_phase/updates.h"

#include <cmath>
#include <numeric>
#include <utility>

#include "tests/baselines/scenes.h"
#include "tests/support/random.h"

namespace collision::bench {
namespace {

constexpr double kRate = 20, kWarmUp = 0.5;
constexpr double kAccelerationMax = 1;
/// The acceleration of the swing along one direction; below M, so that rounding breaks no bound.
constexpr double kAcceleration = 0.9 * kAccelerationMax;
/// How far it takes an agent from its home [m].
constexpr double kReach = 0.5;

/// To and fro under an acceleration that changes sign on its way through the home: no sine needed.
struct Swing {
  Eigen::Vector3d home, direction;
  double phase;  ///< [s]

  void At(double t, baselines::BallAgent* agent) const {
    // A quarter of the swing leads from the home, at greatest speed, to its end, at rest.
    const double quarter = std::sqrt(2 * kReach / kAcceleration), half = 2 * quarter;
    const double in_swing = std::fmod(t + phase, 2 * half);
    const double in_half = std::fmod(in_swing, half);
    const double sign = in_swing < half ? 1 : -1;
    const double speed = kAcceleration * quarter;
    const double along = in_half * (speed - 0.5 * kAcceleration * in_half);
    agent->p_WA = home + direction * (sign * along);
    agent->v_WA = direction * (sign * (speed - kAcceleration * in_half));
    agent->stamp = t;
  }
};

}  // namespace

UpdateStream MakeUpdates(std::uint32_t agents, std::size_t count) {
  baselines::UniformOptions options;
  options.count = agents;
  // As far apart as balls that hold a whole swing.
  const double radius = std::sqrt(0.75);
  options.side = (radius + kReach) / radius;
  options.density = 0.01 * options.side * options.side * options.side;
  UpdateStream stream;
  stream.start = baselines::UniformScene(options);
  stream.horizon = baselines::kHorizon;
  stream.period = 1 / kRate;
  Random random(7);
  std::vector<Swing> swings;
  for (baselines::BallAgent& agent : stream.start) {
    swings.push_back({agent.p_WA, random.UnitVector(), random.Uniform(0, 10)});
    agent.radius = radius, agent.acceleration_max = kAccelerationMax;
    swings.back().At(0, &agent);
  }
  std::vector<std::uint32_t> order(agents);
  std::iota(order.begin(), order.end(), 0);
  for (std::uint32_t i = 0; i < agents; ++i) {
    std::swap(order[i], order[i + random.Below(agents - i)]);
  }
  stream.warm_up = static_cast<std::size_t>(kWarmUp * kRate) * agents;
  const std::size_t all = stream.warm_up + count;
  stream.updates.reserve(all);
  for (std::size_t i = 0; i < all; ++i) {
    const std::uint32_t agent = order[i % agents];
    stream.updates.push_back({agent, stream.start[agent]});
    swings[agent].At(static_cast<double>(i + 1) / (kRate * agents), &stream.updates.back().state);
  }
  return stream;
}

}  // namespace collision::bench
