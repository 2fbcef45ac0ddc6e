#include "tests/baselines/scenes.h"

#include <cmath>

#include "tests/baselines/cells.h"
#include "tests/support/random_points.h"

namespace collision::baselines {
namespace {

/// Draws are given up after this many failures in a row: the region is full.
constexpr int kDrawsMax = 10000;

}  // namespace

BallScene UniformScene(const UniformOptions& options) {
  Random random(options.seed);
  const double volume = options.count * std::pow(options.side, 3) / options.density;
  const double half = 0.5 * std::cbrt(volume);
  const double radius = options.side * std::sqrt(0.75);
  const double time = options.clear_until;
  const double reach = radius + std::sqrt(3.0) * options.speed_max * time +
                       0.5 * options.acceleration_max * time * time;
  Cells cells(half, 2 * reach);
  BallScene scene;
  scene.reserve(options.count);
  for (int draws = 0; scene.size() < options.count && draws < kDrawsMax; ++draws) {
    BallAgent agent{InCube(random, half), InCube(random, options.speed_max), radius,
                    options.acceleration_max, 0};
    const bool meets = cells.AnyNear(agent.p_WA, [&](int other) {
      return ReferenceIntersectionTime(agent, scene[other], time) <= time;
    });
    if (meets) continue;
    cells.Add(agent.p_WA);
    scene.push_back(agent);
    draws = 0;
  }
  return scene;
}

const char* Name(FirstHit hit) {
  return hit == FirstHit::kAtOnce ? "at_once" : hit == FirstHit::kHalf ? "half" : "never";
}

BallScene FirstHitScene(std::uint32_t count, FirstHit hit) {
  UniformOptions options;
  options.count = count;
  // A little beyond the horizon, so that no method's rounding finds a meeting within it.
  options.clear_until = hit == FirstHit::kAtOnce ? 0
                        : hit == FirstHit::kHalf ? 0.5 * kHorizon
                                                 : 1.001 * kHorizon;
  return UniformScene(options);
}

}  // namespace collision::baselines
