// A monitor: prints the contacts and forecasts of a world, and what its service says of itself.
#include <csignal>
#include <iostream>
#include <map>

#include "bus.h"
#include "collisionPubSubTypes.h"
#include "event_line.h"
#include "options.h"

namespace example {
namespace {

using namespace collision::v1;
using namespace std::chrono_literals;
using SteadyClock = std::chrono::steady_clock;

constexpr int kNoService = 69;  // EX_UNAVAILABLE

const char* const kHelp =
    "fast-dds-monitor [--world W] [--domain D] [--seconds S]\n"
    "Prints each contact and forecast of a world, and the service's status when it changes.\n"
    "  --world W    default: COLLISION_WORLD, else \"default\"\n"
    "  --domain D   0 to 230; default: COLLISION_DOMAIN, else 0\n"
    "  --seconds S  how long it looks; default: until it is interrupted\n"
    "Exit status: 0; 2 wrong words; 69 no service was heard.\n";

volatile std::sig_atomic_t interrupted = 0;

class Monitor {
 public:
  explicit Monitor(const Options& options)
      : bus_(options.domain, options.world, "monitor"),
        hellos_(bus_, kServiceHello),
        statuses_(bus_, kServiceStatus),
        contacts_(bus_, kContact),
        forecasts_(bus_, kForecast) {}

  /// Returns whether a service of our wire revision was heard.
  bool Run(double seconds) {
    const auto begin = SteadyClock::now();
    while (interrupted == 0 &&
           (seconds == 0 || SteadyClock::now() - begin < std::chrono::duration<double>(seconds))) {
      Read();
      bus_.Wait(100ms);
    }
    return fits_any_;
  }

 private:
  void Read() {
    for (const ServiceHello& hello : hellos_.Take()) Meet(hello);
    // Bytes of another revision are not what they seem: until a hello fits, they stay where they
    // are. Topics have no order between them, so events may come before their service's hello.
    if (!fits_any_) return;
    for (const ServiceStatus& status : statuses_.Take()) {
      if (Fits(status.stamp())) Show(status);
    }
    for (CollisionEvent& event : contacts_.Take()) events_.push_back(std::move(event));
    for (CollisionEvent& event : forecasts_.Take()) {
      // The last forecast of a pair that is in contact repeats the contact.
      const bool is_forecast = event.status() == EVENT_POSSIBLE ||
                               event.status() == EVENT_DISMISSED ||
                               event.status() == EVENT_WITHDRAWN;
      if (is_forecast) events_.push_back(std::move(event));
    }
    ShowEvents();
    if (!last_status_.empty() && statuses_.writers_alive() == 0) Say("no service is heard");
  }

  void Meet(const ServiceHello& hello) {
    const bool fits = hello.wire_revision() == WIRE_REVISION;
    const bool is_new = fits_.emplace(hello.service_id(), fits).second;
    fits_any_ = fits_any_ || fits;
    if (is_new && !fits) {
      std::cerr << "the service speaks wire revision " << hello.wire_revision() << ", this program "
                << WIRE_REVISION << ": nothing else of it is read\n";
    }
  }

  bool Fits(const ServiceStamp& stamp) const {
    const auto found = fits_.find(stamp.service_id());
    return found != fits_.end() && found->second;
  }

  /// Those of a service whose hello has not come yet wait for it.
  void ShowEvents() {
    std::vector<CollisionEvent> waiting;
    for (CollisionEvent& event : events_) {
      if (Fits(event.stamp())) {
        std::cout << EventLine(event) << std::endl;
      } else if (fits_.count(event.stamp().service_id()) == 0) {
        waiting.push_back(std::move(event));
      }
    }
    events_ = std::move(waiting);
  }

  void Show(const ServiceStatus& status) {
    if (status.phase() != PHASE_SERVING) return;  // A standby: not in force.
    std::string text = "serves world " + status.world().to_string() + " in term " +
                       std::to_string(status.stamp().term()) +
                       ", agents: " + std::to_string(status.agents());
    for (const SimulatorStatus& simulator : status.simulators()) {
      text += ", " + simulator.name().to_string() + (simulator.alive() ? "" : " (not alive)");
    }
    for (const KeyValue& extension : status.extensions()) {
      if (extension.key() == "waiting_for") text += ", waits for: " + extension.value().to_string();
    }
    Say(text);
  }

  void Say(const std::string& status) {
    if (status != last_status_) std::cout << "status: " << status << std::endl;
    last_status_ = status;
  }

  Bus bus_;
  Reader<ServiceHelloPubSubType> hellos_;
  Reader<ServiceStatusPubSubType> statuses_;
  Reader<CollisionEventPubSubType> contacts_;
  Reader<CollisionEventPubSubType> forecasts_;
  std::map<std::uint64_t, bool> fits_;  ///< By service_id: whether its wire revision is ours.
  bool fits_any_ = false;
  std::vector<CollisionEvent> events_;  ///< Not shown yet.
  std::string last_status_;
};

int Main(int argc, char** argv) {
  const Options options = ParseOptions(argc, argv, {});
  if (options.help) {
    std::cout << kHelp;
    return 0;
  }
  for (const int signal : {SIGINT, SIGTERM}) {
    std::signal(signal, [](int) { interrupted = 1; });
  }
  if (Monitor(options).Run(options.seconds)) return 0;
  std::cerr << "no service that fits was heard in world \"" << options.world << "\" on domain "
            << options.domain << "\n";
  return kNoService;
}

}  // namespace
}  // namespace example

int main(int argc, char** argv) {
  try {
    return example::Main(argc, argv);
  } catch (const example::UsageError& error) {
    std::cerr << "fast-dds-monitor: " << error.what() << "\n";
    return 2;
  } catch (const std::exception& error) {
    std::cerr << "fast-dds-monitor: " << error.what() << "\n";
    return 1;
  }
}
