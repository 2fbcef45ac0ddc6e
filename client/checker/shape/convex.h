// Two convex sets in a given position, by their support functions.
#pragma once

#include <variant>

#include "client/checker/shape/mesh.h"
#include "client/checker/shape/round_core.h"

namespace collision::checker {

/// A point; the convex hull of a mesh's vertices or of a triangle; or a core with a curved surface.
using ConvexSet = std::variant<Vector, const Mesh*, Triangle, const RoundCore*>;

/// The distance [m] of the two, B placed by `pose` in the frame of A; not positive where they touch
/// or overlap: then 0, or with `depth` minus a distance by which they can be moved against each
/// other in any direction and still touch: a quarter of the greatest such distance at least, or 0
/// below a nanometre.
///
/// Where they are apart the result is a lower bound that is exact up to about 1e-13 of their size.
///
/// Method. The nearest point of the set A − B to the origin, as the nearest of simplices of its
/// points that come ever nearer (Gilbert, Johnson and Keerthi, "A fast procedure for computing the
/// distance between complex objects", 1988): with v the nearest so far and w the point of A − B
/// least along v, the distance lies between v·w / |v| and |v|. The depth: the displacements that
/// keep the two in touch are a convex set, so with ±d along three axes it contains a ball of
/// radius d / √3; d is halved until they do.
double ConvexGap(const ConvexSet& a, const ConvexSet& b, const Pose& pose, bool depth);

/// The same of the surface of a mesh, convex or not, and of a core placed by `pose` in the mesh's
/// axes; also negative where the mesh is closed and contains the core: minus their distance.
/// `outside`: the core is not inside.
double SurfaceGap(const Mesh& mesh, const RoundCore& core, const Pose& pose, bool outside,
                  bool depth);

}  // namespace collision::checker
