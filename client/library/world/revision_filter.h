// Which samples of the service are new, and which are outdated.
#pragma once

#include <cstdint>
#include <unordered_map>

#include "idl/messages.pb.h"

namespace collision::client {

/// Drops samples of former services and revisions of events that were seen before.
///
/// A standby takes over with a higher term; samples of a lower term are void. A restarted service
/// begins its sequences anew. Within a term the network keeps the order of each writer, so a
/// sequence that falls back belongs to a new incarnation of the service, not to an old sample.
class RevisionFilter {
 public:
  /// False: the sample belongs to a term that is over.
  bool IsCurrent(const v1::ServiceStamp& stamp);

  /// False: this revision of the contact, or a later one, has been seen. A new incarnation counts
  /// revisions anew; only its repetition of the known revision is not new.
  bool IsNew(const v1::CollisionEvent& event);

 private:
  std::uint32_t term_ = 0;
  /// By pair slot, the topic's key: the service bounds their number.
  std::unordered_map<std::uint32_t, v1::CollisionEvent> seen_;
};

}  // namespace collision::client
