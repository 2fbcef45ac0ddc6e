// Which agents need a fresh state, and by when, so that simulators send only those.
#pragma once

#include "collision_core/detection/detector.h"
#include "idl/config.pb.h"

namespace collision::server {

/// When the next state of an agent is wanted, given its clearance as of `now` and the stamp of its
/// newest state. Never(): none is. Not later than `now`: one at every step.
///
/// A missing state breaks no promise: a bound holds until it is revoked. A state is wanted where it
/// keeps the answers as sharp as a stream of states would:
///  - clear beyond `announce_within`: just before the detector evaluates the agent again, at
///    clear_until − announce_within, unless the newest state is still fresh then; an intersection
///    that fresh states exclude is not announced;
///  - clear until C within it: half-way from the newest state to C. The bounds have grown with the
///    square of that state's age, so each state leaves a quarter of that growth. Earlier, just
///    before the detector announces further partners, unless the newest state is still fresh then:
///    stale bounds announce many partners that cannot be met so soon;
///  - a contact or an undecided pair has ended, and the newest state is older than its end: at
///    once, since states from both sides of it narrow its brackets;
///  - clear for less than two temporal resolutions, in contact, or saturated: at every step, so
///    that brackets in time are as narrow as those of a stream.
class StateDemand {
 public:
  /// `announce_within` [s]: of the detector that gives the clearances.
  StateDemand(const v1::Config& config, double announce_within)
      : announce_within_(announce_within), temporal_resolution_(config.temporal_resolution_s()) {}

  Instant WantedAt(const detection::AgentClearance& clearance, Instant stamp, Instant now) const;

 private:
  /// When the detector decides whether an intersection at that instant is announced.
  Instant AnnouncedAt(Instant intersection) const;

  double announce_within_;
  double temporal_resolution_;
};

}  // namespace collision::server
