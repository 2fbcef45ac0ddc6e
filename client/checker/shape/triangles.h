// Distances of triangles, points and segments, and how firmly two triangles cross.
#pragma once

#include <array>

#include "client/checker/shape/vector.h"

namespace collision::checker {

using Triangle = std::array<Vector, 3>;

/// The squared distance of two segments, p to q and r to s; degenerate ones are points.
double SquaredDistance(const Vector& p, const Vector& q, const Vector& r, const Vector& s);

/// The point of the triangle nearest to `point`.
Vector NearestPoint(const Vector& point, const Triangle& triangle);

/// The distance of two triangles, 0 if they cross. In doubles: exact to about 1e-15 of the
/// coordinates' size.
double Distance(const Triangle& a, const Triangle& b);

/// The two triangles cross as long as no point of one moves by more than this against the other; 0
/// if they do not cross. An edge that passes through a triangle does so until one of its ends
/// reaches the triangle, or the edge reaches the triangle's rim: its margin is the least of those
/// five distances. The result is the greatest margin of all edges that pass through.
double CrossingMargin(const Triangle& a, const Triangle& b);

}  // namespace collision::checker
