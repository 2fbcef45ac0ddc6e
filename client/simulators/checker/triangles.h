// Two triangles, a point, two segments: how far apart, and how firmly they cross.
#pragma once

#include <array>

#include "client/simulators/checker/vector.h"

namespace collision::checker {

using Triangle = std::array<Vector, 3>;

/// The squared distance of two segments, p to q and r to s; degenerate ones are points.
double SquaredDistance(const Vector& p, const Vector& q, const Vector& r, const Vector& s);

/// The point of the triangle nearest to `point`.
Vector NearestPoint(const Vector& point, const Triangle& triangle);

/// The distance of two triangles, 0 if they cross. In doubles: exact to about 1e-15 of the
/// coordinates' size.
double Distance(const Triangle& a, const Triangle& b);

/// How far both may be moved against each other, every point by at most so much, before they might
/// no longer cross; 0 if they do not cross. An edge that passes through a triangle goes on doing so
/// until one of its ends comes to the triangle or the edge to the triangle's rim: the margin is the
/// least of those five distances, and of the edges that pass through the best one counts.
double CrossingMargin(const Triangle& a, const Triangle& b);

}  // namespace collision::checker
