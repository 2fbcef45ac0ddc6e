// The journal of contacts: what was told, for days.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "idl/messages.pb.h"
#include "server/bus/contact_sink.h"
#include "server/recording/rolling_files.h"

namespace collision::server {

/// Keeps every published contact in files WORLD.DOMAIN.TIME.contacts, each an entry with the wall
/// time at which it was published (idl/recording.proto). A start of the service goes on with the
/// newest file; a tail that is damaged, since the one before was killed, is cut off. One write a
/// step that told contacts, to the page cache. What cannot be written is left out, and tried again
/// with the contacts of a minute later. Throws nothing. One thread.
class ContactJournal final : public ContactSink {
 public:
  explicit ContactJournal(RollingPlace place) : files_(std::move(place)) {}

  /// As of RollingFiles.
  void SetLimits(RollingLimits limits) { files_.SetLimits(limits); }

  /// Opens or begins a file; before that nothing is touched, nor kept.
  void Start(std::int64_t wall_ns);

  void Add(const v1::CollisionEvent& contact) override;
  void Write(std::int64_t wall_ns) override;

  const std::string& failure() const override { return failure_; }

 private:
  std::uint64_t FileBytesMax() const;
  void GoOn(const wire::KeptFile& file);
  bool Begin(std::int64_t wall_ns);
  void Fail(std::int64_t wall_ns);

  RollingFiles files_;
  std::vector<v1::CollisionEvent> told_;  ///< In this step.
  bool has_started_ = false;
  std::int64_t retry_ns_ = 0;  ///< Wall time.
  std::string failure_;
};

}  // namespace collision::server
