// Messages as a well-behaved simulator writes them, for tests to spoil.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "idl/identity.h"
#include "idl/messages.pb.h"

namespace collision::server {

inline constexpr std::int64_t kNeverNs = std::numeric_limits<std::int64_t>::max();

inline v1::AgentDescription Description(const std::string& simulator, std::uint32_t slot,
                                        std::uint32_t run = 1) {
  v1::AgentDescription wire;
  wire.set_simulator_id(SimulatorId(simulator));
  wire.set_slot(slot);
  wire.set_run(run);
  wire.set_generation(1);
  wire.set_revision(1);
  wire.set_sequence(slot + 1);
  wire.set_simulator_name(simulator);
  wire.set_agent_name("agent " + std::to_string(slot));
  wire.set_radius_m(1);
  wire.set_acceleration_max_m_s2(2);
  wire.set_angular_acceleration_max_rad_s2(-1);
  return wire;
}

/// At rest, 100 m times the slot along x.
inline v1::AgentState State(std::uint32_t slot, std::int64_t stamp_ns, std::uint64_t sequence) {
  v1::AgentState wire;
  wire.set_slot(slot);
  wire.set_generation(1);
  wire.set_stamp_ns(stamp_ns);
  wire.set_sequence(sequence);
  wire.mutable_position_m()->set_x(100.0 * slot);
  wire.mutable_orientation()->set_w(1);
  wire.set_direction_until_ns(kNeverNs);
  wire.set_expiry_ns(kNeverNs);
  return wire;
}

inline v1::AgentStates Chunk(const std::string& simulator, std::uint32_t run = 1) {
  v1::AgentStates wire;
  wire.set_simulator_id(SimulatorId(simulator));
  wire.set_run(run);
  return wire;
}

inline v1::SimulatorClock ClockOf(const std::string& simulator, std::int64_t clock_ns,
                                  std::uint32_t run = 1) {
  v1::SimulatorClock wire;
  wire.set_simulator_id(SimulatorId(simulator));
  wire.set_run(run);
  wire.set_simulator_name(simulator);
  wire.set_clock_ns(clock_ns);
  wire.set_lock_step(true);
  return wire;
}

inline v1::Input From(std::uint64_t sender, const v1::AgentDescription& message) {
  v1::Input input;
  input.set_sender(sender);
  *input.mutable_agent_description() = message;
  return input;
}

inline v1::Input From(std::uint64_t sender, const v1::AgentStates& message) {
  v1::Input input;
  input.set_sender(sender);
  *input.mutable_agent_states() = message;
  return input;
}

inline v1::Input From(std::uint64_t sender, const v1::AgentState& state,
                      const std::string& simulator, std::uint32_t run = 1) {
  v1::AgentStates chunk = Chunk(simulator, run);
  *chunk.add_states() = state;
  return From(sender, chunk);
}

inline v1::Input From(std::uint64_t sender, const v1::SimulatorClock& message) {
  v1::Input input;
  input.set_sender(sender);
  *input.mutable_simulator_clock() = message;
  return input;
}

inline v1::Input Removal(std::uint64_t sender, const std::string& simulator, std::uint32_t slot) {
  v1::Input input;
  input.set_sender(sender);
  input.mutable_agent_removal()->set_simulator_id(SimulatorId(simulator));
  input.mutable_agent_removal()->set_slot(slot);
  return input;
}

inline v1::Input Liveliness(std::uint64_t sender, const std::string& simulator, bool alive) {
  v1::Input input;
  input.set_sender(sender);
  input.mutable_liveliness()->set_simulator_id(SimulatorId(simulator));
  input.mutable_liveliness()->set_alive(alive);
  return input;
}

inline v1::Input Command(std::uint64_t command_id, v1::OperatorCommandKind kind,
                         const std::string& simulator = "") {
  v1::Input input;
  input.mutable_operator_command()->set_command_id(command_id);
  input.mutable_operator_command()->set_kind(kind);
  input.mutable_operator_command()->set_simulator(simulator);
  return input;
}

/// The value of an extension of a status; empty if it has none of this key.
inline std::string Extension(const v1::ServiceStatus& status, const std::string& key) {
  for (const v1::KeyValue& extension : status.extensions()) {
    if (extension.key() == key) return extension.value();
  }
  return "";
}

/// A clock behind all states and descriptions up to these sequences.
inline v1::SimulatorClock ClockAfter(const std::string& simulator, std::int64_t clock_ns,
                                     std::uint64_t states, std::uint64_t descriptions) {
  v1::SimulatorClock clock = ClockOf(simulator, clock_ns);
  clock.set_states_sequence(states);
  clock.set_descriptions_sequence(descriptions);
  return clock;
}

/// Alpha with agents in slots 0 and 1, 100 m apart, and its clock at 0.
inline std::vector<v1::Input> AlphaJoins(std::uint64_t sender) {
  v1::AgentStates chunk = Chunk("alpha");
  *chunk.add_states() = State(0, 0, 1);
  *chunk.add_states() = State(1, 0, 2);
  return {From(sender, Description("alpha", 0)), From(sender, Description("alpha", 1)),
          From(sender, chunk), From(sender, ClockAfter("alpha", 0, 2, 2))};
}

}  // namespace collision::server
