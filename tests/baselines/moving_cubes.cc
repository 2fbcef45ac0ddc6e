#include "tests/baselines/moving_cubes.h"

#include <cmath>

#include "tests/baselines/cells.h"
#include "tests/support/random_points.h"

namespace collision::baselines {
namespace {

/// The force on a cube in a frame is the same for every method.
Random ForceOf(std::uint64_t seed, std::uint32_t cube, std::int64_t frame) {
  return Random(seed + 0xd1342543de82ef95 * cube + 0xaf251af3b0f025b5 * (frame + 1));
}

}  // namespace

MovingCubes::MovingCubes(const Options& options) : options_(options) {
  Random random(options.seed);
  const double half = 0.5 * std::cbrt(options.count * std::pow(kSide, 3) / options.density);
  Cells cells(half, kSide);
  while (p_WA_.size() < options.count) {
    const Eigen::Vector3d p = InCube(random, half);
    const bool overlaps = cells.AnyNear(
        p, [&](int other) { return (p - p_WA_[other]).cwiseAbs().maxCoeff() <= kSide; });
    if (overlaps) continue;
    cells.Add(p);
    p_WA_.push_back(p);
    v_WA_.push_back(InCube(random, options.speed_max));
  }
}

void MovingCubes::NextFrame() {
  const double dt = kFrame;
  for (std::uint32_t i = 0; i < count(); ++i) {
    // A little below M, so that rounding takes no motion outside its bound.
    Random random = ForceOf(options_.seed, i, frame_);
    const Eigen::Vector3d unit = random.UnitVector();
    const Eigen::Vector3d a = unit * (random.Uniform(0, 0.999) * options_.acceleration_max);
    p_WA_[i] += v_WA_[i] * dt + 0.5 * dt * dt * a;
    v_WA_[i] += a * dt;
  }
  ++frame_;
}

BallAgent MovingCubes::Ball(std::uint32_t cube) const {
  static const double kRadiusOverSide = std::sqrt(0.75);
  return {p_WA_[cube], v_WA_[cube], kRadiusOverSide * kSide, options_.acceleration_max, time()};
}

}  // namespace collision::baselines
