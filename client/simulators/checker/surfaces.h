// Two surfaces of triangles in a given position: how near, how firmly crossing, one in the other.
#pragma once

#include "client/simulators/checker/mesh.h"

namespace collision::checker {

/// Surfaces this near are in contact [m]: rounding alone makes a distance of 0 about 1e-15.
inline constexpr double kTouching = 1e-12;

/// Where to begin: the triangles that were nearest, or crossed, last time.
struct Hint {
  std::uint32_t a = 0;
  std::uint32_t b = 0;
};

/// The distance of the surfaces where it is less than `limit`, else `limit`; any distance up to
/// kTouching may stand for all of them.
double SurfaceDistance(const Mesh& a, const Mesh& b, const Pose& pose, double limit, Hint* hint);

/// The firmest crossing of the two surfaces (CrossingMargin); 0 if they do not cross.
double BestCrossing(const Mesh& a, const Mesh& b, const Pose& pose);

/// The distance of a point, in the mesh's axes, to the surface.
double SurfaceDistance(const Mesh& mesh, const Vector& point);

/// Does a part of one lie in the other? Decided by any of its points, while the surfaces are apart.
bool Contained(const Mesh& a, const Mesh& b, const Pose& pose);

}  // namespace collision::checker
