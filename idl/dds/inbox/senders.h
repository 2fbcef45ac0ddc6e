// Which program wrote a sample, for which simulators it speaks, and whether it is still there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>

#include "dds/dds.h"
#include "dds/ddsi/ddsi_guid.h"

namespace collision::dds {

/// The sender of what a writer with this GUID writes.
std::uint64_t SenderOf(const ddsi_guid& writer);

/// The first partition of a writer; empty if it has left.
std::string PartitionOf(dds_entity_t reader, dds_instance_handle_t writer);

/// A sender is a program: the hash of its participant's GUID. Remembers the answers, since a writer
/// that has left can no longer be looked up while its last samples still wait. One thread.
class Senders {
 public:
  /// From now on the partition of each writer that is added is known.
  void LookUpPartitions() { looks_up_ = true; }

  /// The partition of a writer that was added; empty: it had left before.
  const std::string& PartitionOf(dds_instance_handle_t writer) const {
    return writers_.at(writer).partition;
  }

  /// A writer of which samples have arrived.
  void Add(dds_entity_t reader, dds_instance_handle_t writer, std::uint64_t sender);

  /// nullopt if the writer was never added, and has left.
  std::optional<std::uint64_t> Of(dds_entity_t reader, dds_instance_handle_t writer);

  /// Records that a known sender speaks for a simulator. Returns whether that is new.
  bool AddSimulator(std::uint64_t sender, std::uint64_t simulator);

  /// Records whether a known sender is alive. Returns whether that is new.
  bool SetAlive(std::uint64_t sender, bool alive);

  /// Whether a known sender is alive, as last recorded.
  bool alive(std::uint64_t sender) const { return programs_.at(sender).alive; }

  /// The simulators for which a known sender has spoken.
  const std::set<std::uint64_t>& SimulatorsOf(std::uint64_t sender) const {
    return programs_.at(sender).simulators;
  }

 private:
  struct Writer {
    dds_entity_t reader;  // the reader that received the writer's samples
    std::uint64_t sender;
    std::string partition = {};  // after LookUpPartitions()
  };
  struct Program {
    std::set<std::uint64_t> simulators;
    bool alive = true;
  };

  void DropEnded();

  std::unordered_map<dds_instance_handle_t, Writer> writers_;
  std::unordered_map<std::uint64_t, Program> programs_;  // one for every sender in writers_
  std::size_t writers_until_cleaning_ = 0;
  bool looks_up_ = false;
};

}  // namespace collision::dds
