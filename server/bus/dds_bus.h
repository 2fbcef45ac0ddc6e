// The bus that is a network: DDS.
#pragma once

#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include "idl/dds/session.h"
#include "server/bus/bus.h"

namespace collision::server {

struct DdsBusOptions {
  /// How long this service may be silent before its clients count it as gone; each simulator sets
  /// its own (SimulatorLiveliness).
  std::chrono::nanoseconds lease = std::chrono::seconds(2);
  dds::SenderLimits sender_limits = {};
  bool stands_by = false;        ///< It also hears of the contacts that other services publish.
  std::string credentials = {};  ///< Folder; empty: none.
};

/// The service's end of one world. Whatever a program writes, and however many keys it makes up,
/// the others are heard, and memory is bounded (dds::SenderLimits).
///
/// Topics and order: idl/README.md; QoS and what the network promises: idl/PROTOCOL.md. The only
/// code of the server that knows DDS, by way of idl/dds.
class DdsBus final : public Bus {
 public:
  /// Throws std::runtime_error, with the cause, if the world's name or the domain is out of range,
  /// DDS is not available, or it refuses the credentials.
  DdsBus(const std::string& world, std::uint32_t domain, const DdsBusOptions& options = {});
  ~DdsBus() override;
  DdsBus(const DdsBus&) = delete;
  DdsBus& operator=(const DdsBus&) = delete;

  /// `limit` counts samples: a sample that also ends its instance adds a removal as a second
  /// message, and changes of liveliness come on top. At most 16 MiB of samples or one of them,
  /// so that no batch is too large for a recording. Equal shares of all senders that wait.
  bool Receive(std::chrono::nanoseconds timeout, std::size_t limit,
               std::vector<v1::Input>* inputs) override;

  /// Throws std::length_error if a field is longer than the network can carry: a bug of ours.
  void Publish(const v1::Output& output) override;

  void Forget(std::uint64_t simulator_id) override { session_.ForgetSimulator(simulator_id); }
  void Flush() override;
  void HoldAfter(std::chrono::nanoseconds standstill) override { standstill_ = standstill; }
  void EndHold(bool publish) override;
  void Wake() override;

  /// Whether this world is secured.
  bool is_secured() const { return session_.is_secured(); }

  /// The first network interface that leads off this machine; empty: none does.
  std::string open_interface() const { return session_.open_interface(); }

  /// The programs that are ignored from now on or write as somebody else, what Cyclone DDS said
  /// meanwhile, and that the credentials end.
  std::vector<BusWarning> TakeWarnings() override;
  std::uint32_t earliest_readers() const override { return earliest_readers_; }
  std::chrono::nanoseconds waited() const override { return session_.waited(); }

  std::vector<std::string> flooding() const override;

  /// counters(), each with "dds_" before its name.
  std::vector<v1::Counter> network_counters() const override;

  /// What the network did not deliver or accept.
  DdsCounters counters() const;

 private:
  void Write(const v1::Output& output);

  void AddForgeries(std::vector<BusWarning>* lines);

  /// The simulator that a program speaks for, as its partition says.
  std::string SimulatorIn(const std::string& partition) const;

  /// Lines of Cyclone DDS that are kept for TakeWarnings(); further ones are dropped.
  static constexpr std::size_t kSaidMax = 64;

  /// Between two lines about programs that write as somebody else.
  static constexpr std::chrono::seconds kForgeriesTold{1};

  const std::string world_;
  std::mutex said_mutex_;
  std::vector<std::string> said_;
  DdsSession session_;
  std::chrono::nanoseconds standstill_{0};
  std::chrono::steady_clock::time_point ran_;  ///< It certainly ran then.
  std::chrono::steady_clock::time_point forgeries_due_;
  std::uint32_t earliest_readers_ = 0;
  bool holds_ = false;
  std::vector<v1::Output> held_;  ///< Of one step.
};

}  // namespace collision::server
