// Which revisions of events are new, and which are outdated.
#pragma once

#include <unordered_map>

#include "idl/messages.pb.h"

namespace collision::client {

/// Drops revisions of events that were seen before. A service counts them from 1 for each contact;
/// another service counts anew.
class RevisionFilter {
 public:
  /// False: this revision of the contact, or a later one, has been seen. Of another service only
  /// the repetition of the known revision is not new.
  bool IsNew(const v1::CollisionEvent& event);

 private:
  /// By pair slot, the topic's key: the service bounds their number.
  std::unordered_map<std::uint32_t, v1::CollisionEvent> seen_;
};

}  // namespace collision::client
