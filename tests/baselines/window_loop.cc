#include "tests/baselines/window_loop.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/baselines/frame_bounds.h"

namespace collision::baselines {
namespace {

/// All pairs of so few are tested in less time than their bounds take.
constexpr std::uint32_t kFewCubes = 12;

constexpr std::int64_t kFramesMin = 2, kFramesMax = 240;

/// To put a cube into a list costs about as much as so many tests of a pair. Twice the window can
/// be several times the pairs.
constexpr double kTestsPerCube = 8, kGrowth = 8;

}  // namespace

// Rounded up, by more than all of this rounds.
bool WindowLoop::ListInOnePass(const MovingCubes& cubes) {
  constexpr double kUp = 1 + 0x1p-20;
  const double half = 0.5 * static_cast<double>(frames_) * MovingCubes::kFrame * (1 + 0x1p-40);
  const BallAgent any = cubes.Ball(0);
  const double still = any.radius + 2 * any.acceleration_max * half * half;
  const auto at = [&](std::uint32_t cube, broad_phase::ReachPoint* point) {
    const Eigen::Vector3d &p = cubes.position(cube), &v = cubes.velocity(cube);
    for (int axis = 0; axis < 3; ++axis) point->c[axis] = p[axis] + v[axis] * half;
    point->reach = static_cast<float>((still + std::sqrt(v.squaredNorm()) * half) * kUp);
    return true;
  };
  if (!grid_.Build(cubes.count(), cubes.count(), 0, at)) return false;
  grid_.ForEachPair([&](std::uint32_t k, std::uint32_t l) { list_.push_back({k, l}); });
  return true;
}

void WindowLoop::ListByPhase(const MovingCubes& cubes) {
  for (std::uint32_t cube = 0; cube < cubes.count(); ++cube) {
    phase_->Set(cube, BoundOf(cubes, cube));
  }
  phase_->FindNearPairs(
      {intersection::BoundKind::kHorn, InstantOf(cubes), InstantOf(cubes, frames_)}, &list_);
}

void WindowLoop::ListAll(const MovingCubes& cubes) {
  list_.reserve(cubes.count() * cubes.count() / 2);
  for (std::uint32_t k = 0; k < cubes.count(); ++k) {
    for (std::uint32_t l = k + 1; l < cubes.count(); ++l) list_.push_back({k, l});
  }
  covered_ = std::numeric_limits<std::int64_t>::max();
}

void WindowLoop::MakeList(const MovingCubes& cubes) {
  if (cubes.count() <= kFewCubes) return ListAll(cubes);
  list_.clear();
  list_.reserve(cubes.count());
  if (!ListInOnePass(cubes)) ListByPhase(cubes);
  covered_ = cubes.frame() + frames_;
  work_.rebuilds += cubes.count();
  ++work_.queries;
  const double tests = static_cast<double>(list_.size()) * static_cast<double>(frames_);
  const double most = kTestsPerCube * cubes.count();
  if (kGrowth * tests < most) frames_ = std::min(kFramesMax, 2 * frames_);
  if (tests > most) frames_ = std::max(kFramesMin, frames_ / 2);
}

std::optional<CubePair> WindowLoop::Look(const MovingCubes& cubes) {
  if (cubes.frame() > covered_) MakeList(cubes);
  std::optional<CubePair> first;
  for (const broad_phase::NearPair& pair : list_) Test(cubes, pair.lower, pair.higher, &first);
  return first;
}

}  // namespace collision::baselines
