// Two convex solids at a pose: the questions that are asked most, each from the sets as their bodies
// have them to the certified answer.
#pragma once

#include "collision_core/narrow_phase/convex_distance.h"
#include "collision_core/narrow_phase/separation.h"

namespace collision {

/// Units of work for what is told at once, and for a quick search: some three to eight steps.
inline constexpr std::uint64_t kGlanceUnits = 1;
inline constexpr std::uint64_t kQuickSearchUnits = 8;

/// Whether they touch. All uncertainty of the pose is counted in, that of translation too.
Verdict DecideSolids(const ConvexSet& of_A, const ConvexSet& of_B, const RelativePose& pose,
                     Work* work);

/// ConvexSeparation::separation and nothing else; translation is not counted in. With
/// ConvexGoal::kDistance the lower end says nothing where they overlap.
Interval SeparationOfSolids(const ConvexSet& of_A, const ConvexSet& of_B, const RelativePose& pose,
                            const ConvexQuestion& question, Work* work);

}  // namespace collision
