// What the owner of an agent declares about it.
#pragma once

#include <memory>

#include "collision_core/broad_phase/agent_bound.h"
#include "collision_core/broad_phase/half_space.h"
#include "collision_core/motion/motion_state.h"

namespace collision::shape {
class FixedHalfSpace;
class Shape;
}  // namespace collision::shape

namespace collision::detection {

/// The most half-spaces at a time.
inline constexpr std::size_t kHalfSpacesMax = broad_phase::HalfSpaces::kCountMax;

/// What an owner declares about an agent once, and what then holds from state to state. A change
/// that promises less (a larger radius or M, another shape, a filter that keeps
/// it apart from fewer) is a *widening*: the
/// detector queries the agent for all partners again.
struct AgentDeclaration {
  motion::MotionLimits limits{};
  broad_phase::CollisionFilter filter{};
  /// The agent counts as touching whatever comes within this of it [m], >= 0; of two agents the sum
  /// counts. `limits.radius` and `shape` contain it already (shape/grown_shape.h); events tell it.
  double margin = 0;
  /// The shape, within the ball of `limits.radius`; null: the ball itself.
  std::shared_ptr<const shape::Shape> shape = nullptr;
  /// The shape is not known yet: it lies somewhere within the ball. The ball then excludes contacts
  /// but confirms none. Requires that `shape` is null.
  bool shape_awaited = false;
  /// The body is this half-space, without end, which `margin` has grown already; null: it is not.
  /// It is the same in each declaration of the agent. Then there is no shape, the limits do not
  /// count, and of its states only stamp and expiry do.
  std::shared_ptr<const shape::FixedHalfSpace> half_space = nullptr;
};

}  // namespace collision::detection
