// The closest approach of a pair, followed while its event is announced.
#pragma once

#include <cstdint>

#include "collision_core/detection/agents/history.h"
#include "collision_core/detection/events/announcer.h"

namespace collision::detection {

/// Continues `published->closest` from `followed_until` to `until`, segment by segment between the
/// cuts of the two histories, and sets `followed_until`. What is settled there is final. Where
/// nothing is known, after a broken bound, it begins anew. Shapes in contact are not searched: the
/// contact's brackets say when they are nearest. Spends at most about `allowed` on shapes.
/// Returns the work units that it took.
std::uint64_t FollowClosest(const History& a, const History& b, Instant until,
                            std::uint64_t allowed, PublishedEvent* published);

}  // namespace collision::detection
