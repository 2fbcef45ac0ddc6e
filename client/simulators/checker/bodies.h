// Two bodies in a given position: how far apart, whether in contact, how firmly.
#pragma once

#include <vector>

#include "client/simulators/checker/solid.h"
#include "client/simulators/checker/surfaces.h"

namespace collision::checker {

/// A solid ball; or the solid (closed mesh) or surface (open mesh) of triangles, convex solids, or
/// both: all of it together.
struct Body {
  const Mesh* mesh = nullptr;
  double radius_m = 0;                         ///< Of the ball, where there is nothing else.
  const std::vector<Solid>* solids = nullptr;  ///< Null: none.

  bool IsBall() const { return mesh == nullptr && (solids == nullptr || solids->empty()); }

  /// What it reaches about its reference point [m].
  double reach() const;
};

/// Contact, and how far the two may be moved against each other, every point by at most so much,
/// before that might change [m].
struct Standing {
  bool contact = false;
  double margin = 0;
};

/// In contact when the two share a point: their surfaces do, or a part of one lies in the solid of
/// the other. `outside`: it is known that, with the surfaces apart, no part does.
Standing StandingOf(const Body& a, const Body& b, const Pose& pose, Hint* hint,
                    bool outside = false);

/// Contact alone, which is less work.
bool InContact(const Body& a, const Body& b, const Pose& pose, Hint* hint);

/// Are they in contact, and remain so when one of them is moved by `depth` in any of 26 directions?
/// About: is it a contact at least so deep? Directions at most 30 degrees from any other.
bool InContactThrough(const Body& a, const Body& b, const Pose& pose, double depth, Hint* hint);

/// The distance; 0 in contact.
double DistanceOf(const Body& a, const Body& b, const Pose& pose);

/// The distance of a point, in the body's axes; 0 inside a solid.
double DistanceTo(const Body& body, const Vector& point);

/// Moving one of them this far along some direction certainly parts them [m]: the least overlap of
/// their extents along the bodies' axes, the line of centres and `along` (in the axes of A).
double DepthAtMost(const Body& a, const Body& b, const Pose& pose, const Vector& along);

}  // namespace collision::checker
