// Ground that never moves: a mesh of any size, generated from a seed.
#pragma once

#include <cstdint>

#include "client/programs/shared/pace.h"
#include "client/programs/simulators/motion/motion_log.h"
#include "collision/shape.h"

namespace collision::client {

struct TerrainOptions {
  std::size_t triangles = 100'000;  ///< Maximum number; at least kTerrainTrianglesMin.
  double size_m = 160;              ///< Of its square, from the world's origin along +x and +y.
  double relief_m = 12;             ///< From the lowest possible point to the highest.
  double base_m = 0;                ///< World z of the lowest possible point.
  std::uint64_t seed = 1;
  std::string name = "terrain";
};

inline constexpr std::size_t kTerrainTrianglesMin = 50;
inline constexpr double kTerrainSizeMax = 1e6;  ///< [m] The ground is flat: no planet.

/// A closed block: hills on a grid on top, walls around, a flat floor a quarter of the relief below
/// the lowest point. The reference point is in the middle of the square, at the lowest height. The
/// hills are value noise in four octaves: sums and products of seeded numbers, the same on every
/// platform.
Triangles TerrainMesh(const TerrainOptions& options);

/// Publishes the ground once, then only the clock. The ground declares that it never moves, so the
/// service wants no further state. In real time everything that flies inside the ground's ball
/// may touch it until the service has built the tree; in lock-step time waits for that.
void ServeTerrain(const TerrainOptions& options, Pace* pace, MotionLog* log);

}  // namespace collision::client
