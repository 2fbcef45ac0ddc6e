// The narrow phase of a pair over a whole interval of time.
#pragma once

#include "collision_core/base/work_budget.h"
#include "collision_core/detection/agents/history.h"
#include "collision_core/detection/pairs/contact_tracker.h"

namespace collision::detection {

/// How many segments an evaluation took.
struct SegmentCount {
  std::uint64_t segments = 0;
  std::uint64_t quick = 0;  ///< Of these, decided by QuickBallContact() for two balls.
};

/// Evaluates everything from tracker->at() to `until`, segment by segment between the cuts of the
/// two histories, with all bounds that hold there. Shapes are evaluated as closely as the work
/// allows; balls cost one unit a segment. Where a shape is awaited, its ball excludes a contact but
/// confirms none. What is left when the work is exhausted becomes undecided at once, or gets one
/// query a segment (WhenExhausted).
SegmentCount EvaluateSegments(const History& a, const History& b, Instant until, WorkBudget* work,
                              ContactTracker* tracker);

/// Whether the shape of either newest state is known, or it is a half-space; an awaited shape does
/// not count.
bool HaveKnownShapes(const History& a, const History& b);

/// Up to when, at most `until`, the shapes are certified apart for all motions within the newest
/// bounds; `from` if they may touch at once. Requires `from` at or after both newest states.
Instant ShapesFreeAhead(const History& a, const History& b, Instant from, Instant until,
                        WorkBudget* work);

}  // namespace collision::detection
