// The closest approach of a pair, followed while its event is announced.
#pragma once

#include <cstdint>

#include "collision_core/detection/agents/history.h"
#include "collision_core/detection/events/announcer.h"

namespace collision::detection {

/// How far the closest approach of a pair is followed.
struct FollowLimits {
  Instant until;  ///< What is known up to here is final.
  /// The two may still come nearer: the segment that ends at `until` is left for the next time, by
  /// when it mostly has turned out not to matter.
  bool approaching = false;
  std::uint64_t shape_units = 0;  ///< For shapes, about.
};

/// Continues `published->closest` from `followed_until` to `limits.until`, segment by segment
/// between the cuts of the two histories, and sets `followed_until`. Where nothing is known, after
/// a broken bound, it begins anew. Shapes in contact are not searched: the contact's brackets say
/// when they are nearest. Returns the work units that it took.
std::uint64_t FollowClosest(const History& a, const History& b, const FollowLimits& limits,
                            PublishedEvent* published);

}  // namespace collision::detection
