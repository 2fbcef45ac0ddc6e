// The bus that is a network: DDS.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "idl/dds/session.h"
#include "server/bus/bus.h"

namespace collision::server {

/// The service's end of one world. Topics and order: idl/README.md; QoS and what
/// the network promises: idl/PROTOCOL.md. The only code of the server that knows DDS, by way of
/// idl/dds.
class DdsBus final : public Bus {
 public:
  /// `lease`: how long this service may be silent before its clients count it as gone; each
  /// simulator sets its own (SimulatorLiveliness). Throws std::runtime_error, with the cause, if
  /// the world's name or the domain is out of range, or DDS is not available.
  DdsBus(const std::string& world, std::uint32_t domain,
         std::chrono::nanoseconds lease = std::chrono::seconds(2));

  /// `limit` counts samples: a sample that also ends its instance adds a removal as a second
  /// message, and changes of liveliness come on top.
  bool Receive(std::chrono::nanoseconds timeout, std::size_t limit,
               std::vector<v1::Input>* inputs) override;

  /// Throws std::length_error if a field is longer than the network can carry: a bug of ours.
  void Publish(const v1::Output& output) override;

  void Flush() override;
  void Wake() override;

  std::uint32_t earliest_readers() const override;

  /// counters(), each with "dds_" before its name.
  std::vector<v1::Counter> network_counters() const override;

  /// What the network did not deliver or accept.
  DdsCounters counters() const;

 private:
  DdsSession session_;
};

}  // namespace collision::server
