// Notices readers and writers of other programs that ours can never meet.
#pragma once

#include <mutex>
#include <set>
#include <string>

#include "dds/dds.h"

namespace collision::dds {

/// Writes a warning to the log of Cyclone DDS (network_log.h; without one standard error) when a
/// reader or writer of a topic of ours asks for, or offers, what ours does not: once for each
/// topic, side and policy. DDS does not say whose it is: `collisionctl doctor` does. Other worlds,
/// which are other partitions, are no misfits. It outlives the participant; DDS calls on its own
/// threads.
class MisfitWatch {
 public:
  MisfitWatch();
  MisfitWatch(const MisfitWatch&) = delete;
  MisfitWatch& operator=(const MisfitWatch&) = delete;
  ~MisfitWatch();

  /// To make the participant with: its readers and writers inherit it.
  const dds_listener_t* listener() const { return listener_; }

 private:
  void Tell(dds_entity_t entity, const char* whose, std::uint32_t policy);

  dds_listener_t* const listener_;
  std::mutex mutex_;
  std::set<std::string> told_;  // guarded by mutex_
};

}  // namespace collision::dds
