// What the network may do to samples on their way.
#include "server/config/config.h"
#include "tests/faults/cases/cases.h"
#include "tests/faults/cases/fleet.h"

namespace collision::faults {
namespace {

void LockStep(const Setting& setting, Outcome* outcome) {
  for (int i = 0; i < setting.Many(4, 60); ++i) {
    const auto seed = static_cast<std::uint64_t>(i + 1);
    FlyAsPerfect({.network = Faulty(seed), .seed = seed}, {}, outcome);
  }
  ExpectContacts(4, outcome);
}

/// A batch takes so few messages that clocks, states and descriptions of one step come apart.
void SmallBatches(const Setting& setting, Outcome* outcome) {
  for (int i = 0; i < setting.Many(4, 60); ++i) {
    const auto seed = static_cast<std::uint64_t>(i + 1);
    Fleet fleet{.network = Faulty(seed), .seed = seed};
    fleet.config.set_inputs_per_batch_max(1 + static_cast<std::uint32_t>(i % 4));
    FlyAsPerfect(fleet, {}, outcome);
  }
  ExpectContacts(4, outcome);
}

enum class Way { kBoth, kToService, kFromService };

void Part(Scene* scene, Way way, std::int64_t for_ns) {
  Network& network = scene->network();
  const Network::Id service = scene->service().id(), one = scene->simulator(1).id();
  if (way != Way::kFromService) network.Block(one, service);
  if (way != Way::kToService) network.Block(service, one);
  network.After(for_ns, [=, &network] {
    network.Unblock(one, service);
    network.Unblock(service, one);
  });
}

/// Time waits for the one that is parted from the service.
void Parted(const Setting& setting, Outcome* outcome) {
  const std::int64_t times_ns[] = {kSecond / 2, 5 * kSecond, 30 * kSecond};
  for (int i = 0; i < setting.Many(9, 90); ++i) {
    const auto seed = static_cast<std::uint64_t>(i + 1);
    FlyAsPerfect(
        {.network = Faulty(seed), .seed = seed},
        [&](Scene* scene) {
          scene->When(3 * kSecond,
                      [=] { Part(scene, static_cast<Way>(i / 3 % 3), times_ns[i % 3]); });
        },
        outcome);
  }
  outcome->Expect(outcome->Get("rematches") > 0, "no outage was longer than every lease");
  ExpectContacts(4, outcome);
}

/// The service goes on without the one that is parted from it, and removes it as silent.
void PartedOnTheWallClock(const Setting& setting, Outcome* outcome) {
  constexpr std::int64_t kFrom = 3 * kSecond, kBack = 3 * kSecond;
  const std::int64_t times_ns[] = {kSecond / 2, 7 * kSecond, 25 * kSecond};
  constexpr Way kWays[] = {Way::kBoth, Way::kToService};
  for (int i = 0; i < setting.Many(6, 60); ++i) {
    const auto seed = static_cast<std::uint64_t>(i + 1);
    const std::int64_t time_ns = times_ns[i % 3];
    Fleet fleet = WallFleet(seed);
    fleet.config.mutable_clock()->set_remove_silent_after_s(3);
    fleet.agents = 3;  // Whoever is silent may be anywhere, and all others are held against it.
    fleet.end_ns = kFrom + time_ns + kBack + 6 * kSecond;
    const auto scene = MakeScene(fleet);
    Fly(
        fleet, scene.get(),
        [&] { scene->When(kFrom, [&] { Part(scene.get(), kWays[i / 3 % 2], time_ns); }); },
        outcome);
    JudgeOptions options = WallJudge();
    options.unserved.emplace_back(kFrom, kFrom + time_ns + kBack);
    options.lowered = true;
    Report(scene->Judged(options), seed, outcome);
    ExpectAllHeard(scene->monitor(), seed, outcome);
    outcome->Add("runs_of_it", static_cast<double>(scene->simulator(1).runs().size()));
    outcome->Add("voided", static_cast<double>(scene->simulator(1).voided()));
  }
  outcome->Expect(outcome->Get("runs_of_it") > outcome->Get("runs"),
                  "nobody was removed as silent");
  ExpectContacts(1, outcome);
}

}  // namespace

std::vector<Case> NetworkCases() {
  const std::string events =
      "no contact late or unheard, no promise covers one, brackets hold; the same events, bit for "
      "bit, as on a perfect network";
  return {{"network", "lock-step", events, LockStep,
           "a tenth of all transmissions lost, of samples to the service doubled, 0.05 to 5 ms of "
           "delay, both ways"},
          {"network", "small-batches", events, SmallBatches,
           "the same, and the service takes 1 to 4 messages in a step"},
          {"network", "parted", events, Parted,
           "the same, and a simulator and the service are parted, both ways or one way, for 0.5, 5 "
           "or 30 s: leases are 2 s, of a participant 20 s"},
          {"network", "parted-wall-clock",
           "no contact late or unheard but while they are parted and for 3 s, no promise covers "
           "one; it comes back by itself",
           PartedOnTheWallClock,
           "the same on the wall clock, for 0.5, 7 or 25 s: the service removes who is silent for "
           "3 s"}};
}

}  // namespace collision::faults
