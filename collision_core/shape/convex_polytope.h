// How deep two convex cores overlap: a polytope that grows inside their difference.
#pragma once

#include "collision_core/shape/convex_search.h"

namespace collision {

/// Faces of the polytope and support points asked for, at most: a smooth difference would need ever
/// more. Where they are used up the bracket stays as wide as it is.
inline constexpr int kPolytopeFacesMax = 256;
inline constexpr std::uint32_t kPolytopeStepsMax = 128;

struct PolytopeGoal {
  double share = 0;           ///< Certain and possible depth may differ by so little, relative,
  double width = 0;           ///< or by so little [m].
  double inside = kInfinity;  ///< It is enough to know that they overlap by this.
  std::uint32_t steps = kPolytopeStepsMax;
};

struct Overlap {
  /// The ball of this radius about 0 certainly belongs to the difference B − A of the cores, all
  /// rounding counted in: no shift by less takes them apart. Below 0: nothing is certain.
  double inside = -kInfinity;
  /// A unit vector along which, from A to B, the cores overlap least of all that were tried; zero:
  /// none was.
  Eigen::Vector3d direction{0, 0, 0};
  std::uint32_t steps = 0;
};

/// Starts from the simplex that a search ended with, wherever that lies.
///
/// After van den Bergen, "Proximity queries and penetration depth computation on 3D game objects",
/// 2001. Why the ball certainly is inside: the faces form a closed oriented surface made of points
/// of the difference (to within rounding), all faces are seen from 0 from within (exact signs), so
/// it winds about 0 at least once; and no face comes nearer to 0 than the radius. So every ray from
/// 0 meets the surface, no nearer than that; the difference is convex.
Overlap OverlapOf(const ConvexPair& pair, const SearchResult& start, const PolytopeGoal& goal);

/// A ball inside a core, near the largest one; radius 0 or less where none is certain.
struct InscribedBall {
  Eigen::Vector3d centre;  ///< In the set's frame.
  double radius;
};
InscribedBall LargeBallInside(const ConvexSet& set);

}  // namespace collision
