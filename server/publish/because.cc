#include "server/publish/because.h"

namespace collision::server {

void AddBecause(const EndedRuns& ended, v1::CollisionEvent* event) {
  const bool final = event->status() == v1::EVENT_WITHDRAWN || event->status() == v1::EVENT_ENDED ||
                     event->status() == v1::EVENT_UNDECIDED;
  if (!final || ended.size() == 0) return;
  auto cause = ended.Find(event->lower().simulator_id(), event->lower().run());
  if (!cause) cause = ended.Find(event->higher().simulator_id(), event->higher().run());
  if (!cause) return;
  v1::KeyValue& extension = *event->add_extensions();
  extension.set_key(kBecause);
  extension.set_value(NameOf(*cause));
}

}  // namespace collision::server
