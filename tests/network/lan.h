// Several hosts on one machine: network namespaces on a switch of our own.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "tests/network/switch.h"

namespace collision::network {

/// Made at the start, removed at the end. Host i has the address 10.99.0.(i + 1) on its only device
/// beside loopback.
class Lan {
 public:
  /// Throws std::runtime_error, with what was refused, where that is not allowed: it takes root.
  Lan(std::size_t hosts, std::uint64_t seed);
  Lan(const Lan&) = delete;
  Lan& operator=(const Lan&) = delete;
  ~Lan();

  /// The network namespace of a host.
  const std::string& host(std::size_t index) const { return hosts_.at(index); }

  /// Of every link.
  void SetFaults(const LinkFaults& faults);

  /// Pulls the cable of a host out, or puts it back.
  void Plug(std::size_t host, bool in) { switch_->Plug(host, in); }

  /// The kernel of each host, too, loses what arrives with this probability (nftables). Throws
  /// std::runtime_error where there is no nft, or it is not allowed.
  void LoseAtHosts(double probability) const;

  FrameCounts counts() const { return switch_->counts(); }

 private:
  void Remove();

  std::vector<std::string> hosts_;
  std::unique_ptr<Switch> switch_;
};

/// Why a Lan cannot be made here; empty: it can.
std::string WhyNoLan();

}  // namespace collision::network
