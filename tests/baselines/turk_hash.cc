#include "tests/baselines/turk_hash.h"

#include <bit>
#include <cmath>

namespace collision::baselines {
namespace {

/// Slots for each cube: few chains are shared, and the table still lies close together.
constexpr std::size_t kSlotsPerCube = 2;

std::size_t SlotOf(int x, int y, int z, std::size_t mask) {
  const std::uint64_t mixed = 0x9e3779b97f4a7c15 * static_cast<std::uint64_t>(x) ^
                              0xc2b2ae3d27d4eb4f * static_cast<std::uint64_t>(y) ^
                              0x165667b19e3779f9 * static_cast<std::uint64_t>(z);
  return (mixed >> 20) & mask;
}

}  // namespace

void TurkHash::EnterAndTest(const MovingCubes& cubes, std::uint32_t cube, std::size_t slot,
                            std::optional<CubePair>* first) {
  for (std::int32_t at = slots_[slot]; at >= 0; at = entries_[at].next) {
    // Two cells of one cube may share a slot.
    if (entries_[at].cube != cube) Test(cubes, cube, entries_[at].cube, first);
  }
  entries_.push_back({cube, slots_[slot]});
  slots_[slot] = static_cast<std::int32_t>(entries_.size()) - 1;
}

std::optional<CubePair> TurkHash::Look(const MovingCubes& cubes) {
  const std::size_t size = std::bit_ceil(kSlotsPerCube * cubes.count());
  slots_.assign(size, -1);
  entries_.clear();
  std::optional<CubePair> first;
  const double scale = 1 / cell_, half = 0.5 * MovingCubes::kSide;
  for (std::uint32_t cube = 0; cube < cubes.count(); ++cube) {
    ++work_.rebuilds;
    const Eigen::Vector3d& p = cubes.position(cube);
    int lower[3], upper[3];
    for (int axis = 0; axis < 3; ++axis) {
      lower[axis] = static_cast<int>(std::floor((p[axis] - half) * scale));
      upper[axis] = static_cast<int>(std::floor((p[axis] + half) * scale));
    }
    for (int x = lower[0]; x <= upper[0]; ++x) {
      for (int y = lower[1]; y <= upper[1]; ++y) {
        for (int z = lower[2]; z <= upper[2]; ++z) {
          EnterAndTest(cubes, cube, SlotOf(x, y, z, size - 1), &first);
        }
      }
    }
  }
  return first;
}

}  // namespace collision::baselines
