// Notices every writer that comes, leaves, falls silent or is back.
#pragma once

#include <mutex>
#include <vector>

#include "dds/dds.h"

namespace collision::dds {

struct WriterChange {
  dds_entity_t reader;  ///< Whose writer it is.
  dds_instance_handle_t writer;
  bool alive;  ///< Came or is back; false: left, or its lease ended.
};

/// A listener, and not the status that DDS keeps for polling: the status names only the last of
/// several changes, and an instance tells only of its last writer, while here each writer counts.
/// It outlives the readers that it listens to. Take() is for one thread; DDS calls on its own.
class WriterWatch {
 public:
  WriterWatch();
  WriterWatch(const WriterWatch&) = delete;
  WriterWatch& operator=(const WriterWatch&) = delete;
  ~WriterWatch();

  /// To make readers with: one set later would begin with several changes in one. Each change
  /// triggers `guard`.
  const dds_listener_t* Listen(dds_entity_t guard);

  /// The changes since the last call, in their order.
  std::vector<WriterChange> Take();

 private:
  static void OnChange(dds_entity_t reader, dds_liveliness_changed_status_t status, void* watch);

  dds_listener_t* const listener_;
  std::mutex mutex_;
  dds_entity_t guard_ = 0;             // guarded by mutex_
  std::vector<WriterChange> changes_;  // likewise
};

}  // namespace collision::dds
