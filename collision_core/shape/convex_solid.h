// Convex solids: ball, capsule, box, ellipsoid, cylinder, cone, hull of points.
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "collision_core/geometry/convex/convex_set.h"

namespace collision::shape {

/// A convex solid as its owner describes it: a core, rounded, and placed in the body frame B.
struct ConvexDescription {
  geometry::ConvexCore core = geometry::ConvexCore::kPoint;
  /// kSegment: half its length along z. kBox: half extents. kEllipsoid: semi-axes. kCylinder and
  /// kCone: the radius as x and as y, half the length along z; a cone's apex is at +z. [m]
  Eigen::Vector3d half{0, 0, 0};
  /// The points of a hull [m], in any order; inner points and duplicates are allowed.
  std::vector<Eigen::Vector3d> points;
  double rounding = 0;  ///< The radius of a ball or capsule; of a box its rounding [m].
  /// The orientation of its axes in B: the rotation q / |q|, for q of any length but zero.
  Eigen::Quaterniond q_BS{1, 0, 0, 0};
  Eigen::Vector3d p_BS{0, 0, 0};  ///< Its origin in B [m].
};

/// The most points of one hull; a larger body is better described as a mesh.
inline constexpr std::size_t kHullPointsMax = std::size_t{1} << 16;

/// Allowed diameters [m], as for meshes (kMeshSizeMin).
inline constexpr double kConvexSizeMin = 1e-6;
inline constexpr double kConvexSizeMax = 1e7;

/// The largest allowed magnitude of a coordinate of a point or a position [m].
inline constexpr double kConvexReachMax = 1e7;

/// Why a solid cannot be a part of an agent's shape, as a sentence with field, value and allowed
/// range. A triangle is described as a hull. nullopt: it can.
std::optional<std::string> RefusalOf(const ConvexDescription& description);

/// Certified facts of a solid; body frame, lengths in metres.
struct ConvexFacts {
  double radius = 0;                     ///< Radius of a ball about the origin that contains it.
  Eigen::Vector3d ball_centre{0, 0, 0};  ///< Centre of a small ball that contains it.
  double ball_radius = 0;
  Eigen::Vector3d lower{0, 0, 0}, upper{0, 0, 0};  ///< A box that contains it.
  /// The ball of radius `inradius` about `inner_point` belongs to the solid, so the signed distance
  /// there is at most −inradius. inradius = 0: no inner point is certain, or the solid has none.
  Eigen::Vector3d inner_point{0, 0, 0};
  double inradius = 0;
};

/// Immutable once built; copies share their points.
class ConvexSolid {
 public:
  /// Requires a description that passed RefusalOf(). Deterministic.
  static ConvexSolid Build(const ConvexDescription& description);

  /// The same without the limits of sizes and places, which are there for mistakes of owners:
  /// everything is certified beyond them too. Unchecked: the rest of RefusalOf().
  static ConvexSolid BuildOfAnySize(const ConvexDescription& description);

  /// This solid and all points within `more` of it: its rounding is the sum, rounded up. Requires
  /// `more` >= 0 and finite.
  ConvexSolid Grown(double more) const;

  /// In the body frame; valid while the solid, or a copy of it, lives.
  const geometry::ConvexSet& set() const { return set_; }
  const ConvexFacts& facts() const { return facts_; }
  /// Memory in use [bytes].
  std::size_t bytes() const { return sizeof(*this) + (points_ ? points_->bytes() : 0); }

 private:
  geometry::ConvexSet set_;
  std::shared_ptr<const geometry::ConvexPoints> points_;
  ConvexFacts facts_;
};

}  // namespace collision::shape
