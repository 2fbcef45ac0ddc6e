// A program that has credentials, and writes what they are not for, again and again until it is
// ended; it says "writes" once it does.
//
//   impostor as NAME FOR    a simulator that writes in the partition of NAME, and speaks for FOR
//   impostor serve FOR -    a service that grants FOR all time
//
// After these words: WORLD DOMAIN. Its credentials: COLLISION_CREDENTIALS.
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <limits>
#include <string>
#include <vector>

#include "collision/environment.h"
#include "idl/dds/session.h"
#include "idl/identity.h"

namespace collision::system_test {
namespace {

constexpr std::chrono::milliseconds kPeriod{20};
constexpr std::size_t kTaken = 1000;  // samples at once
constexpr std::uint32_t kRun = std::numeric_limits<std::uint32_t>::max();

/// All that a simulator says, each time newer. The run is higher than any: it would take over.
void SpeakFor(const std::string& name, std::uint64_t sequence, DdsSession* session) {
  v1::SimulatorHello hello;
  hello.set_simulator_id(SimulatorId(name));
  hello.set_incarnation(1);
  hello.set_simulator_name(name);
  session->Write(hello);
  v1::AgentDescription description;
  description.set_simulator_id(SimulatorId(name));
  description.set_incarnation(1);
  description.set_simulator_name(name);
  description.set_agent_name("forged");
  description.set_run(kRun);
  description.set_sequence(sequence);
  description.set_radius_m(1e6);
  session->Write(description);
  v1::AgentStates states;
  states.set_simulator_id(SimulatorId(name));
  states.set_incarnation(1);
  states.set_run(kRun);
  states.add_states()->mutable_orientation()->set_w(1);
  session->Write(states);
  v1::SimulatorClock clock;
  clock.set_simulator_id(SimulatorId(name));
  clock.set_incarnation(1);
  clock.set_simulator_name(name);
  clock.set_run(kRun);
  clock.set_agents(1);
  session->Write(clock);
  v1::AgentRemoval removal;
  removal.set_simulator_id(SimulatorId(name));
  removal.set_slot(1);
  removal.set_sequence(sequence);
  session->RemoveAgent(removal);
}

/// A service that would be believed: of the highest term, and it grants all time.
void Serve(const std::string& world, const std::string& name, std::uint64_t sequence,
           DdsSession* session) {
  const auto stamp = [sequence](v1::ServiceStamp* of) {
    of->set_service_id(1);
    of->set_term(std::numeric_limits<std::uint32_t>::max());
    of->set_sequence(sequence);
  };
  v1::ServiceStatus status;
  status.set_service_id(1);
  status.set_world(world);
  stamp(status.mutable_stamp());
  session->Write(status);
  v1::Clearance clearance;
  clearance.set_simulator_id(SimulatorId(name));
  clearance.set_granted_until_ns(std::numeric_limits<std::int64_t>::max());
  stamp(clearance.mutable_stamp());
  session->Write(clearance);
}

int Run(const std::vector<std::string>& words) {
  const bool serves = words.at(0) == "serve";
  DdsSessionOptions options;
  options.world = words.at(3);
  options.domain = static_cast<std::uint32_t>(std::stoul(words.at(4)));
  options.role = serves ? DdsRole::kService : DdsRole::kSimulator;
  options.simulator = words.at(1);
  options.credentials = client::DefaultCredentials();
  DdsSession session(options);
  std::vector<v1::Input> inputs;
  std::vector<v1::Output> outputs;
  for (std::uint64_t sequence = 1;; ++sequence) {
    serves ? Serve(options.world, words.at(1), sequence, &session)
           : SpeakFor(words.at(2), sequence, &session);
    session.Flush();
    if (sequence == 1) std::printf("writes\n");
    std::fflush(stdout);
    session.Receive(kPeriod, kTaken, &inputs, &outputs);
    inputs.clear();
    outputs.clear();
  }
}

}  // namespace
}  // namespace collision::system_test

int main(int count, char** words) {
  if (count != 6) {
    std::fprintf(stderr, "usage: impostor as NAME FOR | serve FOR - WORLD DOMAIN\n");
    return 2;
  }
  try {
    return collision::system_test::Run({words + 1, words + count});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "impostor: %s\n", error.what());
    return 1;
  }
}
