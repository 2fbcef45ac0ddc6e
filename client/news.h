// Which of the things that services say are news.
#pragma once

#include <unordered_map>

#include "idl/messages.pb.h"

namespace collision::client {

/// Services come and go: a standby takes over with a higher term, a restarted one begins its
/// sequences anew. What a lower term says is void. Within a term the network keeps the order of
/// each writer, so a sequence that falls back is a new incarnation of the service, not an old
/// sample.
class News {
 public:
  /// False: from a term that is over.
  bool IsCurrent(const v1::ServiceStamp& stamp);

  /// False: a revision (or a later one) of this contact has been seen. A new incarnation counts
  /// revisions anew; of what it says, only what equals the known is no news.
  bool IsNew(const v1::CollisionEvent& event);

 private:
  std::uint32_t term_ = 0;
  /// By pair slot, the topic's key: the service bounds how many there are.
  std::unordered_map<std::uint32_t, v1::CollisionEvent> seen_;
};

}  // namespace collision::client
