#include "idl/dds/watch/writer_watch.h"

#include <utility>

namespace collision::dds {

WriterWatch::WriterWatch() : listener_(dds_create_listener(this)) {
  dds_lset_liveliness_changed(listener_, &OnChange);
}

WriterWatch::~WriterWatch() { dds_delete_listener(listener_); }

const dds_listener_t* WriterWatch::Listen(dds_entity_t guard) {
  const std::lock_guard lock(mutex_);
  guard_ = guard;
  return listener_;
}

std::vector<WriterChange> WriterWatch::Take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(changes_, {});
}

void WriterWatch::OnChange(dds_entity_t reader, dds_liveliness_changed_status_t status,
                           void* watch) {
  // A writer that was silent and now leaves changes nothing.
  if (status.alive_count_change == 0) return;
  auto& self = *static_cast<WriterWatch*>(watch);
  dds_entity_t guard = 0;
  {
    const std::lock_guard lock(self.mutex_);
    guard = self.guard_;
    self.changes_.push_back(
        {reader, status.last_publication_handle, status.alive_count_change > 0});
  }
  dds_set_guardcondition(guard, true);
}

}  // namespace collision::dds
