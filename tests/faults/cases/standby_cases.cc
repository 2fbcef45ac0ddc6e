// Two services, one of which stands by: nothing is lost, nothing is told twice.
#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <tuple>

#include "tests/faults/cases/cases.h"
#include "tests/faults/cases/fleet.h"

namespace collision::faults {
namespace {

std::string Seed(std::uint64_t seed) { return "seed " + std::to_string(seed) + ": "; }

constexpr std::int64_t kLease = 100 * kMillisecond;  // of a service by wall clocks
constexpr std::int64_t kTold = 50 * kMillisecond;    // after it a standby is heard

/// What a reader was told of contacts: pair, number of its contact, status.
using Told = std::multiset<std::tuple<std::string, std::string, std::uint32_t, int>>;

/// A contact that is confirmed again with a bracket of less than half the width is not told twice.
/// A standby that joins late counts from where it joins, and its numbers count only as far as
/// readers know them.
Told ToldTo(const MonitorProgram& monitor, bool numbered) {
  Told told;
  std::map<Told::value_type, std::int64_t> widths;  // of the begin of what is confirmed
  for (const MonitoredEvent& heard : monitor.heard()) {
    const v1::CollisionEvent& event = heard.event;
    if (event.contacts_sequence() == 0) continue;
    const auto one =
        std::tuple(event.lower().SerializeAsString(), event.higher().SerializeAsString(),
                   event.contact(), static_cast<int>(event.status()));
    if (event.status() == v1::EVENT_CONFIRMED) {
      const std::int64_t width = event.begin().latest_ns() - event.begin().earliest_ns();
      const auto [known, is_first] = widths.try_emplace(one, width);
      const bool is_narrower = 2 * width < known->second;
      known->second = std::min(known->second, width);
      if (!is_first && is_narrower) continue;
    }
    told.insert({std::get<0>(one), std::get<1>(one), numbered ? event.contact() : 0,
                 static_cast<int>(event.status())});
  }
  return told;
}

/// How a run with a standby goes on after it has begun.
using Arrange = void (*)(Scene*, std::int64_t for_ns);

struct Run {
  std::unique_ptr<Scene> scene;
  bool joined_late = false;   ///< The standby came in the middle of the run.
  std::int64_t fault_ns = 0;  ///< When the fault happened, in virtual time.
};

/// The standby comes with the others, or in every third run at 1 s.
Run FlyWithStandby(Fleet fleet, Arrange arrange, std::int64_t longest_ns, Outcome* outcome) {
  Random random(fleet.seed * 77);
  const auto at_ns = static_cast<std::int64_t>(random.Uniform(2, 8) * 1e9);
  const auto for_ns =
      static_cast<std::int64_t>(random.LogUniform(1e7, static_cast<double>(longest_ns)));
  fleet.config.set_on_occupied(v1::Config::STAND_BY);
  Run run{.scene = MakeScene(fleet), .joined_late = fleet.seed % 3 == 0};
  Scene* const scene = run.scene.get();
  // The lower id serves.
  ServiceProgram& second = scene->AddService({.state_dir = {}, .instance = 100});
  scene->StartAll();
  if (run.joined_late) {
    second.Kill();
    scene->When(kSecond, [&second] { second.Start(); });
  }
  scene->When(at_ns, [&] {
    run.fault_ns = scene->network().now_ns();
    arrange(scene, for_ns);
  });
  outcome->Expect(scene->RunToEnd(fleet.limit_ns), Seed(fleet.seed) + "the run came to no end");
  ReportProgress(*scene, fleet.seed, outcome);
  return run;
}

const ServiceProgram& Serving(const Scene& scene) {
  const bool first = scene.service(0).runs() &&
                     scene.service(0).daemon().claim().phase() == server::ClaimPhase::kServing;
  return scene.service(first ? 0 : 1);
}

void Judge(const Fleet& fleet, const Run& run, const JudgeOptions& options, Outcome* outcome) {
  const Scene& scene = *run.scene;
  Report(scene.Judged(options), fleet.seed, outcome);
  ExpectAllHeard(scene.monitor(0), fleet.seed, outcome);
  outcome->Add("take_overs", static_cast<double>(scene.monitor(0).services().size()) - 1);
  outcome->Add("repeated", static_cast<double>(scene.monitor(0).contacts_repeated()));
  outcome->Expect(Serving(scene).runs() &&
                      Serving(scene).daemon().claim().phase() == server::ClaimPhase::kServing,
                  Seed(fleet.seed) + "nobody serves");
}

/// In lock-step both services find the same events, and the monitor hears of the same contacts,
/// however often the other one takes over.
void FlyInLockStep(const Setting& setting, Arrange arrange, Outcome* outcome) {
  for (int i = 0; i < setting.Many(6, 100); ++i) {
    const auto seed = static_cast<std::uint64_t>(i + 1);
    Fleet fleet{.network = Faulty(seed), .seed = seed};
    // What is lost may be replaced before it is sent again, which nobody waits for but the service
    // in force.
    const bool loses = i % 2 == 1;
    if (!loses) fleet.network.loss = 0;
    Fleet alone = fleet;
    alone.network = Perfect(seed);
    const auto perfect = MakeScene(alone);
    perfect->StartAll();
    perfect->RunToEnd(fleet.limit_ns);
    const Run run = FlyWithStandby(fleet, arrange, 30 * kSecond, outcome);
    Judge(fleet, run, {}, outcome);
    if (loses) continue;
    const Told told = ToldTo(run.scene->monitor(0), !run.joined_late);
    const Told wanted = ToldTo(perfect->monitor(0), !run.joined_late);
    outcome->Add("contacts_told", static_cast<double>(told.size()));
    outcome->Expect(told == wanted, Seed(seed) + std::to_string(told.size()) +
                                        " contacts were told, by one service without faults " +
                                        std::to_string(wanted.size()));
    // Simulators write once more what a service that takes over may not have.
    if (run.joined_late || run.scene->monitor(0).services().size() > 1) continue;
    for (std::size_t one = 0; one < 2; ++one) {
      outcome->Expect(run.scene->service(one).events_hash() == perfect->service().events_hash(),
                      Seed(seed) + "other events than of one service without faults");
      outcome->Add("same_events", 1);
    }
  }
  outcome->Expect(outcome->Get("take_overs") > 0, "no standby ever took over");
}

void FlyByWallClock(const Setting& setting, Arrange arrange, Outcome* outcome) {
  for (int i = 0; i < setting.Many(6, 100); ++i) {
    const auto seed = static_cast<std::uint64_t>(i + 1);
    Fleet fleet = WallFleet(seed);
    fleet.network.liveliness_lease_ns = kLease;
    fleet.config.set_lease_s(1e-9 * kLease);
    const Run run = FlyWithStandby(fleet, arrange, 5 * kSecond, outcome);
    // While nobody serves, nobody can announce.
    JudgeOptions options = WallJudge();
    options.unserved.emplace_back(run.fault_ns, run.fault_ns + kLease + kTold);
    Judge(fleet, run, options, outcome);
  }
  outcome->Expect(outcome->Get("take_overs") > 0, "no standby ever took over");
}

void Kill(Scene* scene, std::int64_t for_ns) {
  ServiceProgram* const first = &scene->service(0);
  first->Kill();
  scene->network().After(for_ns, [first] { first->Start(); });
}

void Suspend(Scene* scene, std::int64_t for_ns) {
  ServiceProgram* const first = &scene->service(0);
  first->Suspend();
  scene->network().After(for_ns, [first] { first->Resume(); });
}

/// The two do not hear each other, while the simulators hear both.
void Part(Scene* scene, std::int64_t for_ns) {
  Network* const network = &scene->network();
  const Network::Id one = scene->service(0).id(), other = scene->service(1).id();
  network->Block(one, other);
  network->Block(other, one);
  network->After(for_ns, [=] {
    network->Unblock(one, other);
    network->Unblock(other, one);
  });
}

void KilledInLockStep(const Setting& setting, Outcome* outcome) {
  FlyInLockStep(setting, Kill, outcome);
}
void SuspendedInLockStep(const Setting& setting, Outcome* outcome) {
  FlyInLockStep(setting, Suspend, outcome);
}
void PartedInLockStep(const Setting& setting, Outcome* outcome) {
  FlyInLockStep(setting, Part, outcome);
}
void KilledByWallClock(const Setting& setting, Outcome* outcome) {
  FlyByWallClock(setting, Kill, outcome);
}
void SuspendedByWallClock(const Setting& setting, Outcome* outcome) {
  FlyByWallClock(setting, Suspend, outcome);
}

}  // namespace

std::vector<Case> StandbyCases() {
  const std::string promise =
      "no contact late or unheard, no promise covers one, brackets hold; all come to their end";
  const std::string same =
      promise + "; each contact is told once; until one takes over, both find the same events";
  return {{"standby", "killed", same, KilledInLockStep,
           "beside a standby the service is killed, and comes back after 10 ms to 30 s"},
          {"standby", "suspended", same, SuspendedInLockStep,
           "beside a standby the process of the service stands still for 10 ms to 30 s"},
          {"standby", "parted", same, PartedInLockStep,
           "service and standby do not hear each other for 10 ms to 30 s, simulators hear both"},
          {"standby", "killed-wall-clock", promise, KilledByWallClock,
           "the same by wall clocks: killed, and back after 10 ms to 5 s"},
          {"standby", "suspended-wall-clock", promise, SuspendedByWallClock,
           "the same by wall clocks: it stands still for 10 ms to 5 s"}};
}

}  // namespace collision::faults
