#include "tests/bench/service/process.h"

#include <signal.h>
#include <spdlog/spdlog.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <ctime>
#include <stdexcept>
#include <vector>

#include "server/bus/dds_bus.h"
#include "server/bus/system_clock.h"
#include "server/config/config.h"
#include "server/service/daemon.h"
#include "server/service/program/kept_in_state_dir.h"
#include "tests/bench/service/crowd.h"

namespace collision::bench {
namespace {

using namespace std::chrono_literals;

constexpr std::uint32_t kAgentsMax = 20000;
constexpr std::size_t kBatchMax = 65536;

void ServeOurs(const std::string& world, std::uint32_t domain, const ServiceFolders& folders) {
  v1::Config config;
  config.set_world(world);
  config.set_domain(domain);
  config.mutable_clock()->set_kind(v1::Clock::REAL_TIME);
  config.set_agents_max(kAgentsMax);
  config.set_state_dir(folders.state);
  config = server::CompleteConfig(config);
  const server::KeptInStateDir kept = server::OpenKept(config, {});
  kept.Start();
  server::DdsBus bus(world, domain, {.credentials = folders.credentials});
  server::SystemClock clock;
  server::Daemon daemon(config, bus, clock,
                        {.flight = kept.flight.get(), .contacts = kept.contacts.get()});
  while (daemon.Step()) {
  }
}

v1::Output ClearanceFor(const v1::AgentStates& chunk) {
  v1::Output output;
  v1::Clearance& clearance = *output.mutable_clearance();
  clearance.set_simulator_id(chunk.simulator_id());
  clearance.set_chunk(chunk.chunk());
  clearance.set_run(chunk.run());
  clearance.set_now_ns(WallNs());
  for (const v1::AgentState& state : chunk.states()) {
    v1::AgentClearance& agent = *clearance.add_agents();
    agent.set_slot(state.slot());
    agent.set_generation(state.generation());
    agent.set_acknowledged_sequence(state.sequence());
  }
  return output;
}

v1::Output EventFor(const v1::AgentStates& chunk, const v1::AgentState& state) {
  v1::Output output;
  v1::CollisionEvent& event = *output.mutable_collision_event();
  event.set_pair_slot(state.slot());
  event.set_now_ns(WallNs());
  event.set_contact(1);
  event.set_revision(static_cast<std::uint32_t>(state.sequence()));
  for (v1::AgentId* id : {event.mutable_lower(), event.mutable_higher()}) {
    id->set_simulator_id(chunk.simulator_id());
    id->set_run(chunk.run());
    id->set_generation(1);
  }
  event.mutable_lower()->set_slot(state.slot());
  event.mutable_higher()->set_slot(state.slot() + 1);
  return output;
}

void ServeAtOnce(const std::string& world, std::uint32_t domain) {
  server::DdsBus bus(world, domain);
  v1::Output status;
  status.mutable_service_status()->set_service_id(1);
  status.mutable_service_status()->set_world(world);
  std::vector<v1::Input> inputs;
  while (bus.Receive(500ms, kBatchMax, &inputs)) {
    if (inputs.empty()) bus.Publish(status);
    for (const v1::Input& input : inputs) {
      if (!input.has_agent_states()) continue;
      const v1::AgentStates& chunk = input.agent_states();
      for (const v1::AgentState& state : chunk.states()) {
        if (state.discontinuity()) bus.Publish(EventFor(chunk, state));
      }
      bus.Publish(ClearanceFor(chunk));
    }
    bus.Flush();
    inputs.clear();
  }
}

}  // namespace

std::int64_t WallNs() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

int Serve(const std::string& contestant, const std::string& world, std::uint32_t domain,
          const ServiceFolders& folders) {
  spdlog::set_level(spdlog::level::off);
  try {
    if (contestant == "ours") ServeOurs(world, domain, folders);
    if (contestant == "network") ServeAtOnce(world, domain);
    if (contestant == kCrowd) FlyCrowd(world, domain);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench: %s: %s\n", contestant.c_str(), error.what());
    return 69;
  }
  return 0;
}

ServiceProcess::ServiceProcess(const std::string& contestant, const std::string& world,
                               std::uint32_t domain, const ServiceFolders& folders) {
  const std::string number = std::to_string(domain);
  const pid_t parent = getpid();
  process_ = fork();
  if (process_ < 0) throw std::runtime_error("no process for " + contestant);
  if (process_ > 0) return;
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(1);
  execl("/proc/self/exe", "service-bench", "--serve", contestant.c_str(), "--world", world.c_str(),
        "--domain", number.c_str(), "--credentials", folders.credentials.c_str(), "--state",
        folders.state.c_str(), nullptr);
  _exit(1);
}

ServiceProcess::~ServiceProcess() {
  kill(process_, SIGKILL);
  waitpid(process_, nullptr, 0);
}

double ServiceProcess::CpuSeconds() const {
  clockid_t clock{};
  timespec time{};
  if (clock_getcpuclockid(process_, &clock) != 0 || clock_gettime(clock, &time) != 0) return 0;
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace collision::bench
