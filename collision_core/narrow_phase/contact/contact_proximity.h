// What an event reports of one instant, from the separation query at that instant.
#pragma once

#include "collision_core/narrow_phase/contact/contact_normal.h"
#include "collision_core/narrow_phase/contact/shape_motion.h"
#include "collision_core/narrow_phase/pose/proximity.h"

namespace collision::narrow_phase {

/// The direction of the shortest way between the surfaces, from a query with Goal::kNearest. The
/// error covers all ways that may be the shortest one and what the uncertainty of the pose can turn
/// them by (derived at DeviationOf() in the source). Not known if the query found no way.
ContactNormal NormalOf(const ShapeMotion::PoseQuery& query);

/// Distance, depth and point at the instant of `query`, which `motion` answered and of which
/// CheckContainment() was called; the normal is a guess along the centres, with an error of π.
/// `size`: the sum of the radii of both bodies' balls [m].
Proximity ProximityFrom(const ShapeMotion::PoseQuery& query, const ShapeMotion& motion,
                        double size);

}  // namespace collision::narrow_phase
