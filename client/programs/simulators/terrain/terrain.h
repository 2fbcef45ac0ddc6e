// Ground that never moves: a mesh of any size, generated from a seed.
#pragma once

#include <cstdint>

#include "client/api/shape.h"
#include "client/programs/shared/pace.h"
#include "client/programs/simulators/motion/motion_log.h"

namespace collision::client {

struct TerrainOptions {
  std::size_t triangles = 100'000;  ///< Maximum number; at least kTerrainTrianglesMin.
  double size_m = 160;              ///< Of its square, from the world's origin along +x and +y.
  double relief_m = 12;             ///< From the lowest possible point to the highest.
  double base_m = 0;                ///< World z of the lowest possible point.
  std::uint64_t seed = 1;
  std::string name = "terrain";
  /// Time to wait for the service to build the ground's tree before the run begins. Until the tree
  /// exists, everything that flies inside the ground's ball may touch it.
  double await_tree_s = 0;
  /// Wait for the coarse tree only, which exists much earlier; the fine one follows in the run.
  bool coarse_is_enough = false;
};

inline constexpr std::size_t kTerrainTrianglesMin = 50;
inline constexpr double kTerrainSizeMax = 1e6;  ///< [m] The ground is flat: no planet.

/// Less than the 120 s for which other simulators wait for a grant [s].
inline constexpr double kAwaitTreeMax = 25;

/// A closed block: hills on a grid on top, walls around, a flat floor a quarter of the relief below
/// the lowest point. The reference point is in the middle of the square, at the lowest height. The
/// hills are value noise in four octaves: sums and products of seeded numbers, the same on every
/// platform.
Triangles TerrainMesh(const TerrainOptions& options);

/// Publishes the ground once, then only the clock. The ground declares that it never moves, so the
/// service wants no further state.
void ServeTerrain(const TerrainOptions& options, const SimulatorOptions& simulator, Pace* pace,
                  MotionLog* log);

}  // namespace collision::client
