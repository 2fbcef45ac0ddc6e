// What the network may do to samples on their way.

#include "tests/faults/cases.h"
#include "tests/faults/scene.h"

namespace collision::faults {
namespace {

constexpr std::int64_t kEnd = 10 * kSecond;

/// What the events of a lock-step run are known by.
struct Fingerprint {
  std::uint64_t hash = 0, count = 0;
  bool operator==(const Fingerprint&) const = default;
};

/// Three simulators with different steps, one of which streams every state.
Fingerprint FlyThree(const NetworkOptions& network, std::uint64_t seed, Outcome* outcome) {
  Scene scene(LockStepConfig(3), network);
  Random random(seed);
  scene.AddService();
  scene.AddMonitor();
  scene.AddSimulator({.name = "alpha", .period_ns = 100 * kMillisecond, .end_ns = kEnd},
                     Wanderers(6, kEnd, &random));
  scene.AddSimulator({.name = "beta", .period_ns = 250 * kMillisecond, .end_ns = kEnd},
                     Wanderers(6, kEnd, &random));
  scene.AddSimulator(
      {.name = "gamma", .period_ns = 40 * kMillisecond, .end_ns = kEnd, .on_demand = false},
      Wanderers(6, kEnd, &random));
  scene.StartAll();
  const bool ended = scene.RunToEnd(600 * kSecond);
  outcome->Expect(ended, "seed " + std::to_string(seed) + ": the run came to no end");
  Report(scene.Judged(), seed, outcome);
  ExpectAllHeard(scene, scene.monitor(), seed, outcome);
  const NetworkCounters& counters = scene.network().counters();
  outcome->Add("samples", static_cast<double>(counters.written));
  outcome->Add("lost", static_cast<double>(counters.lost));
  outcome->Add("doubled", static_cast<double>(counters.doubled));
  outcome->Add("overwritten", static_cast<double>(counters.overwritten));
  outcome->Greatest("waiting_max", static_cast<double>(counters.waiting_max));
  outcome->Expect(scene.service().counter("breaches") == 0, "an honest agent counts as a breach");
  return {scene.service().events_hash(), scene.service().events_count()};
}

void LockStep(const Setting& setting, Outcome* outcome) {
  for (int i = 0; i < setting.Many(3, 60); ++i) {
    const auto seed = static_cast<std::uint64_t>(i + 1);
    const Fingerprint perfect = FlyThree(Perfect(seed), seed, outcome);
    const Fingerprint faulty = FlyThree(Faulty(seed), seed, outcome);
    outcome->Add("events", static_cast<double>(faulty.count));
    outcome->Expect(faulty == perfect,
                    "seed " + std::to_string(seed) + ": other events than on a perfect network");
  }
  outcome->Expect(outcome->Get("contacts") >= 10 * outcome->Get("runs"), "hardly any contact");
}

}  // namespace

std::vector<Case> NetworkCases() {
  return {{"network", "lock-step",
           "no contact late or unheard, no promise covers one, brackets hold; the same events, bit "
           "for bit, as on a perfect network",
           LockStep,
           "a tenth of all transmissions lost, of samples doubled, 0.05 to 5 ms of delay, both "
           "ways"}};
}

}  // namespace collision::faults
