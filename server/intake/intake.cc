#include "server/intake/intake.h"

#include <algorithm>
#include <vector>

namespace collision::server {

Intake::Intake(const v1::Config& config, World* world, detection::Detector* detector,
               Rejections* rejections, ShapeStore* shapes)
    : world_(*world),
      detector_(*detector),
      rejections_(*rejections),
      shapes_(*shapes),
      agent_shapes_(config, world, detector, rejections, shapes),
      agents_(config, world, detector, rejections, &agent_shapes_),
      sender_clocks_(config, world, &agents_) {}

void Intake::Apply(const v1::Input& input) {
  switch (input.message_case()) {
    case v1::Input::kAgentDescription:
      return TakeDescription(input);
    case v1::Input::kAgentStates:
      return TakeStates(input);
    case v1::Input::kSimulatorClock:
      return TakeClock(input);
    case v1::Input::kAgentRemoval:
      return TakeRemoval(input);
    case v1::Input::kLiveliness:
      return TakeLiveliness(input);
    case v1::Input::kShapePart:
      return TakeShapePart(input);
    case v1::Input::kShapeRemoval:
      return TakeShapeRemoval(input);
    case v1::Input::kShapeReady:
      return agent_shapes_.TakeReady(input.shape_ready());
    case v1::Input::MESSAGE_NOT_SET:
      return;
  }
}

Simulator* Intake::Claimed(const v1::Input& input, Refusal where, const std::string* name) {
  const Claim claim = world_.ClaimFor(where.simulator_id, input.sender(), where.run, name);
  if (!claim.accepted) {
    if (claim.may_wait) Hold(*claim.simulator, input);
    where.reason = claim.reason;
    where.field = claim.reason == v1::REJECTED_OLD_RUN ? "run" : "simulator_id";
    where.detail = claim.detail;
    rejections_.Add(where);
    return nullptr;
  }
  if (claim.new_run) {
    agents_.RemoveAll(claim.simulator);
    shapes_.Release(claim.simulator->id());
    claim.simulator->StartRun(input.sender(), where.run);
  }
  claim.simulator->SetSucceededUnheard(false);
  return claim.simulator;
}

void Intake::TakeDescription(const v1::Input& input) {
  const v1::AgentDescription& wire = input.agent_description();
  ++counters_.descriptions_received;
  if (const auto refusal = CheckIdentity(wire)) return rejections_.Add(*refusal);
  Simulator* simulator = Claimed(input, At(wire), &wire.simulator_name());
  if (simulator == nullptr) return;
  simulator->time().RecordDescriptions(wire.sequence());
  const Decoded<detection::AgentDeclaration> decoded = DecodeDescription(wire);
  if (const auto* refusal = std::get_if<Refusal>(&decoded)) return rejections_.Add(*refusal);
  agents_.Describe(simulator, wire, std::get<detection::AgentDeclaration>(decoded));
}

void Intake::TakeStates(const v1::Input& input) {
  const v1::AgentStates& chunk = input.agent_states();
  Simulator* simulator = Claimed(input, At(chunk), nullptr);
  if (simulator == nullptr) return;
  // Refused or not, they have arrived: a clock that waits for them must not wait for ever.
  for (const v1::AgentState& state : chunk.states()) {
    simulator->time().RecordStates(state.sequence());
  }
  if (const auto refusal = CheckChunk(chunk)) return rejections_.Add(*refusal);
  if (const auto refusal = sender_clocks_.Check(*simulator, chunk)) {
    return rejections_.Add(*refusal);
  }
  for (const v1::AgentState& state : chunk.states()) agents_.TakeState(simulator, chunk, state);
}

void Intake::TakeClock(const v1::Input& input) {
  const v1::SimulatorClock& wire = input.simulator_clock();
  ++counters_.clocks_received;
  if (const auto refusal = CheckIdentity(wire)) return rejections_.Add(*refusal);
  Simulator* simulator = Claimed(input, At(wire), &wire.simulator_name());
  if (simulator == nullptr) return;
  sender_clocks_.Take(simulator, wire);
  SimulatorTime& time = simulator->time();
  const Decoded<Instant> decoded = DecodeClock(wire, world_.RulesForClock(*simulator));
  if (const auto* refusal = std::get_if<Refusal>(&decoded)) {
    if (wire.lock_step() != world_.simulated() && time.newest() == Instant::Always()) {
      time.SetOtherKind();
      // With a wall clock, agents are admitted before their simulator tells a clock.
      if (!world_.simulated()) agents_.RemoveAll(simulator);
    }
    return rejections_.Add(*refusal);
  }
  time.Offer({.clock = std::get<Instant>(decoded),
              .states_sequence = wire.states_sequence(),
              .descriptions_sequence = wire.descriptions_sequence(),
              .lock_step = wire.lock_step()});
}

bool Intake::MayRemove(const Simulator& simulator, const v1::Input& input, const Refusal& refusal) {
  // Without a sender, the instance itself has ended.
  if (input.sender() == 0 || simulator.sender() == input.sender()) return true;
  if (world_.succession().Waits(simulator.id(), input.sender())) {
    world_.succession().HoldRemoval(simulator.id(), input);
    CountHeldBytes();
  } else {
    rejections_.Add(refusal);
  }
  return false;
}

void Intake::TakeRemoval(const v1::Input& input) {
  const v1::AgentRemoval& removal = input.agent_removal();
  Simulator* simulator = world_.Find(removal.simulator_id());
  if (simulator == nullptr || !MayRemove(*simulator, input, NotItsOwn(removal))) return;
  agents_.Remove(simulator, removal.slot());
}

void Intake::TakeLiveliness(const v1::Input& input) {
  Simulator* simulator = world_.Find(input.liveliness().simulator_id());
  if (simulator == nullptr) return;
  const bool alive = input.liveliness().alive();
  // Without a sender, the instance of the clock itself has ended: the owner's, if it has a clock.
  const bool deserted = input.sender() == 0 && simulator->time().newest() > Instant::Always();
  if (simulator->sender() != input.sender() && !deserted) {
    // A successor that dies while it waits must not come to life when the owner goes.
    if (!alive) {
      world_.succession().Drop(simulator->id(), input.sender());
      CountHeldBytes();
    }
    return;
  }
  simulator->SetAlive(alive, world_.monotonic_ns());
  // It died while it waited for the id, and the notice came last: no simulator waits for its
  // agents.
  if (!alive && simulator->succeeded_unheard()) agents_.RemoveAll(simulator);
}

void Intake::TakeShapePart(const v1::Input& input) {
  const v1::ShapePart& part = input.shape_part();
  if (Claimed(input, At(part), nullptr) == nullptr) return;
  if (const auto refusal = shapes_.Take(part)) rejections_.Add(*refusal);
}

void Intake::TakeShapeRemoval(const v1::Input& input) {
  const v1::ShapeRemoval& removal = input.shape_removal();
  const Simulator* simulator = world_.Find(removal.simulator_id());
  if (simulator == nullptr || !MayRemove(*simulator, input, NotItsOwn(removal))) return;
  shapes_.Dispose(removal.simulator_id(), removal.content_hash(), removal.part());
}

void Intake::Hold(const Simulator& simulator, const v1::Input& input) {
  if (!shapes_.HasRoomFor(input.shape_part().bytes().size())) return;
  world_.succession().Hold(simulator.id(), input);
  CountHeldBytes();
}

void Intake::HandOver(Simulator* simulator) {
  if (simulator->alive() || !world_.succession().IsAwaited(simulator->id())) return;
  const std::vector<v1::Input> held = world_.succession().Take(simulator->id());
  CountHeldBytes();
  for (const v1::Input& input : held) Apply(input);
  simulator->SetSucceededUnheard(simulator->alive());
}

void Intake::TakeClocks(Simulator* simulator) {
  const bool first = !simulator->time().clock();
  if (!simulator->time().Take()) return;
  if (first) return agents_.AdmitComplete(simulator);
  detector_.SetHeardUntil({simulator->id(), simulator->run()}, *simulator->time().clock());
}

void Intake::EndEpoch() {
  for (auto& [id, simulator] : world_.simulators()) {
    if (!World::LeavesWithEpoch(simulator)) continue;
    TakeClocks(&simulator);
    agents_.RemoveAll(&simulator);
  }
}

void Intake::ExpelAgents() {
  for (auto& [id, simulator] : world_.simulators()) agents_.ExpelAll(&simulator);
}

/// Successors take over at the end of the batch: they may have ended in the same one.
void Intake::EndBatch() {
  for (auto& [id, simulator] : world_.simulators()) {
    HandOver(&simulator);
    TakeClocks(&simulator);
  }
  sender_clocks_.WriteNames();
  agent_shapes_.ReleaseLeft();
  agents_.ReportUndescribed();
  agent_shapes_.ReportMissing();
}

std::optional<std::int64_t> Intake::NextDue() const {
  const std::optional<std::int64_t> state = agents_.NextDue();
  const std::optional<std::int64_t> shape = agent_shapes_.NextDue();
  return state && shape ? std::min(state, shape) : state ? state : shape;
}

}  // namespace collision::server
