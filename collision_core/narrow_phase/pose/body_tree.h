// The sphere tree of one body as queries of pairs traverse it.
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

  const sphere_tree::SphereNode& node(std::uint32_t index) const {
    return shape_ ? shape_->tree().nodes[index] : ball_;
  }
  const shape::Shape* shape() const { return shape_; }  ///< Null: a ball.
  double reach() const { return reach_; }  ///< Of its points about the reference point [m].
  double turning_reach() const { return shape_ ? reach_ : 0; }

 private:
  const shape::Shape* shape_;
  sphere_tree::SphereNode ball_;
  double reach_;
};

}  // namespace collision::narrow_phase
