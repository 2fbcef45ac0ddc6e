// Two surfaces of triangles in a given position: distance, firmness of crossing, containment.
#pragma once

#include <cstdint>
#include <vector>

#include "client/checker/shape/mesh.h"

namespace collision::checker {

/// Surfaces this near are in contact [m]: rounding alone makes a distance of 0 about 1e-15.
inline constexpr double kTouching = 1e-12;

/// Where to begin: the triangles that were nearest, or crossed, in the last call.
struct Hint {
  std::uint32_t a = 0;
  std::uint32_t b = 0;
};

/// The distance of the surfaces if it is less than `limit`, else `limit`. A distance up to
/// kTouching may be any other value up to kTouching.
double SurfaceDistance(const Mesh& a, const Mesh& b, const Pose& pose, double limit, Hint* hint);

/// The firmest crossing of the two surfaces (CrossingMargin); 0 if they do not cross.
double BestCrossing(const Mesh& a, const Mesh& b, const Pose& pose);

/// The distance of a point in the mesh's axes to the surface.
double SurfaceDistance(const Mesh& mesh, const Vector& point);

/// Triangles of which some point may be within `reach` of the point, and all of which one is.
std::vector<std::uint32_t> TrianglesNear(const Mesh& mesh, const Vector& point, double reach);

/// The least d·x of all points x of the surface.
double LeastAlong(const Mesh& mesh, const Vector& d);

/// Whether a part of one lies inside the other. Requires that the surfaces are apart, so any point
/// of a part decides.
bool Contained(const Mesh& a, const Mesh& b, const Pose& pose);

}  // namespace collision::checker
