// Where the samples of simulators wait between Cyclone DDS and a program.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "dds/dds.h"
#include "dds/ddsc/dds_rhc.h"
#include "idl/dds/inbox/sender_queues.h"

namespace collision::dds {

struct ReleaseSerdata {
  void operator()(ddsi_serdata* data) const;
};

/// A sample as it came from the network, not yet decoded.
struct ArrivedSample {
  std::size_t topic = 0;     ///< As MakeHistory() was told.
  std::uint64_t sender = 0;  ///< SenderOf() its writer's participant.
  dds_instance_handle_t writer = 0;
  std::int64_t arrived_ns = 0;  ///< Monotonic.
  std::unique_ptr<ddsi_serdata, ReleaseSerdata> data;

  bool has_data() const;  ///< Otherwise only its key is set.
  bool is_disposed() const;
};

/// A writer that has written for the first time.
struct NewWriter {
  std::size_t topic;
  std::uint64_t sender;
  dds_instance_handle_t writer;
};

/// A sender that the inbox ignores from now on, because more of it has waited than may.
struct IgnoredSender {
  NewWriter writer;  ///< One of its writers.
  std::int64_t for_ns;
};

/// What a sender loses, or is about to.
struct InboxLoss {
  std::optional<NewWriter> writer;  ///< One of its writers; nullopt: all have left.
  SenderLoss loss;
};

/// Of the domain of the readers.
struct DomainFacts {
  std::string open_interface;    ///< The first one that leads off this machine; empty: none.
  bool profile_secures = false;  ///< The network profile does.
};

/// The history cache of several readers. That of Cyclone DDS keeps an instance for every key ever
/// written or disposed of while its writer lives, hands samples on instance by instance, and
/// knows no senders; this one keeps what waits, in SenderQueues, and nothing else. A reader with it
/// has no samples of its own: they are taken from here.
///
/// It outlives the readers. DDS calls the histories on its own threads; all else is for one thread.
class Inbox {
 public:
  explicit Inbox(const SenderLimits& limits) : queues_(limits) {}

  /// Arrivals trigger this guard condition. Before the first history is made.
  void SetGuard(dds_entity_t guard) { guard_ = guard; }

  /// For dds_create_reader_rhc(), which takes it over. `depth`: newest samples of a key that are
  /// kept; `topic` comes back with each sample; `keeps_place`: as in SampleFacts.
  dds_rhc* MakeHistory(std::size_t topic, std::size_t depth, bool keeps_place);

  /// As SenderQueues::Take(), with no more bytes than SenderQueues::AtOnce().
  std::vector<ArrivedSample> Take(std::size_t samples, std::size_t bytes);

  /// How long the oldest of what the last Take() returned had waited [ns]; 0: it was empty.
  std::int64_t waited_ns() const { return waited_ns_; }

  /// The writers whose first sample has arrived since the last call.
  std::vector<NewWriter> TakeNewWriters();

  std::vector<IgnoredSender> TakeIgnoredSenders();

  /// As SenderQueues::Losses().
  std::vector<InboxLoss> Losses() const;

  /// How long until something can be taken [ns]; nullopt: nothing waits.
  std::optional<std::int64_t> UntilReady();

  /// Once a reader has been made.
  const DomainFacts& domain() const { return domain_; }

  /// True once after much has waited and is gone: memory can be given back.
  bool TakeRelief();

  /// As SenderQueues::refused().
  std::uint64_t refused() const;

 private:
  struct History;
  static const dds_rhc_ops kOperations;

  void Put(const History& history, const ddsi_writer_info& writer, ddsi_serdata* data);

  dds_entity_t guard_ = 0;
  DomainFacts domain_;
  mutable std::mutex mutex_;
  // All below are guarded by mutex_.
  bool triggered_ = false;  ///< The guard condition, since the last Take().
  SenderQueues<ArrivedSample> queues_;
  std::map<dds_instance_handle_t, NewWriter> writers_;
  std::vector<NewWriter> new_writers_;
  std::vector<IgnoredSender> ignored_;
  std::size_t waiting_most_ = 0;  ///< Since the last relief [bytes].

  std::int64_t waited_ns_ = 0;  ///< Of the thread that takes.
};

}  // namespace collision::dds
