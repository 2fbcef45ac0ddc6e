// From samples that arrived to messages.
#pragma once

#include <cstdint>
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "idl/dds/topics.h"
#include "idl/messages.pb.h"

namespace collision::dds {

/// Which program wrote a sample: the hash of its participant's GUID. Remembers the answers, since a
/// writer that has gone can no longer be asked for while its last samples still wait.
class Senders {
 public:
  /// Nothing if the writer went before it was ever asked for.
  std::optional<std::uint64_t> Of(dds_entity_t reader, dds_instance_handle_t writer);

 private:
  std::unordered_map<dds_instance_handle_t, std::uint64_t> known_;
};

/// Takes samples from readers, by loan, and turns them into messages.
class Intake {
 public:
  /// `own` names the one simulator whose clearances and rejections are wanted; 0: everybody's.
  explicit Intake(std::uint64_t own) : own_(own) {}

  /// Takes at most `limit` samples and appends their messages. Returns how many it took.
  std::size_t Take(dds_entity_t reader, const TopicRow& row, std::size_t limit,
                   std::vector<v1::Input>* inputs, std::vector<v1::Output>* outputs);

  std::uint64_t orphaned() const { return orphaned_; }

 private:
  void Receive(dds_entity_t reader, const TopicRow& row, const void* sample,
               const dds_sample_info_t& info, std::vector<v1::Input>* inputs);
  void ReceiveData(dds_entity_t reader, const TopicRow& row, const void* sample,
                   const dds_sample_info_t& info, std::vector<v1::Input>* inputs);
  void ReceiveEnd(const TopicRow& row, const void* sample, bool disposed, std::uint64_t sender,
                  std::vector<v1::Input>* inputs);
  bool Wanted(const TopicRow& row, const void* sample) const;

  const std::uint64_t own_;
  Senders senders_;
  std::unordered_set<std::uint64_t> gone_;  // simulators whose clock has no writer
  std::uint64_t orphaned_ = 0;
};

}  // namespace collision::dds
