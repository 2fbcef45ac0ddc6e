#include "tests/network/testbed.h"

#include <signal.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <utility>

#include "tests/network/printed_events.h"
#include "tests/system/event_log.h"

namespace collision::network {
namespace {

using std::chrono::seconds;
using std::chrono::steady_clock;

// Worlds of other processes are on other networks.
constexpr int kDomain = 84;
constexpr int kDronesOfEach = 8;
constexpr char kRoundMax[] = "0.5";                  // [s] grant_ahead_max_s
constexpr std::int64_t kRoundMaxNs = 500'000'000;    // the same
constexpr std::int64_t kUntilStart = 8'000'000'000;  // [ns] longer than discovery takes
constexpr std::int64_t kTransit = 200'000'000;       // [ns] of a sample, beside the link's delay
constexpr std::chrono::milliseconds kDrainEvery{50};
constexpr std::chrono::milliseconds kQuiet{700};  // longer than a lost sample takes

constexpr std::size_t kLogShown = 2000;  // [bytes] of each program, where something fails

constexpr const char* kNames[] = {"service", "standby", "alpha", "beta", "monitor", "listener"};

std::string Clock(const TestbedOptions& options) {
  if (options.wall_clock) return "kind: REAL_TIME skew_max_s: 0.002";
  return std::string("simulators_awaited: 2 grant_ahead_max_s: ") + kRoundMax;
}

std::string Config(const TestbedOptions& options) {
  const std::string config = "claim_wait_s: " + std::to_string(options.claim_wait_s) + "\n";
  if (!options.standby) return config;
  return config + "on_occupied: STAND_BY\nlease_s: " + std::to_string(options.lease_s) + "\n";
}

std::int64_t WallNow() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
}

bool IsContact(const v1::CollisionEvent& event) { return event.contacts_sequence() != 0; }

}  // namespace

Testbed::Testbed(const TestbedOptions& options)
    : options_(options),
      lan_(kParties, options.seed),
      world_(kDomain, Clock(options), Config(options)) {
  lan_.SetFaults(options.faults);
  if (options.loss_at_hosts > 0) lan_.LoseAtHosts(options.loss_at_hosts);
  listener_ = std::make_unique<Listener>(
      lan_.host(kListener), system_test::ConfigFile("cyclonedds-lan.xml"),
      client::MonitorOptions{world_.name(), kDomain, true, true});
  Start(kService);
  AwaitLog(kService, "serves world");
  if (options.standby) {
    Start(kStandby);
    AwaitLog(kStandby, "is ready to take over");
  }
  Start(kMonitor);
  start_ns_ = options.wall_clock ? WallNow() + kUntilStart : 0;
  Start(kAlpha);
  Start(kBeta);
}

std::int64_t Testbed::end_ns() const { return start_ns_ + std::llround(options_.seconds * 1e9); }

void Testbed::Start(Party party) {
  world_.MoveTo(lan_.host(party));
  log_read_.at(party) = 0;
  switch (party) {
    case kService:
    case kStandby:
      return StartService(party);
    case kAlpha:
    case kBeta:
      return StartSimulator(party);
    default:
      processes_.at(party) =
          world_.StartMonitor({"events", "--follow", "--json", "--timeout", "60"});
  }
}

void Testbed::StartService(Party party) {
  world_.SetStateFolder(world_.folder().Path(std::string("state-of-") + kNames[party]));
  processes_.at(party) = world_.LaunchDaemon();
}

void Testbed::StartSimulator(Party party) {
  const std::string name = kNames[party];
  const auto drones = std::to_string(kDronesOfEach);
  std::vector<std::string> words = {"--simulator",  name,
                                    "--drones",     drones,
                                    "--first",      party == kAlpha ? "0" : drones,
                                    "--seed",       "2009",
                                    "--box",        "20",
                                    "20",           "8",
                                    "--seconds",    std::to_string(options_.seconds),
                                    "--motion-log", world_.folder().Path(name + ".motion"),
                                    "--linger"};
  if (options_.wall_clock) {
    words.insert(words.end(), {"--real-time", "--start-ns", std::to_string(start_ns_)});
  } else if (options_.speed > 0) {
    words.insert(words.end(), {"--speed", std::to_string(options_.speed)});
  }
  processes_.at(party) = world_.StartProgram("drone-swarm", words);
}

void Testbed::Kill(Party party) {
  process(party).Signal(SIGKILL);
  process(party).WaitForExit();
  processes_.at(party).reset();
}

void Testbed::AwaitLog(Party party, const std::string& text) {
  Process& program = process(party);
  std::size_t& read = log_read_.at(party);
  const auto at = [&] { return program.err().find(text, read); };
  if (!Await([&](const Heard&) { return at() != std::string::npos; })) {
    throw std::runtime_error(std::string(kNames[party]) + " does not say \"" + text + "\"" +
                             Logs());
  }
  read = at() + text.size();
}

std::string Testbed::Logs() const {
  std::string logs;
  for (std::size_t party = 0; party < processes_.size(); ++party) {
    if (!processes_[party]) continue;
    const std::string& log = processes_[party]->err();
    logs += std::string("\n--- ") + kNames[party] + "\n" +
            log.substr(log.size() - std::min(log.size(), kLogShown));
  }
  return logs;
}

void Testbed::DrainOutputs() {
  for (const auto& program : processes_) {
    if (program) program->WaitUntil([] { return false; }, std::chrono::milliseconds(1));
  }
}

bool Testbed::Await(const std::function<bool(const Heard&)>& condition,
                    std::chrono::nanoseconds patience) {
  const auto deadline = steady_clock::now() + patience;
  while (!listener_->WaitUntil(condition, kDrainEvery)) {
    if (steady_clock::now() >= deadline) return false;
    DrainOutputs();
  }
  return true;
}

void Testbed::Pass(std::chrono::nanoseconds time) {
  Await([](const Heard&) { return false; }, time);
}

void Testbed::AwaitQuiet() {
  const auto quiet = kQuiet + std::chrono::duration_cast<std::chrono::nanoseconds>(
                                  std::chrono::duration<double>(4 * options_.faults.delay_max_s));
  std::size_t events = 0;
  const auto more = [&](const Heard& heard) {
    const std::size_t before = std::exchange(events, heard.observations.events.size());
    return events > before;
  };
  const auto deadline = steady_clock::now() + kPatience;
  while (Await(more, quiet)) {
    if (steady_clock::now() >= deadline) throw std::runtime_error("events never end" + Logs());
  }
}

void Testbed::AwaitContacts(std::size_t count) {
  const auto enough = [&](const Heard& heard) {
    const auto& events = heard.observations.events;
    const auto contacts = std::count_if(events.begin(), events.end(), IsContact);
    return static_cast<std::size_t>(contacts) >= count;
  };
  if (!Await(enough)) throw std::runtime_error("there were not so many contacts" + Logs());
}

Flown Testbed::Finish() {
  if (!Await([&](const Heard& heard) { return heard.now_ns >= end_ns(); }))
    throw std::runtime_error("the flight did not come to its end" + Logs());
  AwaitQuiet();
  return FinishNow();
}

/// The judge tells contacts by names, which simulators tell themselves: a listener on a bad network
/// may discover a simulator later than it hears of its contacts.
void Testbed::AwaitNames() {
  const auto knows_drones_of = [](const Heard& heard, Party party) {
    const auto& names = heard.observations.names;
    return kDronesOfEach <= std::count_if(names.begin(), names.end(), [&](const auto& name) {
             return name.simulator() == kNames[party];
           });
  };
  const auto knows_all = [&](const Heard& heard) {
    return knows_drones_of(heard, kAlpha) && knows_drones_of(heard, kBeta);
  };
  if (!Await(knows_all)) throw std::runtime_error("some drones were not described" + Logs());
}

/// The listener has heard them all.
void Testbed::AwaitPrinted() {
  std::uint64_t newest = 0;
  const Heard heard = listener_->heard();
  for (const v1::CollisionEvent& event : heard.observations.events) {
    newest = std::max(newest, event.contacts_sequence());
  }
  if (newest == 0) return;
  const std::string last = "\"contacts_sequence\":" + std::to_string(newest) + ",";
  if (!process(kMonitor).WaitForOutput(last)) {
    throw std::runtime_error("the monitor did not print " + last + Logs());
  }
}

Flown Testbed::FinishNow() {
  AwaitNames();
  Flown flown;
  const auto end = [&](Party party) {
    if (!processes_.at(party)) return;
    process(party).Signal(SIGTERM);
    const auto status = process(party).WaitForExit(seconds(30));
    if (status == 0) return;
    flown.failures.push_back(std::string(kNames[party]) + " ended with status " +
                             (status ? std::to_string(*status) : "none: it still runs") + ": " +
                             Logs());
  };
  end(kAlpha);
  end(kBeta);
  AwaitQuiet();
  AwaitPrinted();
  end(kMonitor);
  flown.printed = ParseEvents(process(kMonitor).out());
  flown.monitor_said = process(kMonitor).err();
  flown.heard = listener_->heard();
  // What a standby says that takes over now does not count.
  end(kStandby);
  end(kService);
  if (processes_.at(kService)) flown.event_log = system_test::EventLogLine(process(kService).err());
  for (const Party party : {kAlpha, kBeta}) {
    std::ifstream log(world_.folder().Path(std::string(kNames[party]) + ".motion"));
    auto motions = checker::ReadMotionLog(log, kNames[party]);
    std::move(motions.begin(), motions.end(), std::back_inserter(flown.motions));
  }
  flown.facts = {.start_ns = start_ns_, .end_ns = end_ns(), .leaving_ns = kRoundMaxNs};
  if (options_.wall_clock) {
    flown.facts.transit_ns = kTransit + std::llround(2e9 * options_.faults.delay_max_s);
  }
  return flown;
}

}  // namespace collision::network
