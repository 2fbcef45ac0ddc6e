// From samples that arrived to messages.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "idl/dds/endpoints.h"
#include "idl/dds/inbox/inbox.h"
#include "idl/dds/inbox/senders.h"
#include "idl/dds/topics.h"
#include "idl/dds/watch/writer_watch.h"
#include "idl/messages.pb.h"

namespace collision::dds {

/// One sample of each topic, to decode into: its memory is used again.
class SampleBuffers {
 public:
  SampleBuffers() = default;
  SampleBuffers(const SampleBuffers&) = delete;
  SampleBuffers& operator=(const SampleBuffers&) = delete;
  ~SampleBuffers();

  /// The decoded sample, until the next call for its topic; without data, only its key is set.
  /// Null: its bytes are no sample.
  const void* Decode(const ArrivedSample& arrived);

 private:
  std::array<void*, kTopics> samples_{};
};

/// Takes samples from readers, by loan, and from the inbox, and turns them into messages.
class Intake {
 public:
  /// `own` names the one simulator whose clearances and rejections are wanted; 0: those of all.
  Intake(std::uint64_t own, const Endpoints& endpoints) : own_(own), readers_(endpoints.readers) {}

  /// From now on what a program writes counts only for the simulator that its partition names.
  void BindSimulators();

  struct Forgery {
    std::string partition;
    std::uint64_t simulator = 0;
    std::uint64_t samples = 0;
  };

  /// What was dropped for that since the last call, of each partition.
  std::vector<Forgery> TakeForgeries();

  /// How many samples were.
  std::uint64_t forged() const { return forged_; }

  /// Before TakeInbox() takes what they wrote, and after changes were taken that Follow() is to
  /// report: what a writer wrote has arrived before its end is known.
  void AddWriters(const std::vector<NewWriter>& writers);

  /// Takes at most `limit` samples that simulators wrote, and appends their messages. Returns how
  /// many it took.
  std::size_t TakeInbox(Inbox* inbox, std::size_t limit, std::vector<v1::Input>* inputs);

  /// Likewise from the reader of a topic that simulators do not write.
  std::size_t Take(dds_entity_t reader, const TopicRow& row, std::size_t limit,
                   std::vector<v1::Input>* inputs, std::vector<v1::Output>* outputs);

  /// Reports each program that left, fell silent or is back, for every simulator for which it has
  /// spoken, and each service, other than its own, that left or fell silent, or, with its last
  /// status again, is back. Call it after Take(): what a program wrote comes before the report of
  /// its end.
  void Follow(const std::vector<WriterChange>& changes, std::vector<v1::Input>* inputs);

 private:
  void Receive(const ArrivedSample& arrived, std::vector<v1::Input>* inputs);
  void ReceiveData(TopicId topic, const void* sample, std::uint64_t sender,
                   std::vector<v1::Input>* inputs);
  bool IsForged(const ArrivedSample& arrived, const void* sample);
  void FollowService(const void* sample, const dds_sample_info_t& info, bool is_output,
                     std::vector<v1::Input>* inputs);
  void EndService(dds_instance_handle_t writer, std::vector<v1::Input>* inputs);
  bool Wanted(const TopicRow& row, const void* sample) const;

  const std::uint64_t own_;
  const std::array<dds_entity_t, kTopics> readers_;
  Senders senders_;
  bool binds_ = false;
  std::map<std::string, Forgery> forgeries_;  ///< By partition.
  std::uint64_t forged_ = 0;
  /// The last status of each other service, by writer, while that lives.
  std::unordered_map<dds_instance_handle_t, v1::ServiceHeard> services_;
  std::unordered_map<dds_instance_handle_t, v1::ServiceHeard> ended_services_;
  SampleBuffers buffers_;
};

}  // namespace collision::dds
