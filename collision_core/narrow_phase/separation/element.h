// An element of a body, triangle or convex solid, as a convex set.
#pragma once

#include "collision_core/narrow_phase/pose/body_tree.h"
#include "collision_core/narrow_phase/pose/boxed_triangle.h"
#include "collision_core/narrow_phase/pose/convex_pose.h"

namespace collision::narrow_phase {

/// In its own body frame; of an agent that is a ball, the ball.
inline geometry::ConvexSet SetOf(const BodyTree& surface, std::uint32_t element) {
  const shape::Shape* shape = surface.shape();
  if (shape == nullptr) return geometry::BallSet(Eigen::Vector3d::Zero(), surface.reach());
  if (shape->IsSolid(element)) return shape->SolidAt(element).set();
  return geometry::TriangleSet(CornersOf(*shape, element));
}

/// Whether one of the two elements is a convex solid, or both bodies are balls: then the routines
/// for triangles do not apply.
inline bool AnySolid(const BodyTree& a, std::uint32_t of_a, const BodyTree& b, std::uint32_t of_b) {
  if (!a.shape() && !b.shape()) return true;
  return (a.shape() && a.shape()->IsSolid(of_a)) || (b.shape() && b.shape()->IsSolid(of_b));
}

}  // namespace collision::narrow_phase
