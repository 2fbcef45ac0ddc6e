// A floor or a wall without end, as the body of an agent.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "collision_core/shape/shape.h"

namespace collision::shape {

/// How far the length of a half-space's normal may be from 1.
inline constexpr double kNormalLengthTolerance = 1e-6;

/// The greatest allowed distance of its plane from the origin [m].
inline constexpr double kHalfSpaceOffsetMax = 1e15;

/// Why a half-space cannot be the body of an agent, as a sentence with field, value and allowed
/// range. nullopt: it can.
std::optional<std::string> RefusalOfHalfSpace(const Eigen::Vector3d& normal, double offset);

/// All x with normal·x <= offset, in the world frame; the numbers are taken as exact. It never
/// moves. Immutable; shared between agents and threads.
///
/// The narrow phase knows finite bodies only. To anything within a ball the half-space looks like a
/// large block just below, so such a block stands in for it.
class FixedHalfSpace {
 public:
  /// Without blocks. Requires that RefusalOfHalfSpace() is nullopt.
  static std::shared_ptr<const FixedHalfSpace> Build(const Eigen::Vector3d& normal, double offset);

  /// This half-space with the blocks of all sizes, which takes about 1 ms to make them.
  std::shared_ptr<const FixedHalfSpace> WithBlocks() const;

  /// This half-space and all points within `more` [m] of it; its offset is rounded up. Its
  /// blocks are the same. Requires `more` >= 0.
  std::shared_ptr<const FixedHalfSpace> Grown(double more) const;

  const Eigen::Vector3d& normal() const { return normal_; }
  double offset() const { return offset_; }

  /// The same points.
  bool IsSameAs(const FixedHalfSpace& other) const {
    return normal_ == other.normal_ && offset_ == other.offset_;
  }

  /// A block in place of the half-space. It is not turned: its axes are those of the world.
  struct StandIn {
    std::shared_ptr<const Shape> shape;
    Eigen::Vector3d position;  ///< Of the block's origin, in the middle of its upper face.
    double error;              ///< How far its upper face is from the plane at most [m].
    double tilt;  ///< How far its upper face is turned against the plane at most [rad].
  };

  /// The block for a body within `reach` [m] of `centre`. The body's signed distance to the block,
  /// positive or negative, differs from that to the half-space by at most `error`. nullopt: the
  /// body is larger, or deeper below the plane, than any block. Requires WithBlocks().
  ///
  /// Derivation. Let ρ be the reach, and the centre's depth more where it lies below the plane; the
  /// block has half the width L >= 4 ρ and the depth 2 L. A body's depth is at most ρ. The nearest
  /// point of the plane to a point of the body is at most ρ aside, on the upper face. A
  /// displacement that takes the body out of the block, and is shorter than its depth, leaves its
  /// deepest point at most 2 ρ aside, below the upper face and above the lower one: in the block.
  /// So only the upper face counts, which lies within `error` of the plane: its corners do, in
  /// intervals.
  std::optional<StandIn> Around(const Eigen::Vector3d& centre, double reach) const;

 private:
  struct Block {
    double half_width;
    std::shared_ptr<const Shape> shape;
    /// The heights of the upper face above a plane through its origin lie in here [m].
    numeric::Interval heights;
    double tilt;
  };

  using Blocks = std::vector<Block>;  // by ascending size

  FixedHalfSpace(const Eigen::Vector3d& normal, double offset, std::shared_ptr<const Blocks> blocks)
      : normal_(normal), offset_(offset), blocks_(std::move(blocks)) {}
  Block BlockOf(double half_width) const;
  numeric::Interval HeightAbove(double offset, const Eigen::Vector3d& point) const;

  Eigen::Vector3d normal_;
  double offset_;
  std::shared_ptr<const Blocks> blocks_;  // null: not made
};

}  // namespace collision::shape
