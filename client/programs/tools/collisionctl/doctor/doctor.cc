#include "client/programs/tools/collisionctl/doctor/doctor.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <iostream>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <thread>
#include <vector>

#include "client/library/deadline.h"
#include "client/library/network/message_monitor.h"
#include "client/library/notices/notices.h"
#include "client/programs/shared/exit_code.h"
#include "client/programs/shared/world_view.h"
#include "client/programs/tools/collisionctl/doctor/findings.h"
#include "idl/dds/headroom.h"
#include "idl/dds/network_log.h"
#include "idl/limits.h"

namespace collision::client {
namespace {

using std::chrono::milliseconds;

/// Programs are found within about a second of a participant's birth.
constexpr milliseconds kDiscovery{1500};
constexpr milliseconds kPause{50};

/// A third of all domains; with fewer than the other it would take minutes.
constexpr std::uint32_t kDomainsAtOnce = 77, kDomainsAtOnceMin = 8;

/// Of a participant in a domain of its own, which takes 0.2 MB besides.
constexpr std::size_t kThreadsOfADomain = 6;

std::chrono::nanoseconds Seconds(double seconds) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
      std::chrono::duration<double>(seconds));
}

bool Serves(const DdsNeighbours& neighbours, const std::string& world) {
  const std::vector<std::string> worlds = WorldsServed(neighbours);
  return std::ranges::count(worlds, world) > 0;
}

/// Looks until `enough`, at most as long as discovery takes.
template <class Enough>
DdsNeighbours LookUntil(const DdsLookout& lookout, Enough enough) {
  const Deadline deadline{kDiscovery};
  DdsNeighbours seen = lookout.Look();
  while (!enough(seen) && deadline.Remaining().count() > 0) {
    std::this_thread::sleep_for(kPause);
    seen = lookout.Look();
  }
  return seen;
}

/// The other domains in which the world is served.
std::vector<std::uint32_t> LookElsewhere(const DoctorOptions& options) {
  std::vector<std::uint32_t> served;
  dds::SetNetworkLog([](const std::string&) {});  // of domains that nobody asked for
  const std::size_t threads = dds::ThreadsToBeHad(kDomainsAtOnce * kThreadsOfADomain);
  const auto at_once = static_cast<std::uint32_t>(threads / kThreadsOfADomain);
  if (at_once < kDomainsAtOnceMin) {
    std::cerr << "collisionctl: other domains are not looked into: only " << threads
              << " threads can be started here\n";
    return served;
  }
  for (std::uint32_t first = 0; first <= wire::kDomainMax; first += at_once) {
    std::vector<std::pair<std::uint32_t, DdsLookout>> lookouts;
    const std::uint32_t end = std::min(first + at_once, wire::kDomainMax + 1);
    for (std::uint32_t domain = first; domain < end; ++domain) {
      if (domain == options.domain) continue;
      try {
        lookouts.emplace_back(domain, DdsLookout(domain, options.credentials, options.world));
      } catch (const std::runtime_error&) {
        continue;  // a port of the domain is in use by another kind of program
      }
    }
    std::this_thread::sleep_for(kDiscovery);
    for (const auto& [domain, lookout] : lookouts) {
      if (Serves(lookout.Look(), options.world)) served.push_back(domain);
    }
  }
  dds::SetNetworkLog(nullptr);
  return served;
}

/// The network profile with a host that is asked by unicast, at each port at which a participant of
/// the domain may listen for others. Source: DDSI-RTPS 2.3, 9.6.1.
std::string ProfileWith(const std::string& host, std::uint32_t domain) {
  constexpr std::uint32_t kParticipants = 33;
  const std::uint32_t base = FirstPortOf(domain);
  std::string peers = "<Peer Address=\"" + host + ":" + std::to_string(base) + "\"/>";
  for (std::uint32_t i = 0; i < kParticipants; ++i)
    peers += "<Peer Address=\"" + host + ":" + std::to_string(base + 10 + 2 * i) + "\"/>";
  const char* profile = std::getenv("CYCLONEDDS_URI");
  const std::string before =
      profile == nullptr || *profile == '\0' ? "" : profile + std::string(",");
  return before + "<CycloneDDS><Domain Id=\"any\"><Discovery><Peers>" + peers +
         "</Peers></Discovery></Domain></CycloneDDS>";
}

/// The profile is read when a process has its first participant in a domain: there is none now.
bool AnswersByUnicast(const DoctorOptions& options) {
  setenv("CYCLONEDDS_URI", ProfileWith(options.host, options.domain).c_str(), 1);
  const DdsLookout lookout(options.domain, options.credentials, options.world);
  const auto serves = [&](const DdsNeighbours& seen) { return Serves(seen, options.world); };
  return serves(LookUntil(lookout, serves));
}

/// What the world tells until it is known, or the time is over.
void Listen(const DoctorOptions& options, WorldView* view, DoctorSeen* seen) {
  const DdsLookout lookout(options.domain, options.credentials, options.world);
  MessageMonitor monitor({.world = options.world,
                          .domain = options.domain,
                          .simulators = true,
                          .credentials = options.credentials},
                         view->Callbacks());
  const Deadline deadline(
      std::max<std::chrono::nanoseconds>(Seconds(options.timeout_s), kDiscovery));
  const Deadline discovery{kDiscovery};
  while (deadline.Remaining().count() > 0) {
    monitor.Poll(std::min<std::chrono::nanoseconds>(kPause, deadline.Remaining()));
    if (discovery.Remaining().count() > 0) continue;
    const bool is_known = view->status() && view->knows_all_agents();
    // Nobody comes any more where nobody is found by then.
    const bool is_there = monitor.unreadable().empty() && Serves(lookout.Look(), options.world);
    if (is_known || !is_there) break;
  }
  seen->neighbours = lookout.Look();
  seen->unreadable = monitor.unreadable();
}

/// All that there is to be seen.
DoctorSeen Look(const DoctorOptions& options, WorldView* view) {
  DoctorSeen seen{.world = options.world,
                  .domain = options.domain,
                  .waited_s = options.timeout_s,
                  .interfaces = InterfacesThatAreUp(),
                  .host = options.host,
                  .has_credentials = !options.credentials.empty()};
  seen.own_address = OwnDdsAddress(options.domain);
  Listen(options, view, &seen);
  if (!Serves(seen.neighbours, options.world)) {
    if (!options.host.empty()) seen.host_answers = AnswersByUnicast(options);
    if (!options.credentials.empty()) {
      const DdsLookout lookout(options.domain);
      const auto serves = [&](const DdsNeighbours& all) { return Serves(all, options.world); };
      seen.without_credentials = LookUntil(lookout, serves);
    }
    const bool others = !WorldsServed(seen.neighbours).empty();
    if (!seen.host_answers && !others) seen.elsewhere = LookElsewhere(options);
  }
  return seen;
}

/// The same where DDS is available; otherwise why it is not.
DoctorSeen LookIfPossible(const DoctorOptions& options, WorldView* view) {
  std::mutex mutex;
  std::string said;
  dds::SetNetworkLog([&](const std::string& line) {
    const std::lock_guard lock(mutex);
    if (said.find(line) == std::string::npos) said += (said.empty() ? "" : "; ") + line;
  });
  DoctorSeen seen;
  try {
    seen = Look(options, view);
  } catch (const std::runtime_error& error) {
    const char* profile = std::getenv("CYCLONEDDS_URI");
    seen = {.world = options.world,
            .domain = options.domain,
            .failure = error.what(),
            .profile = profile == nullptr ? "" : profile,
            .interfaces = InterfacesThatAreUp()};
  }
  dds::SetNetworkLog(nullptr);
  if (seen.failure.empty() && !said.empty()) std::cerr << "collisionctl: " << said << '\n';
  seen.failure_lines = said;
  return seen;
}

}  // namespace

CLI::App* AddDoctorCommand(CLI::App* app, DoctorOptions* options) {
  CLI::App* command =
      app->add_subcommand("doctor", "Why a world is silent or in trouble, and what to type next");
  command
      ->add_option("--host", options->host,
                   "IPv4 address of the service's host: it is asked by unicast, too")
      ->check(CLI::ValidIPV4);
  return command;
}

int RunDoctor(const DoctorOptions& options) {
  std::cerr << "collisionctl: " << PlaceText(options.world, options.domain) << '\n';
  WorldView view;
  const DoctorSeen seen = LookIfPossible(options, &view);
  const std::vector<Finding> findings = Findings(seen, view);
  if (options.json) {
    std::cout << DoctorJson(findings) << std::endl;
  } else {
    std::cout << DoctorPage(seen, view, findings) << std::flush;
  }
  if (!std::cout) return kExitOutputFailed;
  if (!seen.failure.empty()) return kExitUnavailable;
  return IsWell(findings) ? kExitOk : kExitRefused;
}

}  // namespace collision::client
