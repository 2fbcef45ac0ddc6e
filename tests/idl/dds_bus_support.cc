#include "tests/idl/dds_bus_support.h"

#include <signal.h>
#include <spawn.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "idl/identity.h"

extern char** environ;

namespace collision::server {
namespace {

constexpr std::size_t kNoLimit = 1'000'000;

bool Before(std::chrono::steady_clock::time_point end) {
  return std::chrono::steady_clock::now() < end;
}

}  // namespace

std::uint32_t TestDomain() { return 100 + static_cast<std::uint32_t>(getpid()) % 100; }

std::string TestWorld() { return "test-" + std::to_string(getpid()); }

DdsSessionOptions SimulatorOptions(const std::string& name) {
  DdsSessionOptions options;
  options.world = TestWorld();
  options.domain = TestDomain();
  options.role = DdsRole::kSimulator;
  options.simulator = name;
  options.lease = kLease;
  return options;
}

DdsSessionOptions MonitorOptions(bool reads_simulators) {
  DdsSessionOptions options;
  options.world = TestWorld();
  options.domain = TestDomain();
  options.reads_simulators = reads_simulators;
  return options;
}

v1::AgentDescription Description(const std::string& simulator, std::uint32_t slot) {
  v1::AgentDescription message;
  message.set_simulator_id(SimulatorId(simulator));
  message.set_slot(slot);
  message.set_incarnation(kIncarnation);
  message.set_simulator_name(simulator);
  message.set_radius_m(1);
  return message;
}

v1::AgentRemoval RemovalOf(const std::string& simulator, std::uint32_t slot) {
  v1::AgentRemoval removal;
  removal.set_simulator_id(SimulatorId(simulator));
  removal.set_slot(slot);
  removal.set_incarnation(kIncarnation);
  removal.set_sequence(kRemovalSequence);
  return removal;
}

v1::AgentStates States(const std::string& simulator, std::uint64_t sequence) {
  v1::AgentStates message;
  message.set_simulator_id(SimulatorId(simulator));
  message.add_states()->set_sequence(sequence);
  return message;
}

v1::SimulatorClock SimulatorTime(const std::string& simulator, std::int64_t clock_ns) {
  v1::SimulatorClock message;
  message.set_simulator_id(SimulatorId(simulator));
  message.set_simulator_name(simulator);
  message.set_clock_ns(clock_ns);
  return message;
}

bool ReceiveUntil(Bus& bus, std::vector<v1::Input>* inputs, const std::function<bool()>& done) {
  const auto end = std::chrono::steady_clock::now() + kDeadline;
  while (!done() && Before(end)) bus.Receive(kShort, kNoLimit, inputs);
  return done();
}

bool ReceiveUntil(DdsSession& session, std::vector<v1::Output>* outputs,
                  const std::function<bool()>& done) {
  const auto end = std::chrono::steady_clock::now() + kDeadline;
  while (!done() && Before(end)) session.Receive(kShort, kNoLimit, nullptr, outputs);
  return done();
}

std::size_t Count(const std::vector<v1::Input>& inputs, v1::Input::MessageCase kind) {
  return std::count_if(inputs.begin(), inputs.end(),
                       [&](const v1::Input& input) { return input.message_case() == kind; });
}

std::size_t Count(const std::vector<v1::Output>& outputs, v1::Output::MessageCase kind) {
  return std::count_if(outputs.begin(), outputs.end(),
                       [&](const v1::Output& output) { return output.message_case() == kind; });
}

ChildSimulator::ChildSimulator(std::size_t events) {
  std::string program = "/proc/self/exe", domain = std::to_string(TestDomain()),
              world = TestWorld();
  std::string count = std::to_string(events);
  char* arguments[] = {program.data(), domain.data(), world.data(), count.data(), nullptr};
  if (posix_spawn(&process_, program.c_str(), nullptr, nullptr, arguments, environ) != 0) {
    throw std::runtime_error("cannot start a child process");
  }
}

ChildSimulator::~ChildSimulator() { Kill(); }

void ChildSimulator::Kill() {
  if (process_ <= 0) return;
  kill(process_, SIGKILL);
  waitpid(process_, nullptr, 0);
  process_ = 0;
}

void ChildSimulator::Stop() {
  kill(process_, SIGSTOP);
  waitpid(process_, nullptr, WUNTRACED);
}

void ChildSimulator::Continue() { kill(process_, SIGCONT); }

int RunChildSimulator(std::uint32_t domain, const std::string& world, std::size_t events) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // it does not outlive a test that is itself killed
  DdsSessionOptions options = SimulatorOptions("child");
  options.domain = domain;
  options.world = world;
  DdsSession session(options);
  std::vector<v1::Output> outputs;
  const auto heard = [&] { return Count(outputs, v1::Output::kServiceStatus) > 0; };
  if (!ReceiveUntil(session, &outputs, heard)) return 1;
  session.Write(Description("child", 0));
  session.Write(SimulatorTime("child", 1));
  session.Flush();
  std::set<std::uint64_t> different;
  const auto all = [&] {
    for (const v1::Output& output : outputs) {
      if (!output.has_collision_event()) continue;
      const v1::CollisionEvent& event = output.collision_event();
      different.insert(event.contacts_sequence() > 0 ? event.contacts_sequence()
                                                     : event.pair_slot());
    }
    outputs.clear();
    return different.size() == events;
  };
  if (!ReceiveUntil(session, &outputs, all)) return 1;
  session.Write(SimulatorTime("child", 2));
  session.Flush();
  for (;;) pause();
}

}  // namespace collision::server
