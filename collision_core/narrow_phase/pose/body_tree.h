// One body as queries of pairs traverse it: its sphere tree, or a single ball.
#pragma once

#include "collision_core/narrow_phase/pose/body_segment.h"

namespace collision::narrow_phase {

/// A body as a traversal sees it: the nodes of its tree, or one node for a ball.
class BodyTree {
 public:
  explicit BodyTree(const BodySegment& body)
      : shape_(body.shape.get()), reach_(shape_ ? shape_->facts().radius : body.ball.radius) {
    ball_.radius = body.ball.radius;
    ball_.signed_distance = -body.ball.radius;
  }

  /// A node of the shape's tree; of a ball, the ball whatever the index.
  const sphere_tree::SphereNode& node(NodeIndex index) const {
    return shape_ ? shape_->tree().node(index) : ball_;
  }
  const sphere_tree::SphereNode& root() const { return node(sphere_tree::SphereTree::kRoot); }
  const shape::Shape* shape() const { return shape_; }  ///< Null: a ball.
  /// No point of the body is farther from the reference point [m].
  double reach() const { return reach_; }
  /// No point that turning moves is farther from the reference point [m]; 0 for a ball.
  double turning_reach() const { return shape_ ? reach_ : 0; }

 private:
  const shape::Shape* shape_;
  sphere_tree::SphereNode ball_;
  double reach_;
};

}  // namespace collision::narrow_phase
