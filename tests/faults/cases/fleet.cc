#include "tests/faults/cases/fleet.h"

#include <array>
#include <string>
#include <utility>

#include "tests/faults/memory.h"

namespace collision::faults {

Fleet WallFleet(std::uint64_t seed) {
  Random random(seed * 31);
  Fleet fleet{.config = WallConfig(1e-9 * static_cast<double>(kSkewNs)),
              .network = Faulty(seed),
              .seed = seed};
  fleet.lock_step = false;
  for (std::int64_t& offset : fleet.wall_offsets_ns) {
    offset = static_cast<std::int64_t>(random.Uniform(-0.9, 0.9) * static_cast<double>(kSkewNs));
  }
  return fleet;
}

JudgeOptions WallJudge() {
  JudgeOptions options;
  options.base_ns = kWallAtStart;
  // A stamp is off by as much as its sender's clock, and so may be what follows from it.
  options.tolerance_ns = 2 * kSkewNs;
  // Until all have arrived, a contact may begin before it can be announced.
  options.unserved = {{0, kSecond}};
  return options;
}

std::unique_ptr<Scene> MakeScene(const Fleet& fleet) {
  v1::Config config = fleet.config;
  // The sooner a contact is announced, the less is promised.
  if (fleet.seed % 3 > 0) config.set_announce_within_s(fleet.seed % 3 == 1 ? 0.1 : 0.5);
  auto scene = std::make_unique<Scene>(config, fleet.network);
  Random random(fleet.seed);
  scene->AddService({.state_dir = fleet.keeps_journal ? scene->StateDir() : std::string()});
  scene->AddMonitor();
  SimulatorOptions options{.lock_step = fleet.lock_step, .end_ns = fleet.end_ns};
  const std::array<std::pair<const char*, std::int64_t>, 3> names = {
      {{"alpha", 100}, {"beta", 250}, {"gamma", 40}}};
  for (std::size_t i = 0; i < names.size(); ++i) {
    options.name = names[i].first;
    options.period_ns = names[i].second * kMillisecond / fleet.pace;
    options.on_demand = !fleet.streams && i < 2;
    options.chunk_size = fleet.chunk_size;
    options.wall_offset_ns = fleet.wall_offsets_ns[i];
    options.incarnation = static_cast<std::uint32_t>(i + 1);
    scene->AddSimulator(options, fleet.flights(fleet.agents, fleet.end_ns, &random));
  }
  return scene;
}

void Fly(const Fleet& fleet, Scene* scene, const std::function<void()>& faults,
         suite::Outcome* outcome) {
  scene->StartAll();
  if (faults) faults();
  const bool ended = scene->RunToEnd(fleet.limit_ns);
  std::string text = "seed " + std::to_string(fleet.seed) + ": the run came to no end:";
  for (const SimulatorProgram* one : scene->simulators()) {
    text += " " + one->options().name + " at " + std::to_string(one->reached_ns());
  }
  outcome->Expect(ended, text);
  ReportProgress(*scene, fleet.seed, outcome, fleet.strangers);
}

Fingerprint PerfectEvents(const Fleet& fleet) {
  Fleet perfect = fleet;
  perfect.network = Perfect(fleet.seed);
  perfect.network.depths = fleet.network.depths;
  const auto scene = MakeScene(perfect);
  scene->StartAll();
  scene->RunToEnd(fleet.limit_ns);
  return {scene->service().events_hash(), scene->service().events_count()};
}

void ReportProgress(const Scene& scene, std::uint64_t seed, suite::Outcome* outcome,
                    std::size_t strangers) {
  ExpectBoundedMemory(scene, seed, strangers, outcome);
  const NetworkCounters& counters = scene.network().counters();
  outcome->Add("samples", static_cast<double>(counters.written));
  outcome->Add("lost", static_cast<double>(counters.lost));
  outcome->Add("doubled", static_cast<double>(counters.doubled));
  outcome->Add("overwritten", static_cast<double>(counters.overwritten));
  outcome->Add("rematches", static_cast<double>(counters.rematches));
  outcome->Greatest("waiting_max", static_cast<double>(counters.waiting_max));
}

void Report(const Judgement& judgement, std::uint64_t seed, suite::Outcome* outcome) {
  const std::string first = judgement.failures.empty() ? "" : judgement.failures.front();
  outcome->Expect(judgement.holds(), "seed " + std::to_string(seed) + ": " + first + ", first of " +
                                         std::to_string(judgement.failures.size()));
  outcome->Add("runs", 1);
  outcome->Add("contacts", static_cast<double>(judgement.contacts));
  outcome->Add("confirmed", static_cast<double>(judgement.confirmed));
  outcome->Add("unserved", static_cast<double>(judgement.unserved));
  outcome->Add("untold", static_cast<double>(judgement.untold));
  outcome->Add("late", static_cast<double>(judgement.late));
  outcome->Add("unheard", static_cast<double>(judgement.unheard));
  outcome->Add("relied_wrongly", static_cast<double>(judgement.relied));
  outcome->Add("promises", static_cast<double>(judgement.promises));
  outcome->Add("brackets_wrong", static_cast<double>(judgement.wrong_brackets + judgement.untrue));
  outcome->Greatest("begin_width_s", judgement.begin_width_s);
}

void ExpectAllHeard(const MonitorProgram& monitor, std::uint64_t seed, suite::Outcome* outcome) {
  const std::string where = "seed " + std::to_string(seed) + ": ";
  std::uint64_t heard = 0, gaps = 0;
  for (const auto& [service, numbers] : monitor.contacts()) {
    heard += numbers.size();
    gaps += *numbers.rbegin() - numbers.size() - (*numbers.begin() - 1);
  }
  outcome->Add("contacts_heard", static_cast<double>(heard));
  outcome->Expect(gaps <= monitor.contacts_repeated(),
                  where + std::to_string(gaps) + " contacts were not heard");
  outcome->Expect(monitor.contacts_missed() == 0,
                  where + std::to_string(monitor.contacts_missed()) + " contacts count as missed");
  outcome->Expect(monitor.out_of_order() == 0, where + "contacts out of order");
}

void FlyAsPerfect(const Fleet& fleet, const std::function<void(Scene*)>& faults,
                  suite::Outcome* outcome) {
  const std::string where = "seed " + std::to_string(fleet.seed) + ": ";
  const Fingerprint perfect = PerfectEvents(fleet);
  const auto scene = MakeScene(fleet);
  Fly(
      fleet, scene.get(),
      [&] {
        if (faults) faults(scene.get());
      },
      outcome);
  Report(scene->Judged(), fleet.seed, outcome);
  ExpectAllHeard(scene->monitor(), fleet.seed, outcome);
  const Fingerprint events{scene->service().events_hash(), scene->service().events_count()};
  outcome->Add("events", static_cast<double>(events.count));
  outcome->Expect(events == perfect, where + "other events than on a perfect network");
  outcome->Expect(scene->service().counter("breaches") == 0,
                  where + "an honest agent counts as a breach");
}

void ExpectContacts(double in_each_run, suite::Outcome* outcome) {
  outcome->Expect(outcome->Get("contacts") >= in_each_run * outcome->Get("runs"),
                  "hardly any contact");
}

}  // namespace collision::faults
