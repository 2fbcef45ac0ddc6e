#include "tests/bench/service/driver.h"

#include <algorithm>
#include <chrono>
#include <limits>

#include "idl/identity.h"
#include "tests/bench/harness/measure.h"
#include "tests/bench/service/process.h"

namespace collision::bench {
namespace {

constexpr std::uint32_t kChunk = 64;
constexpr std::uint32_t kSingles = 1024;  // chunks of one agent come after those of 64
constexpr double kSpacing = 100;          // [m]
constexpr std::uint32_t kRow = 100;       // agents
// Hardly any: they stand still for minutes, and no other agent comes near.
constexpr double kAccelerationMax = 1e-3;
constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();

v1::AgentDescription DescriptionOf(std::uint32_t slot) {
  v1::AgentDescription wire;
  wire.set_simulator_id(SimulatorId(ServiceDriver::kSimulator));
  wire.set_slot(slot);
  wire.set_run(1);
  wire.set_generation(1);
  wire.set_revision(1);
  wire.set_sequence(slot + 1);
  wire.set_simulator_name(ServiceDriver::kSimulator);
  wire.set_agent_name("a" + std::to_string(slot));
  wire.set_radius_m(1);
  wire.set_acceleration_max_m_s2(kAccelerationMax);
  wire.set_angular_acceleration_max_rad_s2(-1);
  return wire;
}

}  // namespace

ServiceDriver::ServiceDriver(const std::string& world, std::uint32_t domain, std::uint32_t agents,
                             const std::string& credentials)
    : session_({.world = world,
                .domain = domain,
                .role = DdsRole::kSimulator,
                .simulator = kSimulator,
                .credentials = credentials}),
      agents_(agents),
      acknowledged_(agents, 0) {}

// `shift`: how far from its place towards its neighbour the first of them is [m].
void ServiceDriver::Tell(std::uint32_t first, std::uint32_t count, bool jumps, double shift) {
  v1::AgentStates chunk;
  chunk.set_simulator_id(SimulatorId(ServiceDriver::kSimulator));
  chunk.set_run(1);
  chunk.set_chunk(count == 1 ? kSingles + first : first / kChunk);
  for (std::uint32_t slot = first; slot < first + count; ++slot) {
    v1::AgentState& state = *chunk.add_states();
    state.set_slot(slot);
    state.set_generation(1);
    state.set_stamp_ns(WallNs());
    state.set_sequence(++sequence_);
    state.mutable_position_m()->set_x(kSpacing * (slot % kRow) + (slot == first ? shift : 0));
    state.mutable_position_m()->set_y(kSpacing * (slot / kRow));
    if (shift != 0 && slot == first) state.mutable_velocity_m_s()->set_x(1);
    state.mutable_orientation()->set_w(1);
    state.set_direction_until_ns(kNever);
    state.set_expiry_ns(kNever);
    state.set_discontinuity(jumps);
  }
  session_.Write(chunk);
}

void ServiceDriver::TellClock() {
  v1::SimulatorClock clock;
  clock.set_simulator_id(SimulatorId(ServiceDriver::kSimulator));
  clock.set_run(1);
  clock.set_simulator_name(ServiceDriver::kSimulator);
  clock.set_clock_ns(WallNs());
  clock.set_states_sequence(sequence_);
  clock.set_descriptions_sequence(agents_);
  clock.set_agents(agents_);
  session_.Write(clock);
}

void ServiceDriver::WriteAll() {
  for (std::uint32_t first = 0; first < agents_; first += kChunk) {
    Tell(first, std::min(kChunk, agents_ - first), false, 0);
  }
  TellClock();
  session_.Flush();
}

void ServiceDriver::Receive(double seconds) {
  outputs_.clear();
  const auto timeout = std::chrono::nanoseconds(static_cast<std::int64_t>(seconds * 1e9));
  session_.Receive(std::max(timeout, std::chrono::nanoseconds(0)), 4096, nullptr, &outputs_);
  for (const v1::Output& output : outputs_) {
    if (!output.has_clearance()) continue;
    for (const v1::AgentClearance& agent : output.clearance().agents()) {
      if (agent.slot() >= agents_) continue;
      std::uint64_t& sequence = acknowledged_[agent.slot()];
      sequence = std::max(sequence, agent.acknowledged_sequence());
    }
  }
}

bool ServiceDriver::AllAcknowledged(std::uint64_t sequence) const {
  return std::all_of(acknowledged_.begin(), acknowledged_.end(),
                     [=](std::uint64_t acknowledged) { return acknowledged >= sequence; });
}

bool ServiceDriver::Join(double seconds) {
  const Stopwatch watch;
  while (!session_.service_present()) {
    if (watch.seconds() > seconds) return false;
    Receive(0.01);
  }
  for (std::uint32_t slot = 0; slot < agents_; ++slot) session_.Write(DescriptionOf(slot));
  session_.Flush();
  return Round(seconds - watch.seconds()).has_value();
}

std::optional<double> ServiceDriver::Round(double seconds) {
  const std::uint64_t before = sequence_;
  const Stopwatch watch;
  WriteAll();
  while (!AllAcknowledged(before + 1)) {
    if (watch.seconds() > seconds) return std::nullopt;
    Receive(seconds - watch.seconds());
  }
  return watch.seconds();
}

void ServiceDriver::Idle(double seconds) {
  const Stopwatch watch;
  while (watch.seconds() < seconds) Receive(seconds - watch.seconds());
}

std::optional<double> ServiceDriver::JumpToEvent(std::uint32_t pair, double seconds) {
  const std::uint32_t slot = 2 * pair;
  // The service's clock runs on by the monotonic one, and may be a little behind.
  const std::int64_t since_ns = WallNs() - 100'000'000;
  const Stopwatch watch;
  // Two balls of a metre, half a metre apart.
  Tell(slot, 1, true, kSpacing - 2.5);
  TellClock();
  session_.Flush();
  for (;;) {
    if (watch.seconds() > seconds) return std::nullopt;
    Receive(seconds - watch.seconds());
    for (const v1::Output& output : outputs_) {
      if (!output.has_collision_event()) continue;
      const v1::CollisionEvent& event = output.collision_event();
      if (event.lower().slot() != slot || event.now_ns() < since_ns) continue;
      const double latency = watch.seconds();
      Tell(slot, 1, true, 0);
      TellClock();
      session_.Flush();
      return latency;
    }
  }
}

}  // namespace collision::bench
