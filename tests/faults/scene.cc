#include "tests/faults/scene.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <utility>

#include "server/config/config.h"

namespace collision::faults {

v1::Config LockStepConfig(std::size_t simulators) {
  v1::Config config;
  config.mutable_clock()->set_kind(v1::Clock::SIMULATED);
  config.mutable_clock()->set_simulators_awaited(static_cast<std::uint32_t>(simulators));
  return config;
}

v1::Config WallConfig(double skew_max_s) {
  v1::Config config;
  config.mutable_clock()->set_kind(v1::Clock::WALL);
  config.mutable_clock()->set_skew_max_s(skew_max_s);
  return config;
}

NetworkOptions Perfect(std::uint64_t seed) { return {.seed = seed, .delay_max_ns = 50'000}; }

NetworkOptions Faulty(std::uint64_t seed) {
  return {.seed = seed, .loss = 0.1, .duplicate = 0.1, .delay_max_ns = 5 * kMillisecond};
}

std::vector<Flight> Wanderers(int count, std::int64_t end_ns, Random* random) {
  // Crowded or not: among many all is announced; among few promises are made.
  const bool crowded = random->Chance(0.5);
  std::vector<Flight> flights;
  for (int i = 0; i < count; ++i) {
    const double half_side = crowded ? 4 : 9;
    const server::WanderOptions options{
        .half_side = half_side, .speed = 1.5 * half_side, .acceleration_max = 4};
    Motion motion = server::Wander(options, end_ns, random);
    flights.push_back({.motion = std::move(motion),
                       .radius = random->Uniform(0.4, 1.2),
                       .acceleration_max = options.acceleration_max});
  }
  return flights;
}

Scene::Scene(const v1::Config& config, const NetworkOptions& network)
    : config_(server::CompleteConfig(config)), network_(network) {}

Scene::~Scene() {
  services_.clear();
  std::error_code ignored;
  if (!state_dir_.empty()) std::filesystem::remove_all(state_dir_, ignored);
}

std::string Scene::StateDir() {
  static int count = 0;
  state_dir_ = (std::filesystem::temp_directory_path() /
                ("faults-" + std::to_string(getpid()) + "-" + std::to_string(++count)))
                   .string();
  return state_dir_;
}

ServiceProgram& Scene::AddService(const ServiceOptions& options) {
  services_.push_back(std::make_unique<ServiceProgram>(config_, options, &network_));
  return *services_.back();
}

SimulatorProgram& Scene::AddSimulator(const SimulatorOptions& options,
                                      std::vector<Flight> flights) {
  simulators_.push_back(std::make_unique<SimulatorProgram>(options, std::move(flights), &network_));
  return *simulators_.back();
}

MonitorProgram& Scene::AddMonitor() {
  monitors_.push_back(std::make_unique<MonitorProgram>(&network_));
  return *monitors_.back();
}

void Scene::StartAll() {
  for (const auto& service : services_) service->Start();
  for (const auto& monitor : monitors_) monitor->Start();
  for (const auto& simulator : simulators_) simulator->Start();
}

bool Scene::RunToEnd(std::int64_t limit_ns) {
  const auto over = [this] {
    return std::all_of(simulators_.begin(), simulators_.end(), [](const auto& simulator) {
      return simulator->finished() || simulator->killed();
    });
  };
  while (!over() && network_.now_ns() < limit_ns) {
    network_.Run(network_.now_ns() + kSecond / 10);
  }
  const bool ended = over();
  network_.Run(network_.now_ns() + 5 * kSecond);
  return ended;
}

std::vector<const SimulatorProgram*> Scene::simulators() const {
  std::vector<const SimulatorProgram*> all;
  for (const auto& simulator : simulators_) all.push_back(simulator.get());
  return all;
}

std::int64_t Scene::reached_ns() const {
  std::int64_t least = client::kNever;
  for (const auto& simulator : simulators_) {
    if (!simulator->killed() && !simulator->finished()) {
      least = std::min(least, simulator->reached_ns());
    }
  }
  return least;
}

void Scene::When(std::int64_t reached, std::function<void()> action) {
  if (reached_ns() >= reached) return action();
  network_.After(kMillisecond, [this, reached, action] { When(reached, action); });
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
    options.period_ns = names[i].second * kMillisecond;
    options.on_demand = i < 2;
    options.wall_offset_ns = fleet.wall_offsets_ns[i];
    options.incarnation = static_cast<std::uint32_t>(i + 1);
    scene->AddSimulator(options, Wanderers(fleet.agents, fleet.end_ns, &random));
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
  Report(scene->network().counters(), outcome);
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

void Report(const NetworkCounters& counters, suite::Outcome* outcome) {
  outcome->Add("samples", static_cast<double>(counters.written));
  outcome->Add("lost", static_cast<double>(counters.lost));
  outcome->Add("doubled", static_cast<double>(counters.doubled));
  outcome->Add("overwritten", static_cast<double>(counters.overwritten));
  outcome->Add("rematches", static_cast<double>(counters.rematches));
  outcome->Greatest("waiting_max", static_cast<double>(counters.waiting_max));
}

Judgement Scene::Judged(const JudgeOptions& options, std::size_t monitor) const {
  return Judge(simulators(), *monitors_[monitor], options);
}

void Report(const Judgement& judgement, std::uint64_t seed, suite::Outcome* outcome) {
  const std::string first = judgement.failures.empty() ? "" : judgement.failures.front();
  outcome->Expect(judgement.holds(), "seed " + std::to_string(seed) + ": " + first + ", first of " +
                                         std::to_string(judgement.failures.size()));
  outcome->Add("runs", 1);
  outcome->Add("contacts", static_cast<double>(judgement.contacts));
  outcome->Add("confirmed", static_cast<double>(judgement.confirmed));
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
  outcome->Expect(gaps == 0, where + std::to_string(gaps) + " contacts were not heard");
  outcome->Expect(monitor.contacts_missed() == 0,
                  where + std::to_string(monitor.contacts_missed()) + " contacts count as missed");
  outcome->Expect(monitor.out_of_order() == 0, where + "contacts out of order");
}

}  // namespace collision::faults
