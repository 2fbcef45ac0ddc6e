// A world on hosts of its own: services, two simulators, a monitor, and a listener that judges.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "client/checker/motion/motion_truth.h"
#include "tests/network/lan.h"
#include "tests/network/listener.h"
#include "tests/system/process.h"
#include "tests/system/test_world.h"

namespace collision::network {

using system_test::Process;

/// Each has its own host.
enum Party : std::size_t {
  kService,
  kStandby,
  kAlpha,  ///< A simulator.
  kBeta,   ///< Another one.
  kMonitor,
  kListener,
  kParties
};

struct TestbedOptions {
  bool wall_clock = false;    ///< Instead of lock-step.
  bool standby = false;       ///< A second service stands by.
  double claim_wait_s = 0.5;  ///< Longer where programs find each other late.
  double lease_s = 0.5;       ///< Of a service that has a standby; on a busy machine not shorter.
  double seconds = 6;         ///< Simulated.
  double speed = 0;        ///< Lock-step: at most so many simulated seconds a second; 0: no limit.
  LinkFaults faults = {};  ///< Of every link, from the beginning.
  double loss_at_hosts = 0;  ///< Lan::LoseAtHosts().
  std::uint64_t seed = 1;    ///< Of the network.
};

/// What is known when all programs have ended.
struct Flown {
  Heard heard;
  std::vector<v1::CollisionEvent> printed;  ///< By the monitor.
  std::string monitor_said;                 ///< On its standard error.
  std::string event_log;                    ///< The line of the service; empty: it did not end.
  std::vector<checker::AgentMotion> motions;
  checker::RunFacts facts;
  std::vector<std::string> failures;  ///< Programs that did not end as they should.
};

/// Longer than any flight takes, which are two minutes and a half where each way takes 200 ms: one
/// that waits so long has failed.
inline constexpr std::chrono::seconds kPatience{300};

/// A swarm of drones that bounce off each other, half of them in each simulator. The programs are
/// real processes, each on its own host.
class Testbed {
 public:
  /// Starts all programs. Throws std::runtime_error if one does not start.
  explicit Testbed(const TestbedOptions& options);

  Lan& lan() { return lan_; }
  Listener& listener() { return *listener_; }
  /// The program of a party, but the listener.
  Process& process(Party party) { return *processes_.at(party); }

  /// Ends the program of a party without notice (SIGKILL).
  void Kill(Party party);

  /// Starts the program of a party, which was killed, again.
  void Start(Party party);

  /// Waits until a program of a party has written `text`, from now on; throws std::runtime_error
  /// if it does not come.
  void AwaitLog(Party party, const std::string& text);

  /// Waits until `condition` holds of what the listener has heard; false: not within `patience`.
  /// The outputs of all programs are read meanwhile: none may stand still before a full pipe.
  bool Await(const std::function<bool(const Heard&)>& condition,
             std::chrono::nanoseconds patience = kPatience);

  /// Lets time pass.
  void Pass(std::chrono::nanoseconds time);

  /// Waits until so many revisions of contacts have been told; throws std::runtime_error if they
  /// do not come.
  void AwaitContacts(std::size_t count);

  /// Waits until both simulators have come to their end and the service has decided everything,
  /// then ends all programs in good order.
  Flown Finish();

  /// Likewise, but the flight ends now.
  Flown FinishNow();

 private:
  void StartService(Party party);
  void StartSimulator(Party party);
  void DrainOutputs();
  /// The ends of all logs, for the text of a failure.
  std::string Logs() const;
  void AwaitQuiet();
  void AwaitNames();    ///< Of all drones, by the listener.
  void AwaitPrinted();  ///< By the monitor: the newest contact.
  std::int64_t end_ns() const;

  TestbedOptions options_;
  Lan lan_;
  system_test::TestWorld world_;
  std::int64_t start_ns_ = 0;
  std::unique_ptr<Listener> listener_;
  std::array<std::unique_ptr<Process>, kListener> processes_;
  std::array<std::size_t, kListener> log_read_{};  ///< How much of a log AwaitLog() has seen.
};

}  // namespace collision::network
