// A simulator of agents that stand on a grid: one jumps now and then, or all tell their states as
// fast as they are acknowledged.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "idl/dds/session.h"

namespace collision::bench {

class ServiceDriver {
 public:
  static constexpr char kSimulator[] = "bench";

  /// `credentials`: a folder; empty: none.
  ServiceDriver(const std::string& world, std::uint32_t domain, std::uint32_t agents,
                const std::string& credentials = "");

  /// Describes all agents and tells their states, until all are acknowledged. False: not within
  /// `seconds`.
  bool Join(double seconds);

  /// An agent jumps to where it meets its neighbour in half a second, and back when the event has
  /// come. Seconds from writing the state to having the event; nullopt: none within `seconds`.
  std::optional<double> JumpToEvent(std::uint32_t pair, double seconds);

  /// All states once; seconds until the last of them is acknowledged; nullopt: not within
  /// `seconds`.
  std::optional<double> Round(double seconds);

  /// Takes what comes.
  void Idle(double seconds);

  std::uint32_t pairs() const { return agents_ / 2; }

 private:
  void Tell(std::uint32_t first, std::uint32_t count, bool jumps, double shift);
  void TellClock();
  void WriteAll();
  void Receive(double seconds);
  bool AllAcknowledged(std::uint64_t sequence) const;

  DdsSession session_;
  const std::uint32_t agents_;
  std::uint64_t sequence_ = 0;
  std::vector<std::uint64_t> acknowledged_;  // by slot
  std::vector<v1::Output> outputs_;
};

}  // namespace collision::bench
