// Which senders are refused because their clocks are off.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "server/intake/agent_registry.h"
#include "server/process/names_log.h"
#include "server/world/world.h"

namespace collision::server {

/// With a wall clock each clock of a simulator answers a sample of the service (SenderClock). A
/// simulator whose offset is certainly beyond `clock.skew_max_s` is refused: its states are
/// dropped, what was promised about its agents is void from the time up to which it was last
/// certain to be within, and the log says what to do. It is taken again when its clock is right.
/// One thread.
class SenderClocks {
 public:
  /// `world` and `agents` outlive this.
  SenderClocks(const v1::Config& config, World* world, AgentRegistry* agents);

  /// The id of this service, which echoes of its samples name.
  void SetServiceId(std::uint64_t service_id) { service_id_ = service_id; }

  /// Takes a clock of the owner of its simulator.
  void Take(Simulator* simulator, const v1::SimulatorClock& clock);

  /// Names in the log each simulator that was refused since the last line. At the end of a batch.
  void WriteNames() { names_.Write(world_.monotonic_ns()); }

  /// Why the states of a chunk are refused, if they are.
  std::optional<Refusal> Check(const Simulator& simulator, const v1::AgentStates& chunk) const;

 private:
  std::string WhatIsWrong(const Simulator& simulator) const;

  const double skew_max_s_;
  World& world_;
  AgentRegistry& agents_;
  std::uint64_t service_id_ = 0;
  NamesLog names_{
      "refuses simulator {}: its clock is off by more than clock.skew_max_s; its rejections and "
      "collisionctl status say by how much. Synchronise its clock, or set clock.skew_max_s higher"};
};

}  // namespace collision::server
