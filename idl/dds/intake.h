// From samples that arrived to messages.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "idl/dds/senders.h"
#include "idl/dds/topics.h"
#include "idl/dds/writer_watch.h"
#include "idl/messages.pb.h"

namespace collision::dds {

/// Takes samples from readers, by loan, and turns them into messages.
class Intake {
 public:
  /// `own` names the one simulator whose clearances and rejections are wanted; 0: those of all.
  explicit Intake(std::uint64_t own) : own_(own) {}

  /// Takes at most `limit` samples and appends their messages. Returns how many it took.
  std::size_t Take(dds_entity_t reader, const TopicRow& row, std::size_t limit,
                   std::vector<v1::Input>* inputs, std::vector<v1::Output>* outputs);

  /// Reports each program that left, fell silent or is back, for every simulator for which it has
  /// spoken, and each other service that left or fell silent. Call it after Take(): what a program wrote comes before the report of its end.
  void Follow(const std::vector<WriterChange>& changes, std::vector<v1::Input>* inputs);

  std::uint64_t orphaned() const { return orphaned_; }

 private:
  void Receive(dds_entity_t reader, const TopicRow& row, const void* sample,
               const dds_sample_info_t& info, std::vector<v1::Input>* inputs);
  void ReceiveData(dds_entity_t reader, const TopicRow& row, const void* sample,
                   const dds_sample_info_t& info, std::vector<v1::Input>* inputs);
  void ReceiveEnd(dds_entity_t reader, const TopicRow& row, const void* sample,
                  const dds_sample_info_t& info, std::vector<v1::Input>* inputs);
  void FollowService(const dds_sample_info_t& info, std::vector<v1::Input>* inputs);
  bool Wanted(const TopicRow& row, const void* sample) const;

  const std::uint64_t own_;
  Senders senders_;
  /// Which other service wrote a status, by writer, while that lives.
  std::unordered_map<dds_instance_handle_t, std::uint64_t> services_;
  std::uint64_t orphaned_ = 0;
};

}  // namespace collision::dds
