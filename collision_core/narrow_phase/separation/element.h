// An element of a body, that is a triangle or a convex solid, as a convex set.
#pragma once

#include "collision_core/narrow_phase/pose/body_tree.h"
#include "collision_core/narrow_phase/pose/boxed_triangle.h"
#include "collision_core/narrow_phase/pose/convex_pose.h"
#include "collision_core/narrow_phase/pose/pair_parts.h"

namespace collision::narrow_phase {

/// An element as a convex set, in its own body frame; for a body that is a ball, the ball.
inline geometry::ConvexSet SetOf(const BodyTree& body, ElementIndex element) {
  const shape::Shape* shape = body.shape();
  if (shape == nullptr) return geometry::BallSet(Eigen::Vector3d::Zero(), body.reach());
  if (shape->IsSolid(element)) return shape->SolidAt(element).set();
  return geometry::TriangleSet(CornersOf(*shape, element));
}

/// Whether one of the two elements is a convex solid, or both bodies are balls: then the routines
/// for triangles do not apply.
inline bool AnySolid(const BodyTree& a, const BodyTree& b, ElementPair pair) {
  if (!a.shape() && !b.shape()) return true;
  return (a.shape() && a.shape()->IsSolid(pair.a)) || (b.shape() && b.shape()->IsSolid(pair.b));
}

}  // namespace collision::narrow_phase
