// Scenes that are hard on a sweep, and the plainest answer to them.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "collision_core/broad_phase/face_sweep/face_sweep.h"
#include "tests/support/random.h"

namespace collision::broad_phase {

struct SweepScene {
  std::vector<AgentBound> agents;
  intersection::BroadQuery query;
};

inline constexpr std::int64_t kSecond = 1'000'000'000;
inline constexpr std::int64_t kCentury = 3'155'760'000 * kSecond;

inline Instant At(std::int64_t nanoseconds) { return Instant::FromNanoseconds(nanoseconds); }

inline Eigen::Vector3d RandomVector(Random* random, double extent) {
  const double x = random->Uniform(-extent, extent), y = random->Uniform(-extent, extent);
  return {x, y, random->Uniform(-extent, extent)};
}

inline motion::SpaceTimeBound Agent(const Eigen::Vector3d& p, const Eigen::Vector3d& v,
                                    double radius, double acceleration_max = 0) {
  motion::SpaceTimeBound bound;
  bound.state.p_WA = p;
  bound.state.v_WA = v;
  bound.limits.radius = radius;
  bound.limits.acceleration_max = acceleration_max;
  return bound;
}

/// The kinds of scene: how positions and motions are laid out.
enum class SweepLayout {
  kUniform,      ///< Anywhere, at any speed.
  kLattice,      ///< Whole numbers everywhere: equal times, shared endpoints, coincident faces.
  kOnePoint,     ///< All at one point, some identical.
  kConvoy,       ///< All at one speed: parallel faces.
  kToOnePoint,   ///< All reach the origin at 1 s: many faces cross at one point.
  kScales,       ///< 1e−12 to 1e12, each by itself.
  kFarAway,      ///< A small scene 1e12 m from the origin.
  kGrazing,      ///< Moves along an axis, apart across it by the radii within a unit or two.
  kTwoClusters,  ///< 1e9 m apart.
  kOutliers,     ///< Uniform, but a few fill the world or leave it.
  kStill,        ///< Most never move.
};
inline constexpr int kLayouts = 11;

/// `count` agents, with radii, motions and M as the layout has them.
std::vector<motion::SpaceTimeBound> LayOut(SweepLayout layout, int count, Random* random);

/// Gives some of them stamps far apart, errors, steps, directions, expiries and masks, and a
/// window: of length zero, tiny, usual, long or (horns) without end.
SweepScene RandomScene(SweepLayout layout, intersection::BoundKind kind, int count, Random* random);

/// The first meeting, by EarliestIntersectionOf() of each pair in turn.
std::optional<intersection::IntersectingPair> PlainEarliest(const SweepScene& scene);

std::unique_ptr<FaceSweep> Filled(const SweepScene& scene);

}  // namespace collision::broad_phase
