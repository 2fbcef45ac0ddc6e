// A program that takes or writes more than is good for others, until it is killed:
// bad_client KIND WORLD DOMAIN. It prints "begun" when the first of it is done.
#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "collision/shape.h"
#include "collision/world.h"
#include "idl/dds/session.h"
#include "idl/identity.h"
#include "idl/shape_bytes.h"
#include "tests/bench/service/crowd.h"
#include "tests/support/random.h"

namespace collision::soak {
namespace {

const std::string kName = "bad";
constexpr std::uint64_t kAtATime = 1000;  // messages between two calls that send them

std::int64_t WallNs() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

void SayBegun() {
  std::puts("begun");
  std::fflush(stdout);
}

/// Writes messages without end; `number` counts them.
void Write(DdsSession* session, const std::function<void(std::uint64_t number)>& write) {
  for (std::uint64_t number = 0;; ++number) {
    write(number);
    if (number % kAtATime != 0) continue;
    session->Flush();
    if (number == kAtATime) SayBegun();
  }
}

/// States of simulators and chunks that are new each time.
void WriteKeys(DdsSession* session) {
  v1::AgentStates states;
  states.set_run(1);
  states.add_states()->mutable_orientation()->set_w(1);
  Write(session, [&](std::uint64_t number) {
    states.set_simulator_id(1 + number / 65536);
    states.set_chunk(static_cast<std::uint32_t>(number % 65536));
    states.set_incarnation(static_cast<std::uint32_t>(number));
    session->Write(states);
  });
}

void DisposeOfKeys(DdsSession* session) {
  Write(session, [&](std::uint64_t number) {
    session->RemoveShape(1, static_cast<std::uint32_t>(number), 1);
  });
}

/// One state each under ids that nobody has proved.
void WriteGhosts(DdsSession* session) {
  Random random(1);
  v1::AgentStates states;
  states.set_run(1);
  states.add_states()->mutable_orientation()->set_w(1);
  Write(session, [&](std::uint64_t) {
    states.set_simulator_id(random.Next());
    session->Write(states);
  });
}

/// What is refused: no number, no known version, no known slot.
void WriteGarbage(DdsSession* session) {
  Random random(2);
  v1::AgentDescription description;
  description.set_simulator_id(SimulatorId(kName));
  description.set_simulator_name(kName);
  description.set_incarnation(1);
  description.set_run(1);
  description.set_generation(1);
  description.set_revision(1);
  description.set_radius_m(std::numeric_limits<double>::quiet_NaN());
  Write(session, [&](std::uint64_t number) {
    description.set_agent_name("garbage-" + std::to_string(number));
    description.set_slot(static_cast<std::uint32_t>(random.Below(1 << 17)));
    description.set_sequence(number + 1);
    session->Write(description);
  });
}

/// Ever-new small shapes, in a name of its own: as many at a time as there are places.
void WriteShapes(DdsSession* session) {
  constexpr std::uint32_t kPlaces = 2000;
  v1::AgentDescription description;
  description.set_simulator_id(SimulatorId(kName));
  description.set_simulator_name(kName);
  description.set_agent_name("proves the name");
  description.set_incarnation(1);
  description.set_run(1);
  description.set_generation(1);
  description.set_revision(1);
  description.set_sequence(1);
  description.set_radius_m(1);
  session->Write(description);
  Write(session, [&](std::uint64_t number) {
    const double size = 1 + 1e-9 * static_cast<double>(number);
    const auto shape = client::Shape::Make(
        {.triangles = {.vertices_m = {{0, 0, 0}, {size, 0, 0}, {0, size, 0}, {0, 0, size}},
                       .indices = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}}});
    v1::ShapePart part;
    part.set_simulator_id(SimulatorId(kName));
    part.set_shape(static_cast<std::uint32_t>(number));
    part.set_content_hash(shape->hash());
    part.set_parts(1);
    part.set_run(1);
    part.set_total_bytes(shape->bytes().size());
    part.set_bytes(shape->bytes());
    session->Write(part);
    if (number >= kPlaces) {
      session->RemoveShape(SimulatorId(kName), static_cast<std::uint32_t>(number - kPlaces), 1);
    }
  });
}

/// States of a thousand agents by the wall clock, as fast as they can be written.
void WriteStream(DdsSession* session) {
  constexpr std::uint32_t kAgents = 1024, kChunk = 64;
  v1::AgentDescription description;
  description.set_simulator_id(SimulatorId(kName));
  description.set_simulator_name(kName);
  description.set_incarnation(1);
  description.set_run(1);
  description.set_generation(1);
  description.set_revision(1);
  description.set_radius_m(1);
  for (std::uint32_t slot = 0; slot < kAgents; ++slot) {
    description.set_agent_name("streamed-" + std::to_string(slot));
    description.set_slot(slot);
    description.set_sequence(slot + 1);
    session->Write(description);
  }
  Write(session, [&](std::uint64_t number) {
    v1::AgentStates states;
    states.set_simulator_id(SimulatorId(kName));
    states.set_incarnation(1);
    states.set_run(1);
    states.set_chunk(static_cast<std::uint32_t>(number % (kAgents / kChunk)));
    const std::int64_t now_ns = WallNs();
    for (std::uint32_t i = 0; i < kChunk; ++i) {
      v1::AgentState& state = *states.add_states();
      state.set_slot(states.chunk() * kChunk + i);
      state.set_generation(1);
      state.set_stamp_ns(now_ns);
      state.set_sequence(number + 1);
      state.mutable_position_m()->set_x(10.0 * state.slot());
      state.mutable_orientation()->set_w(1);
      state.set_direction_until_ns(client::kNever);
      state.set_expiry_ns(client::kNever);
    }
    session->Write(states);
  });
}

/// In lock-step: agents at rest, `apart` from each other, as many as it is allowed. Then it takes
/// no part in the steps of others.
void Fill(const std::string& world, std::uint32_t domain, int count, double apart) {
  constexpr std::chrono::seconds kPatience{60};
  auto connection = client::World::Connect({.world = world, .simulator = kName, .domain = domain});
  const auto now_ns = connection.Join(kPatience);
  if (!now_ns) return;
  std::vector<client::Agent> agents;
  for (int i = 0; i < count; ++i) {
    agents.push_back(connection.AddAgent(
        {.name = "rests-" + std::to_string(i), .radius_m = 1, .acceleration_max_m_s2 = 1e-9},
        {.stamp_ns = *now_ns, .position_m = {apart * i, 0, 0}}));
  }
  connection.AdvanceTo(*now_ns, kPatience);
  connection.Finish();
  SayBegun();
  for (;;) connection.Poll(std::chrono::seconds(1));
}

int Run(const std::string& kind, const std::string& world, std::uint32_t domain) {
  if (kind == "agents") Fill(world, domain, 5000, 10);
  if (kind == "pairs") Fill(world, domain, 150, 0.001);
  if (kind == "crowd") {
    SayBegun();
    bench::FlyCrowd(world, domain);
  }
  const std::map<std::string, void (*)(DdsSession*)> writers = {
      {"keys", WriteKeys},       {"disposals", DisposeOfKeys}, {"ghosts", WriteGhosts},
      {"garbage", WriteGarbage}, {"shapes", WriteShapes},      {"stream", WriteStream}};
  const auto writer = writers.find(kind);
  if (writer == writers.end()) return 2;
  DdsSession session(
      {.world = world, .domain = domain, .role = DdsRole::kSimulator, .simulator = kName});
  std::vector<v1::Output> outputs;
  while (outputs.empty()) {
    session.Receive(std::chrono::milliseconds(20), kAtATime, nullptr, &outputs);
  }
  writer->second(&session);
  return 0;
}

}  // namespace
}  // namespace collision::soak

int main(int count, char** words) {
  if (count != 4) {
    std::fprintf(stderr, "usage: bad_client KIND WORLD DOMAIN\n");
    return 2;
  }
  // As if on another machine: what counts is what it costs the service.
  if (nice(19) == -1) std::perror("nice");
  return collision::soak::Run(words[1], words[2], static_cast<std::uint32_t>(std::atoi(words[3])));
}
