// Two bodies in a given position: their distance, whether they are in contact, and how firmly.
#pragma once

#include <vector>

#include "client/checker/shape/solid.h"
#include "client/checker/shape/surfaces.h"

namespace collision::checker {

/// All points x with normal·x <= offset_m, in the world's axes. It never moves.
struct HalfSpace {
  Vector normal{0, 0, 1};  ///< Of length 1.
  double offset_m = 0;
};

/// A half-space; a solid ball; or the union of a mesh (a solid if it is closed, else a surface) and
/// convex solids.
struct Body {
  const Mesh* mesh = nullptr;
  double radius_m = 0;                         ///< Of the ball, without mesh and solids.
  const std::vector<Solid>* solids = nullptr;  ///< Null: none.
  double grown_m = 0;                          ///< Whatever is this near to it is part of it, too.
  const HalfSpace* half_space = nullptr;       ///< Null: none.

  bool HasShape() const { return mesh != nullptr || (solids != nullptr && !solids->empty()); }
  bool IsBall() const { return !HasShape() && half_space == nullptr; }

  /// Largest distance of its points from the reference point [m]; of a half-space 0, since that
  /// never turns.
  double reach() const;
};

/// Whether two bodies are in contact, and the margin: relative motions that move every point by at
/// most this much [m] do not change it.
struct Standing {
  bool contact = false;
  double margin = 0;
};

/// Two bodies, at most one of which is a half-space, are in contact when they share a point: their
/// surfaces do, or a part of one lies inside the other. `outside`: with the surfaces apart, no part
/// is known to lie inside.
Standing StandingOf(const Body& a, const Body& b, const Pose& pose, Hint* hint,
                    bool outside = false);

/// Contact without the margin, which is less work.
bool InContact(const Body& a, const Body& b, const Pose& pose, Hint* hint);

/// Whether they are in contact and stay so when one of them is moved by `depth` in any of 26
/// directions, which are within 30 degrees of any direction. That is about whether the penetration
/// depth is at least `depth`.
bool InContactThrough(const Body& a, const Body& b, const Pose& pose, double depth, Hint* hint);

/// The distance; 0 in contact.
double DistanceOf(const Body& a, const Body& b, const Pose& pose);

/// The distance of a point in body axes; 0 inside a solid.
double DistanceTo(const Body& body, const Vector& point);

/// An upper bound of the penetration depth [m]: the least overlap of their extents along the
/// bodies' axes, the line of centres and `along` (in the axes of A).
double DepthAtMost(const Body& a, const Body& b, const Pose& pose, const Vector& along);

}  // namespace collision::checker
