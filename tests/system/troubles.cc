// A program that is in trouble, or makes it, for the doctor to find.
//
//   troubles second-service   says that it serves the world, and stands by nobody
//   troubles other-revision   the hello of a service of another revision of the wire
//   troubles real-time        a simulator that goes by the wall clock, with one agent
//   troubles ahead            likewise, by a clock that is 150 ms ahead
//   troubles stuck            likewise, which tells one state and then no more
//   troubles two-agents       a simulator in lock-step with two agents, which waits for time
//
// After this word: WORLD DOMAIN. It says "here" on standard output, and stays until it is killed.
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include "collision/world.h"
#include "idl/dds/session.h"
#include "idl/limits.h"

namespace collision::system_test {
namespace {

using std::chrono::milliseconds;
constexpr milliseconds kStep{20};

void SayHere() {
  std::puts("here");
  std::fflush(stdout);
}

std::int64_t WallNs() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

[[noreturn]] void Serve(const std::string& world, std::uint32_t domain, std::uint32_t revision) {
  DdsSessionOptions options;
  options.world = world;
  options.domain = domain;
  options.role = DdsRole::kService;
  DdsSession session(options);
  v1::ServiceHello hello;
  // Of two that nobody follows, the one with the lower id goes on: the real one.
  hello.set_service_id(std::numeric_limits<std::uint64_t>::max());
  hello.set_wire_revision(revision);
  hello.set_version("elsewhere");
  hello.set_world(world);
  session.Write(hello);
  v1::ServiceStatus status;
  status.set_service_id(hello.service_id());
  status.set_phase(v1::PHASE_SERVING);
  status.set_world(world);
  status.set_version(hello.version());
  status.set_simulated_clock(true);
  SayHere();
  for (std::uint64_t sequence = 1;; ++sequence) {
    v1::ServiceStamp& stamp = *status.mutable_stamp();
    stamp.set_service_id(status.service_id());
    stamp.set_sequence(sequence);
    // A status of another revision could not be read.
    if (revision == wire::kWireRevision) session.Write(status);
    session.Flush();
    std::vector<v1::Input> inputs;
    session.Receive(milliseconds(200), 1000, &inputs, nullptr);
  }
}

[[noreturn]] void Simulate(const std::string& name, std::uint32_t domain, std::int64_t ahead_ns,
                           bool gets_stuck) {
  const auto now = [ahead_ns] { return WallNs() + ahead_ns; };
  client::World world = client::World::Connect({.world = name,
                                                .simulator = "troubled",
                                                .domain = domain,
                                                .lock_step = false,
                                                .wall_clock = now});
  client::Agent agent = world.AddAgent({.name = "one", .radius_m = 1, .acceleration_max_m_s2 = 100},
                                       {.stamp_ns = now(), .position_m = {0, 0, 0}});
  client::Agent other = world.AddAgent({.name = "two", .radius_m = 1, .acceleration_max_m_s2 = 100},
                                       {.stamp_ns = now(), .position_m = {10, 0, 0}});
  SayHere();
  for (bool first = true;; first = false) {
    if (first || !gets_stuck) {
      agent.SetState({.stamp_ns = now(), .position_m = {0, 0, 0}});
      other.SetState({.stamp_ns = now(), .position_m = {10, 0, 0}});
    }
    world.Publish(now());
    world.Poll(kStep);
  }
}

[[noreturn]] void WaitForTime(const std::string& name, std::uint32_t domain) {
  client::World world =
      client::World::Connect({.world = name, .simulator = "troubled", .domain = domain});
  const auto ball = [](const char* its) {
    return client::AgentDescription{.name = its, .radius_m = 1, .acceleration_max_m_s2 = 1};
  };
  client::Agent one = world.AddAgent(ball("one"), {});
  client::Agent two = world.AddAgent(ball("two"), {.position_m = {10, 0, 0}});
  SayHere();
  for (std::int64_t now = 0;; now += kStep / std::chrono::nanoseconds(1)) {
    try {
      one.SetState({.stamp_ns = now});
      two.SetState({.stamp_ns = now, .position_m = {10, 0, 0}});
      world.AdvanceTo(now, std::chrono::seconds(1));
    } catch (const std::exception& refused) {
      std::fprintf(stderr, "%s\n", refused.what());
    }
  }
}

[[noreturn]] void Trouble(const std::string& what, const std::string& world, std::uint32_t domain) {
  if (what == "second-service") Serve(world, domain, wire::kWireRevision);
  if (what == "other-revision") Serve(world, domain, wire::kWireRevision + 1);
  if (what == "two-agents") WaitForTime(world, domain);
  Simulate(world, domain, what == "ahead" ? 150'000'000 : 0, what == "stuck");
}

}  // namespace
}  // namespace collision::system_test

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  collision::system_test::Trouble(argv[1], argv[2],
                                  static_cast<std::uint32_t>(std::stoul(argv[3])));
}
