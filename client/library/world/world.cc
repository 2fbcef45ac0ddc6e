#include "collision/world.h"

#include <exception>
#include <stdexcept>
#include <utility>

#include "client/library/network/dds_transport.h"
#include "client/library/validation.h"
#include "client/library/world/world_implementation.h"

namespace collision::client {

World World::Connect(const WorldOptions& options) {
  Validate(options);
  return World(std::make_shared<Implementation>(
      options,
      ConnectSimulator({options.world, options.domain, options.credentials}, options.simulator)));
}

World World::Connect(const WorldOptions& options, std::unique_ptr<Transport> transport) {
  Validate(options);
  return World(std::make_shared<Implementation>(options, std::move(transport)));
}

World::World(std::shared_ptr<Implementation> implementation)
    : implementation_(std::move(implementation)) {}

World::World(World&&) noexcept = default;

World& World::operator=(World&& other) noexcept {
  World replaced(std::exchange(implementation_, std::move(other.implementation_)));
  return *this;
}

World::~World() {
  if (implementation_) implementation_->Close();
}

bool World::WaitForService(std::chrono::nanoseconds timeout) {
  const auto alive = implementation_;  // A callback may end this World.
  return alive->WaitForService(timeout);
}

Agent World::AddAgent(const AgentDescription& description, const State& state) {
  return Agent(implementation_, implementation_->AddAgent(description, state));
}

void World::SetStates(std::span<const Agent> agents, std::span<const State> states) {
  if (agents.size() != states.size()) {
    throw std::invalid_argument("states: " + std::to_string(states.size()) +
                                ", allowed: one for each of the " + std::to_string(agents.size()) +
                                " agents");
  }
  for (std::size_t i = 0; i < agents.size(); ++i) {
    const auto& owner = agents[i].world_;
    if (!owner.owner_before(implementation_) && !implementation_.owner_before(owner)) continue;
    throw std::invalid_argument("agents[" + std::to_string(i) +
                                "]: of another World, or removed, allowed: agents of this World");
  }
  for (std::size_t i = 0; i < agents.size(); ++i) {
    try {
      implementation_->SetState(agents[i].id_, states[i]);
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument("states[" + std::to_string(i) + "]: " + error.what());
    }
  }
}

void World::Publish(std::int64_t clock_ns) { implementation_->Publish(clock_ns); }

Advance World::AdvanceTo(std::int64_t clock_ns, std::chrono::nanoseconds timeout) {
  const auto alive = implementation_;  // A callback may end this World.
  return alive->AdvanceTo(clock_ns, timeout);
}

std::optional<std::int64_t> World::Join(std::chrono::nanoseconds timeout) {
  const auto alive = implementation_;  // A callback may end this World.
  return alive->Join(timeout);
}

void World::Finish() { implementation_->Finish(); }

std::int64_t World::clock_ns() const { return implementation_->clock_ns(); }

std::int64_t World::granted_until_ns() const { return implementation_->granted_until_ns(); }

std::optional<bool> World::world_lock_step() const { return implementation_->world_lock_step(); }

void World::Poll(std::chrono::nanoseconds timeout) {
  const auto alive = implementation_;  // A callback may end this World.
  alive->Poll(timeout);
}

void World::OnEvent(std::function<void(const Event&)> callback) {
  implementation_->OnEvent(std::move(callback));
}

void World::OnClearanceLowered(std::function<void(const AgentId&, const Clearance&)> callback) {
  implementation_->OnClearanceLowered(std::move(callback));
}

void World::OnVoid(std::function<void(const AgentId&, const Clearance&)> callback) {
  implementation_->OnVoid(std::move(callback));
}

void World::OnServiceLost(std::function<void()> callback) {
  implementation_->OnServiceLost(std::move(callback));
}

void World::OnServiceBack(std::function<void()> callback) {
  implementation_->OnServiceBack(std::move(callback));
}

void World::OnWaiting(std::function<void(const std::vector<std::string>&)> callback) {
  implementation_->OnWaiting(std::move(callback));
}

void World::OnNotice(std::function<void(const Notice&)> callback) {
  implementation_->OnNotice(std::move(callback));
}

std::vector<Event> World::TakeEvents() { return implementation_->TakeEvents(); }

std::uint64_t World::events_lost() const { return implementation_->events_lost(); }

std::uint64_t World::contacts_missed() const { return implementation_->contacts_missed(); }

const Traffic& World::traffic() const { return implementation_->traffic(); }

std::string World::Name(const AgentId& id) const { return implementation_->Name(id); }

std::string World::ended_because() const { return implementation_->ended_because(); }
std::string World::waits_for_name() const { return implementation_->waits_for_name(); }

std::vector<Rejection> World::standing_refusals() const {
  return implementation_->standing_refusals();
}

std::vector<Rejection> World::TakeRejections() { return implementation_->TakeRejections(); }

Agent::Agent(std::weak_ptr<World::Implementation> world, const AgentId& id)
    : world_(std::move(world)), id_(id) {}

Agent::Agent(Agent&& other) noexcept : world_(std::exchange(other.world_, {})), id_(other.id_) {}

Agent& Agent::operator=(Agent&& other) noexcept {
  if (this == &other) return *this;
  Remove();
  world_ = std::exchange(other.world_, {});
  id_ = other.id_;
  return *this;
}

Agent::~Agent() { Remove(); }

AgentId Agent::id() const {
  AgentId id = id_;
  if (const auto world = Lock()) id.run = world->run();
  return id;
}

void Agent::SetState(const State& state) {
  if (const auto world = Lock()) world->SetState(id_, state);
}

void Agent::SetDescription(const AgentDescription& description) {
  if (const auto world = Lock()) world->SetDescription(id_, description);
}

Clearance Agent::clearance() const {
  const auto world = Lock();
  return world ? world->clearance(id_) : Clearance();
}

std::shared_ptr<World::Implementation> Agent::Lock() const {
  auto world = world_.lock();
  return world && !world->closed() ? world : nullptr;
}

void Agent::Remove() noexcept {
  try {
    if (const auto world = Lock()) world->RemoveAgent(id_);
  } catch (const std::exception&) {
    // A destructor cannot report it. Without a network the agent stays with the service, as if this
    // process had been killed.
  }
}

}  // namespace collision::client
