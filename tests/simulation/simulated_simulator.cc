#include "tests/simulation/simulated_simulator.h"

#include <algorithm>
#include <utility>

#include "idl/identity.h"
#include "idl/sha256.h"

namespace collision::server {
namespace {

constexpr std::int64_t kThinkingTime = 200'000;  // [ns] between two of its steps

void Set(const Eigen::Vector3d& v, v1::Vector3* wire) {
  wire->set_x(v.x());
  wire->set_y(v.y());
  wire->set_z(v.z());
}

}  // namespace

v1::AgentDescription DescriptionOf(const std::string& simulator, std::uint32_t run,
                                   std::uint32_t slot, const SimulatedAgent& agent) {
  v1::AgentDescription wire;
  wire.set_simulator_id(SimulatorId(simulator));
  wire.set_slot(slot);
  wire.set_run(run);
  wire.set_generation(1);
  wire.set_revision(1);
  wire.set_simulator_name(simulator);
  wire.set_agent_name(simulator + "-" + std::to_string(slot));
  wire.set_radius_m(agent.radius);
  wire.set_margin_m(agent.margin);
  wire.set_acceleration_max_m_s2(agent.acceleration_max);
  wire.set_angular_acceleration_max_rad_s2(agent.shape_bytes.empty() ? -1 : 0);
  if (!agent.shape_bytes.empty()) wire.set_shape_hash(Sha256(agent.shape_bytes));
  if (agent.declare) agent.declare(&wire);
  return wire;
}

SimulatedSimulator::SimulatedSimulator(const SimulatorOptions& options,
                                       std::vector<SimulatedAgent> agents,
                                       SimulatedNetwork* network)
    : options_(options),
      id_(SimulatorId(options.name)),
      agents_(std::move(agents)),
      network_(*network),
      clock_ns_(options.start_ns) {
  for (const SimulatedAgent& agent : agents_) {
    stops_.insert({agent.from_ns, agent.until_ns});
    stops_.insert(agent.motion.jumps_ns.begin(), agent.motion.jumps_ns.end());
  }
  network_.Subscribe([this](const v1::Output& output) { Hear(output); });
}

void SimulatedSimulator::Start(std::int64_t delay_ns) {
  network_.At(network_.now_ns() + delay_ns, [this] {
    started_ = true;
    PublishAt(options_.start_ns);
  });
}

void SimulatedSimulator::Kill() {
  killed_ = true;
  network_.Kill(options_.sender, id_);
}

void SimulatedSimulator::Hear(const v1::Output& output) {
  if (output.has_rejection() && output.rejection().simulator_id() == id_) {
    rejections_.push_back(output.rejection());
  }
  if (output.has_simulator_report()) HearReport(output.simulator_report());
  if (!output.has_clearance() || output.clearance().simulator_id() != id_) return;
  const v1::Clearance& clearance = output.clearance();
  if (clearance.run() != options_.run) return;
  if (clearance.granted_until_ns() < granted_ns_) grant_withdrawn_ = true;
  granted_ns_ = std::max(granted_ns_, clearance.granted_until_ns());
  for (const v1::AgentClearance& agent : clearance.agents()) {
    const auto awaited = awaited_.find(agent.slot());
    if (awaited != awaited_.end() && awaited->second <= agent.acknowledged_sequence()) {
      awaited_.erase(awaited);
    }
  }
  if (!started_ || killed_ || finished_ || std::exchange(continuing_, true)) return;
  network_.At(network_.now_ns() + kThinkingTime, [this] {
    continuing_ = false;
    Continue();
  });
}

/// What it wrote while its predecessor counted as alive was refused.
void SimulatedSimulator::HearReport(const v1::SimulatorReport& report) {
  const bool succeeds = report.simulator_id() == id_ && report.run() < options_.run;
  if (!succeeds || report.alive() || !started_ || killed_ || finished_) return;
  written_.clear();
  for (const std::uint32_t slot : present_) Describe(slot);
  WriteChunks();
  WriteClock();
}

std::int64_t SimulatedSimulator::NextStop() const {
  const std::int64_t next = (clock_ns_ / options_.period_ns + 1) * options_.period_ns;
  const auto stop = stops_.upper_bound(clock_ns_);
  return std::min({next, options_.end_ns, stop == stops_.end() ? next : *stop});
}

void SimulatedSimulator::Continue() {
  if (killed_ || finished_ || !awaited_.empty() || granted_ns_ <= clock_ns_) return;
  if (clock_ns_ >= options_.end_ns) return;
  if (granted_ns_ < NextStop()) {
    clock_ns_ = granted_ns_;
    return WriteClock();
  }
  PublishAt(NextStop());
  if (granted_ns_ <= clock_ns_ || std::exchange(continuing_, true)) return;
  network_.At(network_.now_ns() + kThinkingTime, [this] {
    continuing_ = false;
    Continue();
  });
}

void SimulatedSimulator::PublishAt(std::int64_t clock_ns) {
  clock_ns_ = clock_ns;
  const bool ends = clock_ns_ >= options_.end_ns && options_.removes_at_end;
  for (std::uint32_t slot = 0; slot < agents_.size(); ++slot) {
    const SimulatedAgent& agent = agents_[slot];
    const bool lives = agent.from_ns <= clock_ns_ && clock_ns_ < agent.until_ns;
    if (lives && !present_.contains(slot)) Describe(slot);
    if (!lives && !ends && present_.contains(slot)) Remove(slot);
  }
  WriteChunks();
  WriteClock();
  finished_ = clock_ns_ >= options_.end_ns;
  if (!ends) return;
  // Once its last clock has had its effect, it leaves.
  network_.At(network_.now_ns() + 1'000'000'000, [this] {
    for (const std::uint32_t slot : std::set<std::uint32_t>(present_)) Remove(slot);
    network_.At(network_.now_ns() + 100'000'000, [this] { Kill(); });
  });
}

void SimulatedSimulator::WriteShape(const std::string& bytes) {
  const std::string hash = Sha256(bytes);
  if (bytes.empty() || !written_.insert(hash).second) return;
  v1::Input input;
  v1::ShapePart& part = *input.mutable_shape_part();
  part.set_simulator_id(id_);
  part.set_run(options_.run);
  part.set_shape(Incarnation() + static_cast<std::uint32_t>(written_.size()));
  part.set_content_hash(hash);
  part.set_parts(1);
  part.set_total_bytes(bytes.size());
  part.set_bytes(bytes);
  network_.Write(options_.sender, input);
}

void SimulatedSimulator::Describe(std::uint32_t slot) {
  WriteShape(agents_[slot].shape_bytes);
  v1::Input input;
  *input.mutable_agent_description() =
      DescriptionOf(options_.name, options_.run, slot, agents_[slot]);
  input.mutable_agent_description()->set_incarnation(Incarnation());
  input.mutable_agent_description()->set_sequence(++descriptions_sequence_);
  network_.Write(options_.sender, input);
  present_.insert(slot);
  awaited_[slot] = states_sequence_ + 1;
}

void SimulatedSimulator::Remove(std::uint32_t slot) {
  v1::Input input;
  input.mutable_agent_removal()->set_simulator_id(id_);
  input.mutable_agent_removal()->set_slot(slot);
  input.mutable_agent_removal()->set_incarnation(Incarnation());
  input.mutable_agent_removal()->set_sequence(++descriptions_sequence_);
  network_.Write(options_.sender, input);
  present_.erase(slot);
  awaited_.erase(slot);
}

v1::AgentState SimulatedSimulator::StateOf(std::uint32_t slot) {
  const SimulatedAgent& agent = agents_[slot];
  const Piece now = agent.motion.At(clock_ns_).From(clock_ns_);
  v1::AgentState state;
  state.set_slot(slot);
  state.set_generation(1);
  state.set_stamp_ns(clock_ns_);
  state.set_sequence(++states_sequence_);
  Set(now.p, state.mutable_position_m());
  Set(now.v, state.mutable_velocity_m_s());
  state.mutable_orientation()->set_w(1);
  state.set_position_error_m(agent.position_error);
  state.set_direction_until_ns(std::numeric_limits<std::int64_t>::max());
  state.set_expiry_ns(std::numeric_limits<std::int64_t>::max());
  const auto& jumps = agent.motion.jumps_ns;
  if (std::binary_search(jumps.begin(), jumps.end(), clock_ns_)) {
    state.set_discontinuity(true);
    awaited_[slot] = state.sequence();
  }
  if (agent.tell) agent.tell(&state);
  return state;
}

void SimulatedSimulator::WriteChunks() {
  std::map<std::uint32_t, v1::Input> chunks;
  for (const std::uint32_t slot : present_) {
    v1::AgentStates& chunk = *chunks[slot / options_.chunk_size].mutable_agent_states();
    chunk.set_simulator_id(id_);
    chunk.set_chunk(slot / options_.chunk_size);
    chunk.set_incarnation(Incarnation());
    chunk.set_run(options_.run);
    *chunk.add_states() = StateOf(slot);
  }
  for (const auto& [index, input] : chunks) network_.Write(options_.sender, input);
}

void SimulatedSimulator::WriteClock() {
  v1::Input input;
  v1::SimulatorClock& clock = *input.mutable_simulator_clock();
  clock.set_simulator_id(id_);
  clock.set_incarnation(Incarnation());
  clock.set_run(options_.run);
  clock.set_simulator_name(options_.name);
  clock.set_clock_ns(clock_ns_);
  clock.set_states_sequence(states_sequence_);
  clock.set_descriptions_sequence(descriptions_sequence_);
  clock.set_agents(static_cast<std::uint32_t>(present_.size()));
  clock.set_lock_step(true);
  network_.Write(options_.sender, input);
}

}  // namespace collision::server
