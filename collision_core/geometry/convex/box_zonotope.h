// Points, segments and boxes: what overlaps has few faces, each known from two edges.
#pragma once

#include "collision_core/geometry/convex/gjk.h"

namespace collision::geometry {

/// Whether the core is a point, a segment or a box. The difference of two such cores is d + Σ s_k
/// g_k, |s_k| <= 1, over the up to six half edges g_k of both: a zonotope, each of whose faces has
/// the normal g_i × g_j of two of them, fifteen at most. The least of the gaps along them is the
/// depth, from both sides, without a search. Edges that are parallel but for rounding have no
/// normal that can be trusted: then nothing is claimed, and the polytope (epa.h)
/// answers.
inline bool IsZonotope(const ConvexSet& set) {
  return set.IsThin() || set.core == ConvexCore::kBox;
}

/// The separation of two boxes along the faces of their difference, from both sides.
struct FaceSeparation {
  /// Along the unit vector `direction` from A to B the shadows are this far apart, computed: to
  /// within GapError() of the pair.
  double gap = -numeric::kInfinity;
  Eigen::Vector3d direction{0, 0, 0};
  /// Like Overlap::inside: the ball of this radius about 0 certainly belongs to the difference.
  double inside = -numeric::kInfinity;
};

/// Over all pairs of half edges, or until a gap wider than `apart` is found. Requires two
/// zonotopes.
FaceSeparation SeparationOfFaces(const ConvexPair& pair, double apart);

}  // namespace collision::geometry
