// The narrow phase of a pair over a whole interval of time.
#pragma once

#include "collision_core/base/work_budget.h"
#include "collision_core/detection/contact_tracker.h"
#include "collision_core/detection/history.h"

namespace collision::detection {

/// How many segments of time were judged.
struct Judged {
  std::uint64_t segments = 0;
  std::uint64_t at_a_glance = 0;  ///< Of these: a glance showed that two balls touch throughout.
};

/// Judges everything from tracker->at() to `until`, stamp by stamp, with whatever the two histories
/// know, and shapes as closely as the work allows.
Judged Judge(const History& a, const History& b, Instant until, WorkBudget* work,
             ContactTracker* tracker);

/// Whether either is more than a ball from `from` on.
bool HaveShapes(const History& a, const History& b);

/// From `from` on, at or after both newest states: up to when the shapes are apart for all motions
/// within the newest bounds, `until` at most; `from` if they may touch at once.
Instant ShapesFreeAhead(const History& a, const History& b, Instant from, Instant until,
                        WorkBudget* work);

/// The two at one instant; what the event says of point, normal and depth.
narrow_phase::Proximity ProximityOf(const History& a, const History& b, Instant at,
                                    WorkBudget* work);

}  // namespace collision::detection
