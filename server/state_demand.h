// Which agents need a fresh state, and by when: what lets simulators send only those.
#pragma once

#include "collision_core/detection/detector.h"
#include "idl/config.pb.h"

namespace collision::server {

/// When the next state of an agent is wanted, given its clearance as of `now` and the stamp of its
/// newest state. Never(): none is. Not later than `now`: one at every step.
///
/// Silence breaks no promise: a bound holds until it is revoked. A state is wanted where it keeps
/// the answers as good as a stream would:
///  - clear beyond `announce_within`: just before the detector asks again, at clear_until −
///    announce_within; a meeting that fresh states exclude is then not announced;
///  - clear until C within it: half-way from the newest state to C. What the bounds have grown by
///    since that state is the square of its age, so each state quarters what hides the partner.
///    Earlier, just before the detector asks for others to be announced, unless the newest state is
///    still fresh then: stale bounds announce many whom nobody can meet so soon;
///  - a contact, or a doubt, is over, and the newest state is older than its end: at once, since what
///    is known from both sides narrows its brackets;
///  - clear for less than two temporal resolutions, in contact, saturated: at every step, so that
///    brackets in time are as narrow as those of a stream.
class StateDemand {
 public:
  explicit StateDemand(const v1::Config& config)
      : announce_within_(config.announce_within_s()),
        temporal_resolution_(config.temporal_resolution_s()) {}

  Instant WantedAt(const detection::AgentClearance& clearance, Instant stamp, Instant now) const;

 private:
  /// When the detector decides whether a meeting is announced.
  Instant Announcing(Instant meeting) const;

  double announce_within_;
  double temporal_resolution_;
};

}  // namespace collision::server
