// Convex solids: ball, capsule, box, ellipsoid, hull of points; and the half-space.
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "collision_core/shape/convex_set.h"

namespace collision {

/// A convex solid as its owner describes it: a core, rounded, and placed in the body frame B.
struct ConvexDescription {
  ConvexCore core = ConvexCore::kPoint;
  /// kSegment: half its length along z. kBox: half extents. kEllipsoid: semi-axes. [m]
  Eigen::Vector3d half{0, 0, 0};
  std::vector<Eigen::Vector3d>
      points;           ///< Of a hull, in any order, inner ones and doubles too [m].
  double rounding = 0;  ///< The radius of a ball or capsule; of a box its rounding [m].
  Eigen::Quaterniond q_BS{1, 0, 0,
                          0};     ///< Its axes in B; any length but zero: the rotation q / |q|.
  Eigen::Vector3d p_BS{0, 0, 0};  ///< Its origin in B [m].
};

/// Points of one hull at most: more make a mesh.
inline constexpr std::size_t kHullPointsMax = std::size_t{1} << 16;

/// Of the diameter [m]; like those of meshes: smaller is a point, larger a planet.
inline constexpr double kConvexSizeMin = 1e-6;
inline constexpr double kConvexSizeMax = 1e7;

/// No part of the description may be farther from the reference point [m].
inline constexpr double kConvexReachMax = 1e7;

/// Why it cannot be (part of) an agent's shape, as a sentence with field, value and allowed range.
/// A triangle is described as a hull. nullopt: it can.
std::optional<std::string> RefusalOf(const ConvexDescription& description);

/// What is certain of a solid; body frame, lengths in metres.
struct ConvexFacts {
  double radius = 0;                     ///< Of a ball about the origin around it.
  Eigen::Vector3d ball_centre{0, 0, 0};  ///< Of a small ball around it.
  double ball_radius = 0;
  Eigen::Vector3d lower{0, 0, 0}, upper{0, 0, 0};  ///< Of a box around it.
  /// The ball of that radius about this point belongs to the solid: its signed distance there is
  /// −inradius or less. 0: nothing is certain to be inside, or nothing is.
  Eigen::Vector3d inner_point{0, 0, 0};
  double inradius = 0;
};

/// Immutable once built; copies share their points.
class ConvexSolid {
 public:
  /// Requires a description that passed RefusalOf(). Deterministic.
  static ConvexSolid Build(const ConvexDescription& description);

  /// In the body frame; valid while the solid, or a copy of it, lives.
  const ConvexSet& set() const { return set_; }
  const ConvexFacts& facts() const { return facts_; }
  /// What it keeps in memory.
  std::size_t bytes() const { return sizeof(*this) + (points_ ? points_->bytes() : 0); }

 private:
  ConvexSet set_;
  std::shared_ptr<const ConvexPoints> points_;
  ConvexFacts facts_;
};

/// All points x with n·(x − p) <= 0, in the body frame. Unbounded, so that only an agent that does
/// not move can be one, or only for as long as nothing far away counts. (The HalfSpace of
/// broad_phase/ is fixed in the world.)
struct ConvexHalfSpace {
  Eigen::Vector3d normal{0, 0, 1};  ///< n, of any length but zero.
  Eigen::Vector3d point{0, 0, 0};   ///< p, on its boundary [m].
};

/// Allowed lengths of a half-space's normal: beyond, squares lose digits.
inline constexpr double kNormalLengthMin = 1e-100;
inline constexpr double kNormalLengthMax = 1e100;

std::optional<std::string> RefusalOf(const ConvexHalfSpace& half_space);

}  // namespace collision
