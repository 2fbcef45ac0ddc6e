#include "tests/simulation/scenario.h"

#include <stdexcept>
#include <utility>

namespace collision::server {

v1::Config ConfigFor(std::size_t simulators) {
  v1::Config config;
  config.mutable_clock()->set_kind(v1::Clock::LOCK_STEP);
  config.mutable_clock()->set_simulators_awaited(static_cast<std::uint32_t>(simulators));
  return CompleteConfig(config);
}

std::vector<SimulatedAgent> Crowd(int count, std::int64_t end_ns, Random* random) {
  std::vector<SimulatedAgent> agents;
  for (int i = 0; i < count; ++i) {
    const WanderOptions options{
        .half_side = 5.5, .speed = 6, .acceleration_max = 4, .jumps_per_piece = 0.02};
    SimulatedAgent agent{.radius = random->Uniform(0.5, 1.2),
                         .acceleration_max = options.acceleration_max,
                         .motion = Wander(options, end_ns, random),
                         .position_error = i % 2 == 0 ? 0.3 : 0};
    const auto moment = static_cast<std::int64_t>(random->Below(end_ns));
    if (i % 3 == 1) agent.from_ns = moment;
    if (i % 3 == 2) agent.until_ns = moment;
    agents.push_back(agent);
  }
  return agents;
}

void AddCrowds(std::int64_t end_ns, Scenario* scenario) {
  Random random(42);
  scenario->Add({.name = "alpha", .sender = 1, .period_ns = 120'000'000, .end_ns = end_ns},
                Crowd(16, end_ns, &random));
  scenario->Add(
      {.name = "beta", .sender = 2, .period_ns = 300'000'000, .end_ns = end_ns, .chunk_size = 8},
      Crowd(16, end_ns, &random));
}

NetworkOptions Lossy(std::uint64_t seed) {
  return {.seed = seed, .loss = 0.05, .duplicate = 0.05, .delay_max_ns = 3'000'000};
}

Scenario::Scenario(const v1::Config& config, const NetworkOptions& network)
    : config_(config), network_(network), clock_(&network_) {}

SimulatedSimulator& Scenario::Add(const SimulatorOptions& options,
                                  std::vector<SimulatedAgent> agents) {
  simulators_.push_back(
      std::make_unique<SimulatedSimulator>(options, std::move(agents), &network_));
  return *simulators_.back();
}

void Scenario::StartService(BatchSink* recorder, std::unique_ptr<ShapeBuilder> shape_builder,
                            FlightSink* flight) {
  earlier_ = published();
  daemon_.reset();
  bus_.reset();
  bus_ = std::make_unique<SimulatedBus>(&network_);
  daemon_ = std::make_unique<Daemon>(
      config_, *bus_, clock_,
      DaemonParts{
          .recorder = recorder, .flight = flight, .shape_builder = std::move(shape_builder)});
}

void Scenario::StartSimulators() {
  for (const auto& simulator : simulators_) simulator->Start();
}

void Scenario::Run(std::int64_t until_ns) {
  while (network_.now_ns() < until_ns && daemon_->Step()) {
  }
}

std::vector<v1::Output> Scenario::published() const {
  std::vector<v1::Output> all = earlier_;
  if (bus_) all.insert(all.end(), bus_->published().begin(), bus_->published().end());
  return all;
}

std::vector<v1::CollisionEvent> Scenario::events() const {
  std::vector<v1::CollisionEvent> events;
  for (const v1::Output& output : published()) {
    if (output.has_collision_event()) events.push_back(output.collision_event());
  }
  return events;
}

v1::ServiceStatus Scenario::status() const {
  const auto& outputs = bus_->published();
  for (auto output = outputs.rbegin(); output != outputs.rend(); ++output) {
    if (output->has_service_status()) return output->service_status();
  }
  throw std::logic_error("no status was published");
}

std::uint64_t Scenario::counter(const std::string& name) const {
  const v1::ServiceStatus newest = status();
  for (const v1::Counter& counter : newest.counters()) {
    if (counter.name() == name) return counter.value();
  }
  throw std::logic_error("no counter " + name);
}

std::vector<const SimulatedSimulator*> Scenario::simulators() const {
  std::vector<const SimulatedSimulator*> all;
  for (const auto& simulator : simulators_) all.push_back(simulator.get());
  return all;
}

}  // namespace collision::server
