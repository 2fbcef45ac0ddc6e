// The difference of points, segments and boxes: few faces, each determined by two edges.
#pragma once

#include "collision_core/geometry/convex/gjk.h"

namespace collision::geometry {

/// Whether the core is a point, a segment or a box. The difference of two such cores is a zonotope:
/// d + Σ s_k g_k, |s_k| <= 1, over the up to six half edges g_k of both. Each of its faces has the
/// normal g_i × g_j of two half edges, so there are at most fifteen normals. The face nearest to 0
/// gives the depth, from below and from above, without a search. Two edges that are parallel but
/// for rounding, as those of boxes with equal orientations, have no reliable normal. One is taken
/// to be exactly parallel to the other, and the certified depth is reduced by what that moves.
/// Where an edge is parallel to more than one other, nothing is certified: neither a gap nor a
/// depth.
inline bool IsZonotope(const ConvexSet& set) {
  return set.IsThin() || set.core == ConvexCore::kBox;
}

/// The separation of two zonotopes along the normals of their difference's faces.
struct FaceSeparation {
  /// The computed gap [m] of the projections along the unit vector `direction` from A to B, off by
  /// at most GapError() of the pair; negative where the projections overlap.
  double gap = -numeric::kInfinity;
  Eigen::Vector3d direction{0, 0, 0};
  /// Like Overlap::inside: the ball of this radius about 0 certainly belongs to the difference.
  double inside = -numeric::kInfinity;
};

/// Tries the normals of all pairs of half edges; stops at the first gap wider than `apart` [m].
/// Requires IsZonotope() of both sets.
FaceSeparation SeparationOfFaces(const ConvexPair& pair, double apart);

}  // namespace collision::geometry
