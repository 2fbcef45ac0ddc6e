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
  config.mutable_clock()->set_kind(v1::Clock::LOCK_STEP);
  config.mutable_clock()->set_simulators_awaited(static_cast<std::uint32_t>(simulators));
  return config;
}

v1::Config WallConfig(double skew_max_s) {
  v1::Config config;
  config.mutable_clock()->set_kind(v1::Clock::REAL_TIME);
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
    : config_(server::CompleteConfig(config)), network_(network) {
  ForgetHeapPeaks();
  for (int i = 0; i < kOwners; ++i) before_[i] = HeapOf(static_cast<Owner>(i)).live;
}

HeapUse Scene::heap(Owner owner) const {
  const HeapUse use = HeapOf(owner);
  const std::int64_t before = before_[static_cast<std::size_t>(owner)];
  return {.live = use.live - before, .peak = use.peak - before};
}

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

Judgement Scene::Judged(const JudgeOptions& options, std::size_t monitor) const {
  return Judge(simulators(), *monitors_[monitor], options);
}

}  // namespace collision::faults
