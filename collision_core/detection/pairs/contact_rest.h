// How long a contact of two balls certainly goes on.
#pragma once

#include "collision_core/detection/agents/history.h"
#include "collision_core/detection/pairs/contact_tracker.h"

namespace collision::detection {

/// A pair in contact, as it was last evaluated.
struct RestingPair {
  const History::Sample& a;  ///< The newest states.
  const History::Sample& b;
  const ContactTracker& settled;
  const ContactTracker& preview;  ///< A copy that ran ahead to the end of the heard time.
};

/// Until when, at most now + `longest` seconds, no evaluation can change what is known about a
/// contact of two balls while neither agent has a new state. Always() if that is not certain.
///
/// With an uncertainty u >= 0 no freedom can be certified where the centres' distance |Δc| is at
/// most the sum r of the radii, and |Δc| is convex in time. So contact holds from the last
/// evaluated instant up to now if |Δc| < r at both ends, and from now on for as long as the
/// relative speed takes to use up r − |Δc|. With a known acceleration |Δc| is not convex, and
/// nothing is certain.
Instant ContactRestsUntil(const RestingPair& pair, Instant now, double longest);

}  // namespace collision::detection
