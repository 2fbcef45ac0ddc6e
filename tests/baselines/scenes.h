// Seeded scenes of balls, from the paper's and from what breaks methods.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tests/baselines/ball_scene.h"

namespace collision::baselines {

/// Cubes at random in a cubic region, and the balls around them.
struct UniformOptions {
  std::uint32_t count = 1000;
  double density = 0.01;        ///< The part of the region's volume that the cubes fill.
  double side = 1;              ///< Of a cube [m].
  double speed_max = 2;         ///< Along each axis [m/s].
  double acceleration_max = 1;  ///< [m/s²]
  /// No two meet before this [s]: each agent that would is drawn again. 0: they are only apart.
  double clear_until = 0;
  std::uint64_t seed = 1;
};

/// The first meeting of a large scene comes just after `clear_until`: what meets there is common.
BallScene UniformScene(const UniformOptions& options);

/// The horizon of every query about these scenes [s].
constexpr double kHorizon = 1;

/// When the first meeting comes.
enum class FirstHit { kAtOnce, kHalf, kNever };
const char* Name(FirstHit hit);

/// The paper's scene of density 1 % whose first meeting comes at once, at half the horizon or not
/// within it.
BallScene FirstHitScene(std::uint32_t count, FirstHit hit);

/// The names of the other scenes.
std::vector<std::string> SceneNames();

/// clustered, mixed-sizes (1 : 1e6), mixed-acceleration, lattice, falling-pile, convoy, one-cell,
/// one-fast. `count` agents, less a few that would overlap at the start. Throws
/// std::invalid_argument for another name.
BallScene MakeScene(const std::string& name, std::uint32_t count, std::uint64_t seed);

}  // namespace collision::baselines
