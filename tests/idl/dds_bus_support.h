// What the tests of the DDS bus share: a world of their own, waiting with a deadline, child
// processes.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include "idl/dds/session.h"
#include "server/bus/dds_bus.h"

namespace collision::server {

inline constexpr std::chrono::milliseconds kShort{20};  ///< One wait inside a loop.
inline constexpr std::chrono::seconds kDeadline{120};   ///< For what must come.
inline constexpr std::uint32_t kIncarnation = 77;       ///< Of all that write descriptions here.
inline constexpr std::uint64_t kRemovalSequence = 90;   ///< Of every removal.
inline constexpr std::chrono::nanoseconds kLease = std::chrono::seconds(1);

/// This process's own, so that tests that run side by side do not meet.
std::uint32_t TestDomain();
std::string TestWorld();

DdsSessionOptions SimulatorOptions(const std::string& name);
DdsSessionOptions MonitorOptions(bool reads_simulators);

v1::AgentDescription Description(const std::string& simulator, std::uint32_t slot);
v1::AgentRemoval RemovalOf(const std::string& simulator, std::uint32_t slot);
v1::AgentStates States(const std::string& simulator, std::uint64_t sequence);
v1::SimulatorClock SimulatorTime(const std::string& simulator, std::int64_t clock_ns);

/// Receives until `done` holds for everything received so far. False: not by the deadline.
bool ReceiveUntil(Bus& bus, std::vector<v1::Input>* inputs, const std::function<bool()>& done);
bool ReceiveUntil(DdsSession& session, std::vector<v1::Output>* outputs,
                  const std::function<bool()>& done);

std::size_t Count(const std::vector<v1::Input>& inputs, v1::Input::MessageCase kind);
std::size_t Count(const std::vector<v1::Output>& outputs, v1::Output::MessageCase kind);

/// The simulator "child" as a process of its own, in this process's world. It writes an agent and a
/// clock of 1 ns once it has heard a service's status, and a clock of 2 ns once it has heard
/// `events` forecasts of different pair slots, or contacts; then it stays. The destructor kills it.
class ChildSimulator {
 public:
  explicit ChildSimulator(std::size_t events);
  ChildSimulator(const ChildSimulator&) = delete;
  ChildSimulator& operator=(const ChildSimulator&) = delete;
  ~ChildSimulator();

  void Kill();
  void Stop();      ///< SIGSTOP; returns when it stands still.
  void Continue();  ///< SIGCONT.

 private:
  pid_t process_;
};

/// The child's side.
int RunChildSimulator(std::uint32_t domain, const std::string& world, std::size_t events);

}  // namespace collision::server
