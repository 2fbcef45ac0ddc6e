// What may become of programs: they are killed, stand still, come again, come late, come twice.
#include <functional>

#include "server/config/config.h"
#include "tests/faults/cases/cases.h"
#include "tests/faults/cases/fleet.h"

namespace collision::faults {
namespace {

std::string Seed(std::uint64_t seed) { return "seed " + std::to_string(seed) + ": "; }

void JudgeAll(const Fleet& fleet, const Scene& scene, const MonitorProgram& monitor,
              Outcome* outcome) {
  Report(scene.Judged(), fleet.seed, outcome);
  ExpectAllHeard(monitor, fleet.seed, outcome);
}

/// When in the run something happens, and how long it lasts.
struct Moment {
  std::int64_t at_ns, for_ns;
};

Moment MomentOf(std::uint64_t seed, std::int64_t longest_ns) {
  Random random(seed * 77);
  const auto at = static_cast<std::int64_t>(random.Uniform(1, 8) * 1e9);
  return {at, static_cast<std::int64_t>(random.LogUniform(1e7, static_cast<double>(longest_ns)))};
}

void KillService(const Setting& setting, bool journal, Outcome* outcome) {
  for (int i = 0; i < setting.Many(6, 100); ++i) {
    const auto seed = static_cast<std::uint64_t>(i + 1);
    const Moment moment = MomentOf(seed, 30 * kSecond);
    const Fleet fleet{.network = Faulty(seed), .seed = seed, .keeps_journal = journal};
    const auto scene = MakeScene(fleet);
    Fly(
        fleet, scene.get(),
        [&] {
          scene->When(moment.at_ns, [&] {
            scene->service().Kill();
            scene->network().After(moment.for_ns, [&] { scene->service().Start(); });
          });
        },
        outcome);
    outcome->Expect(scene->monitor().services().size() == 2,
                    Seed(seed) + "the monitor knows of " +
                        std::to_string(scene->monitor().services().size()) + " services");
    JudgeAll(fleet, *scene, scene->monitor(), outcome);
  }
}

void KillServiceWithJournal(const Setting& setting, Outcome* outcome) {
  KillService(setting, true, outcome);
}
void KillServiceWithoutJournal(const Setting& setting, Outcome* outcome) {
  KillService(setting, false, outcome);
}

/// The process of the service stands still, or one of a simulator.
void Suspend(const Setting& setting, bool service, Outcome* outcome) {
  for (int i = 0; i < setting.Many(6, 100); ++i) {
    const auto seed = static_cast<std::uint64_t>(i + 1);
    const Moment moment = MomentOf(seed, 40 * kSecond);
    const Fleet fleet{.network = Faulty(seed), .seed = seed};
    const Fingerprint perfect = PerfectEvents(fleet);
    const auto scene = MakeScene(fleet);
    Fly(
        fleet, scene.get(),
        [&] {
          scene->When(moment.at_ns, [&] {
            const auto go_on = [&] {
              service ? scene->service().Resume() : scene->simulator(i % 3).Resume();
            };
            service ? scene->service().Suspend() : scene->simulator(i % 3).Suspend();
            scene->network().After(moment.for_ns, go_on);
          });
        },
        outcome);
    JudgeAll(fleet, *scene, scene->monitor(), outcome);
    const Fingerprint events{scene->service().events_hash(), scene->service().events_count()};
    outcome->Expect(events == perfect, Seed(seed) + "other events than on a perfect network");
  }
}

void SuspendService(const Setting& setting, Outcome* outcome) { Suspend(setting, true, outcome); }
void SuspendSimulator(const Setting& setting, Outcome* outcome) {
  Suspend(setting, false, outcome);
}

/// Of beta, not yet started.
SimulatorProgram& AddSecondRun(const Fleet& fleet, Scene* scene, Random* random) {
  return scene->AddSimulator({.name = "beta",
                              .run = 5,
                              .incarnation = 12,
                              .period_ns = 250 * kMillisecond,
                              .end_ns = fleet.end_ns,
                              .joins = true},
                             fleet.flights(fleet.agents, fleet.end_ns, random));
}

/// Beta is killed; a second run of it comes, before or after its death is noticed.
void SecondRun(const Setting& setting, Outcome* outcome) {
  for (int i = 0; i < setting.Many(6, 100); ++i) {
    const auto seed = static_cast<std::uint64_t>(i + 1);
    const Moment moment = MomentOf(seed, 10 * kSecond);
    const Fleet fleet{.network = Faulty(seed), .seed = seed};
    const auto scene = MakeScene(fleet);
    SimulatorProgram* second = nullptr;
    Fly(
        fleet, scene.get(),
        [&] {
          scene->When(moment.at_ns, [&] {
            scene->simulator(1).Kill();
            Random random(seed + 1000);
            second = &AddSecondRun(fleet, scene.get(), &random);
            scene->network().After(moment.for_ns, [&] { second->Start(); });
          });
        },
        outcome);
    outcome->Expect(second != nullptr && second->finished(), Seed(seed) + "no second run");
    if (second == nullptr) continue;
    outcome->Add("second_runs_waited", second->waited_for_name() ? 1 : 0);
    JudgeAll(fleet, *scene, scene->monitor(), outcome);
  }
}

/// So many agents that what a new service or a new run has to take in comes in many batches.
Fleet LargeFleet(std::uint64_t seed) {
  Fleet fleet{.network = Faulty(seed), .seed = seed, .agents = 150, .end_ns = 4 * kSecond};
  fleet.config.set_inputs_per_batch_max(16);
  fleet.keeps_journal = seed / 2 % 2 == 0;
  fleet.flights = [](int count, std::int64_t end_ns, Random* random) {
    std::vector<Flight> flights;
    for (int i = 0; i < count; ++i) {
      const server::WanderOptions options{.half_side = 25, .speed = 20, .acceleration_max = 4};
      flights.push_back({.motion = server::Wander(options, end_ns, random),
                         .radius = random->Uniform(0.4, 1.2),
                         .acceleration_max = options.acceleration_max});
    }
    return flights;
  };
  return fleet;
}

/// The service is killed and comes back, or beta is and its second run comes, within the lease or
/// later.
void LargeTakeOver(const Setting& setting, Outcome* outcome) {
  for (int i = 0; i < setting.Many(4, 20); ++i) {
    const auto seed = static_cast<std::uint64_t>(i + 1);
    Random random(seed * 77);
    const auto at_ns = static_cast<std::int64_t>(random.Uniform(0.5, 3) * 1e9);
    const auto for_ns = static_cast<std::int64_t>(random.LogUniform(1e7, 1e10));
    const Fleet fleet = LargeFleet(seed);
    const auto scene = MakeScene(fleet);
    SimulatorProgram* second = nullptr;
    const auto restart_service = [&] {
      scene->service().Kill();
      scene->network().After(for_ns, [&] { scene->service().Start(); });
    };
    const auto restart_beta = [&] {
      scene->simulator(1).Kill();
      second = &AddSecondRun(fleet, scene.get(), &random);
      scene->network().After(for_ns, [&] { second->Start(); });
    };
    Fly(
        fleet, scene.get(),
        [&] { scene->When(at_ns, [&] { i % 2 == 0 ? restart_service() : restart_beta(); }); },
        outcome);
    outcome->Expect(second == nullptr || second->finished(), Seed(seed) + "no second run");
    outcome->Expect((second != nullptr) == (i % 2 == 1), Seed(seed) + "nothing was restarted");
    JudgeAll(fleet, *scene, scene->monitor(), outcome);
  }
  ExpectContacts(4, outcome);
}

/// Another program of beta's name, while beta lives, and killed before beta ends.
void TwoOfOneName(const Setting& setting, Outcome* outcome) {
  for (int i = 0; i < setting.Many(4, 60); ++i) {
    const auto seed = static_cast<std::uint64_t>(i + 1);
    const Fleet fleet{.network = Faulty(seed), .seed = seed};
    const Fingerprint perfect = PerfectEvents(fleet);
    const auto scene = MakeScene(fleet);
    SimulatorProgram* twin = nullptr;
    Fly(
        fleet, scene.get(),
        [&] {
          scene->When(MomentOf(seed, kSecond).at_ns, [&] {
            Random random(seed + 1000);
            twin = &scene->AddSimulator(
                {.name = "beta", .run = 5, .incarnation = 12, .end_ns = fleet.end_ns},
                Wanderers(fleet.agents, fleet.end_ns, &random));
            twin->Start();
            scene->network().After(400 * kMillisecond, [&] { twin->Kill(); });
          });
        },
        outcome);
    outcome->Expect(twin != nullptr && twin->waited_for_name(),
                    Seed(seed) + "the second program was not told that it waits");
    JudgeAll(fleet, *scene, scene->monitor(), outcome);
    const Fingerprint events{scene->service().events_hash(), scene->service().events_count()};
    outcome->Expect(events == perfect, Seed(seed) + "the second program changed the events");
  }
}

/// Beta is killed and does not come back.
void Released(const Setting& setting, Outcome* outcome) {
  for (int i = 0; i < setting.Many(1, 20); ++i) {
    const auto seed = static_cast<std::uint64_t>(i + 1);
    Fleet fleet{.network = Faulty(seed), .seed = seed};
    fleet.config.mutable_clock()->set_on_silent_simulator(v1::Clock::RELEASE);
    const auto scene = MakeScene(fleet);
    Fly(
        fleet, scene.get(),
        [&] { scene->When(MomentOf(seed, kSecond).at_ns, [&] { scene->simulator(1).Kill(); }); },
        outcome);
    outcome->Expect(scene->simulator(0).finished() && scene->simulator(2).finished(),
                    Seed(seed) + "the others were held");
    JudgeAll(fleet, *scene, scene->monitor(), outcome);
  }
}

/// Delta comes in the middle, and so does a second monitor.
void LateJoiners(const Setting& setting, Outcome* outcome) {
  for (int i = 0; i < setting.Many(6, 100); ++i) {
    const auto seed = static_cast<std::uint64_t>(i + 1);
    const Fleet fleet{.network = Faulty(seed), .seed = seed};
    const auto scene = MakeScene(fleet);
    Fly(
        fleet, scene.get(),
        [&] {
          scene->When(MomentOf(seed, kSecond).at_ns, [&] {
            Random random(seed + 1000);
            scene
                ->AddSimulator({.name = "delta",
                                .incarnation = 12,
                                .period_ns = 70 * kMillisecond,
                                .end_ns = fleet.end_ns,
                                .joins = true},
                               Wanderers(fleet.agents, fleet.end_ns, &random))
                .Start();
            scene->AddMonitor().Start();
          });
        },
        outcome);
    outcome->Expect(scene->simulators().size() == 4 && scene->simulator(3).finished(),
                    Seed(seed) + "the late one did not get to its end");
    JudgeAll(fleet, *scene, scene->monitor(), outcome);
    ExpectAllHeard(scene->monitor(1), seed, outcome);
    outcome->Expect(
        scene->monitor(1).contacts().begin()->second == scene->monitor().contacts().begin()->second,
        Seed(seed) + "the late monitor has not heard all contacts");
  }
}

/// What happens to a run with two services; the second one is not started yet.
using Arrange = std::function<void(Scene*, ServiceProgram* second, const Moment&)>;
/// What must be so in the end.
using Check = std::function<void(const Scene&, const ServiceProgram& second, std::uint64_t seed)>;

void FlyWithTwoServices(const Setting& setting, const Arrange& arrange, const Check& check,
                        Outcome* outcome) {
  for (int i = 0; i < setting.Many(6, 100); ++i) {
    const auto seed = static_cast<std::uint64_t>(i + 1);
    const Moment moment = MomentOf(seed, 30 * kSecond);
    const Fleet fleet{.network = Faulty(seed), .seed = seed};
    const auto scene = MakeScene(fleet);
    // Of equal terms the lower id goes first.
    ServiceProgram& second =
        scene->AddService({.state_dir = {}, .instance = i % 2 == 0 ? 100u : 10u});
    scene->StartAll();
    second.Kill();
    scene->When(moment.at_ns, [&] { arrange(scene.get(), &second, moment); });
    outcome->Expect(scene->RunToEnd(600 * kSecond), Seed(seed) + "the run came to no end");
    scene->network().Run(scene->network().now_ns() + 50 * kSecond);
    check(*scene, second, seed);
    ReportProgress(*scene, seed, outcome);
    JudgeAll(fleet, *scene, scene->monitor(), outcome);
  }
}

/// Two services that do not hear each other at first, while all simulators hear both.
void TwoServices(const Setting& setting, Outcome* outcome) {
  const Arrange arrange = [](Scene* scene, ServiceProgram* second, const Moment& moment) {
    second->Start();
    Network& network = scene->network();
    const Network::Id one = scene->service().id(), other = second->id();
    network.Block(one, other);
    network.Block(other, one);
    network.After(moment.for_ns, [&network, one, other] {
      network.Unblock(one, other);
      network.Unblock(other, one);
    });
  };
  const Check check = [&](const Scene& scene, const ServiceProgram& second, std::uint64_t seed) {
    outcome->Expect(scene.service().runs() != second.runs(),
                    Seed(seed) + "not one of the two services was left");
    outcome->Add("second_stayed", second.runs() ? 1 : 0);
  };
  FlyWithTwoServices(setting, arrange, check, outcome);
}

/// A service stands still, another one takes its place, and the first goes on.
void Successor(const Setting& setting, Outcome* outcome) {
  const Arrange arrange = [](Scene* scene, ServiceProgram* second, const Moment& moment) {
    ServiceProgram* first = &scene->service();
    first->Suspend();
    // Not before it counts as gone: beside a live one the second would end.
    scene->network().After(5 * kSecond, [second] { second->Start(); });
    scene->network().After(10 * kSecond + moment.for_ns, [first] { first->Resume(); });
  };
  const Check check = [&](const Scene& scene, const ServiceProgram& second, std::uint64_t seed) {
    outcome->Expect(second.runs(), Seed(seed) + "the successor has not stayed");
    outcome->Expect(!scene.service().runs(), Seed(seed) + "the former service has stayed");
  };
  FlyWithTwoServices(setting, arrange, check, outcome);
}

/// A monitor reads no more while more contacts are published than wait for it.
void MonitorStops(const Setting& setting, Outcome* outcome) {
  for (int i = 0; i < setting.Many(6, 60); ++i) {
    const auto seed = static_cast<std::uint64_t>(i + 1);
    Fleet fleet{.network = Faulty(seed), .seed = seed};
    const std::size_t depth = i % 2 == 0 ? wire::kContactsKept : 2;
    fleet.network.depths[static_cast<std::size_t>(Topic::kContact)].reader = depth;
    const auto scene = MakeScene(fleet);
    MonitorProgram& lazy = scene->AddMonitor();
    Fly(
        fleet, scene.get(),
        [&] {
          scene->When(3 * kSecond, [&] {
            lazy.Stop();
            scene->When(8 * kSecond, [&] { lazy.GoOn(); });
          });
        },
        outcome);
    // With so few the other monitor may lose some, too.
    if (depth > 2) JudgeAll(fleet, *scene, scene->monitor(), outcome);
    std::uint64_t missing = 0;
    for (const Published& published : scene->service().published()) {
      const std::uint64_t number = published.output.collision_event().contacts_sequence();
      if (!lazy.contacts().empty() && number >= *lazy.contacts().begin()->second.begin()) {
        missing += lazy.contacts().begin()->second.contains(number) ? 0 : 1;
      }
    }
    outcome->Expect(lazy.contacts_missed() == missing, Seed(seed) + std::to_string(missing) +
                                                           " contacts are missing, told are " +
                                                           std::to_string(lazy.contacts_missed()));
    outcome->Expect(depth == 2 || missing == 0, Seed(seed) + "contacts are missing");
    outcome->Add("contacts_overwritten", static_cast<double>(missing));
  }
  outcome->Expect(outcome->Get("contacts_overwritten") > 0, "nothing was ever overwritten");
}

}  // namespace

std::vector<Case> ProgramCases() {
  const std::string promise =
      "no contact late or unheard, no promise covers one, brackets hold; all come to their end";
  const std::string same = promise + "; the same events as on a perfect network";
  return {
      {"programs", "journal-killed", promise, KillServiceWithJournal,
       "the service is killed, and started again on its journal after 10 ms to 30 s"},
      {"programs", "service-killed", promise, KillServiceWithoutJournal,
       "the service is killed, and started again without a journal"},
      {"programs", "service-suspended", same, SuspendService,
       "the process of the service stands still for 10 ms to 40 s, longer than every lease"},
      {"programs", "simulator-suspended", same, SuspendSimulator,
       "the process of a simulator stands still for 10 ms to 40 s"},
      {"programs", "second-run", promise, SecondRun,
       "a simulator is killed, and its second run comes after 10 ms to 10 s"},
      {"programs", "large-take-over", promise, LargeTakeOver,
       "450 agents in batches of 16 messages: the service is killed and comes back, or a third of "
       "them and their next run comes, after 10 ms to 10 s"},
      {"programs", "two-of-one-name", same + "; the second one is told", TwoOfOneName,
       "a program takes the name of one that lives"},
      {"programs", "released", promise, Released,
       "a simulator is killed and does not come back (RELEASE)"},
      {"programs", "late-joiners", promise + "; the late monitor hears every contact", LateJoiners,
       "a simulator and a monitor come in the middle of the run"},
      {"programs", "two-services", promise + "; in the end there is one service", TwoServices,
       "a second service is started that hears the first after 10 ms to 30 s, while all "
       "simulators hear both"},
      {"programs", "successor", promise + "; the first service ends when it is back", Successor,
       "the process of the service stands still, after 5 s a second service is started, and 5 to "
       "35 s later the first one goes on"},
      {"programs", "monitor-stops",
       promise + "; what the monitor has not heard, and only that, counts as missed", MonitorStops,
       "a monitor stops reading for 5 s of the world; in every second run only 2 contacts wait "
       "for it"}};
}

}  // namespace collision::faults
