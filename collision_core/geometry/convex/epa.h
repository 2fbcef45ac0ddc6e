// How deep two convex cores overlap (EPA): a polytope that grows inside their difference.
#pragma once

#include "collision_core/geometry/convex/gjk.h"

namespace collision::geometry {

/// The largest number of support points; without it a smooth difference would need ever more. When
/// they, or the polytope's faces (kEpaFacesMax), are used up, the bracket stays as wide as it is.
inline constexpr std::uint32_t kEpaStepsMax = 128;

/// When the growth may end: as soon as one of the conditions holds.
struct EpaGoal {
  /// Relative tolerance between the certain and the possible depth.
  double relative_tolerance = 0;
  double absolute_tolerance = 0;       ///< Absolute tolerance [m].
  double inside = numeric::kInfinity;  ///< Stop when they are known to overlap by this [m].
  std::uint32_t steps = kEpaStepsMax;
};

/// How deep two cores overlap.
struct Overlap {
  /// The ball of this radius [m] about 0 certainly belongs to the difference B − A of the cores,
  /// all rounding included: no shorter shift takes them apart. Below 0: nothing is certain.
  double inside = -numeric::kInfinity;
  /// The unit vector, from A to B, along which the cores overlap the least among those that were
  /// tried; zero: none was tried.
  Eigen::Vector3d direction{0, 0, 0};
  std::uint32_t steps = 0;
};

/// Grows a polytope of points of the difference B − A, where its surface is nearest to 0, until the
/// goal is reached. It starts from the last simplex of GJK, which need not contain 0; for smooth
/// cores it ends at 2^-40 of the pair's size or after kEpaStepsMax.
///
/// Why the ball certainly belongs to the difference: three facts are checked and not trusted to the
/// growth. The faces form a closed oriented surface made of points of the difference (to within
/// rounding); 0 lies on the inner side of each face (exact signs), so the surface winds about 0;
/// and no face comes nearer to 0 than the radius. So every ray from 0 meets the surface no nearer
/// than that, and the difference is convex. Whether the polytope itself is convex does not matter.
/// Source: van den Bergen, "Proximity queries and penetration depth computation on 3D game
/// objects", 2001.
Overlap RunEpa(const ConvexPair& pair, const GjkResult& start, const EpaGoal& goal);

/// A ball that certainly lies inside a core and is nearly the largest such ball. A radius of 0 or
/// less: no ball is certain.
struct InscribedBall {
  Eigen::Vector3d centre;  ///< In the set's frame.
  double radius;
};
/// Finds a large ball inside the core of one set.
InscribedBall LargeBallInside(const ConvexSet& set);

}  // namespace collision::geometry
