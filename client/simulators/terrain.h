// Ground that never moves: a mesh of any size, made up from a seed.
#pragma once

#include <cstdint>
#include <memory>

#include "client/shape.h"
#include "client/simulators/motion_log.h"
#include "client/simulators/pace.h"

namespace collision::client {

struct TerrainOptions {
  std::size_t triangles = 100'000;  ///< At most; at least kTerrainTrianglesMin.
  double size_m = 160;              ///< Of its square, from the world's origin along +x and +y.
  double relief_m = 12;             ///< From the lowest point that may be to the highest.
  double base_m = 0;                ///< World z of the lowest point that may be.
  std::uint64_t seed = 1;
  std::string name = "terrain";
  /// Before time begins it waits so long for the service to have built its tree; until then what
  /// flies may meet anything within the ground's ball.
  double await_tree_s = 0;
  /// The coarse tree is enough, which is there long before: the wanted one follows in the run.
  bool coarse_is_enough = false;
};

inline constexpr std::size_t kTerrainTrianglesMin = 50;
inline constexpr double kTerrainSizeMax = 1e6;  ///< [m] The ground is flat: no planet.

/// The others wait 30 s for a grant.
inline constexpr double kAwaitTreeMax = 25;

/// A closed block: hills on a grid above, walls around, flat below, a quarter of the relief deeper
/// than the lowest point. The reference point is in the middle of the square, at that lowest height. Hills are value noise in four octaves: sums and
/// products of seeded numbers, the same everywhere.
Triangles TerrainMesh(const TerrainOptions& options);

/// Tells the ground once and then the time. It declares that it never moves, so the service asks
/// nothing of it.
void ServeTerrain(const TerrainOptions& options, const SimulatorOptions& simulator, Pace* pace,
                  MotionLog* log);

}  // namespace collision::client
