// When a standby knows all that the service beside it has not told yet.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>

#include "collision_core/base/instant.h"
#include "idl/messages.pb.h"

namespace collision::server {

/// A standby that joins a world gets the newest state of each agent, and from then on all of them.
/// What happened before only the service in force can tell. So a standby is ready once it has as
/// many agents as that service, and that service has decided everything up to the newest time that
/// was known here by then: whatever it has not told lies later. Bookkeeping only; one thread.
class StandbyReadiness {
 public:
  /// A status of the service in force has arrived. `agents`: that this one knows; `newest`: the
  /// latest time of which this one knows. True: it is ready from now on.
  bool Hear(const v1::ServiceHeard& heard, std::size_t agents, Instant newest) {
    if (ready_) return false;
    if (!complete_from_ && agents >= heard.agents()) complete_from_ = newest;
    ready_ = complete_from_ && Instant::FromNanoseconds(heard.now_ns()) >= *complete_from_;
    return ready_;
  }

  bool ready() const { return ready_; }

 private:
  std::optional<Instant> complete_from_;
  bool ready_ = false;
};

}  // namespace collision::server
