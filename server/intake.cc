#include "server/intake.h"

#include <algorithm>
#include <utility>

namespace collision::server {

Intake::Intake(const v1::Config& config, World* world, detection::Detector* detector,
               Rejections* rejections, ShapeStore* shapes)
    : agents_max_(config.agents_max()),
      undescribed_after_ns_(ToNanoseconds(config.undescribed_after_s())),
      world_(*world),
      detector_(*detector),
      rejections_(*rejections),
      shapes_(*shapes) {}

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
      return TakeShapeReady(input.shape_ready());
    case v1::Input::MESSAGE_NOT_SET:
      return;
  }
}

Simulator* Intake::Claimed(const v1::Input& input, Refusal where, const std::string* name) {
  const Claim claim = world_.ClaimFor(where.simulator_id, input.sender(), where.run, name);
  if (!claim.accepted) {
    if (claim.may_wait) Hold(claim.simulator, input);
    where.reason = claim.reason;
    where.field = claim.reason == v1::REJECTED_OLD_RUN ? "run" : "simulator_id";
    where.detail = claim.detail;
    Refuse(where);
    return nullptr;
  }
  if (claim.new_run) {
    RemoveAgents(claim.simulator);
    shapes_.Release(claim.simulator->id);
    claim.simulator->StartRun(input.sender(), where.run);
  }
  claim.simulator->taken_over = false;
  return claim.simulator;
}

void Intake::TakeDescription(const v1::Input& input) {
  const v1::AgentDescription& wire = input.agent_description();
  ++counters_.descriptions_received;
  if (const auto refusal = CheckIdentity(wire)) return Refuse(*refusal);
  Simulator* simulator = Claimed(input, At(wire), &wire.simulator_name());
  if (simulator == nullptr) return;
  simulator->descriptions_seen = std::max(simulator->descriptions_seen, wire.sequence());
  const Decoded<motion::AgentDeclaration> decoded = DecodeDescription(wire);
  if (const auto* refusal = std::get_if<Refusal>(&decoded)) return Refuse(*refusal);
  Describe(simulator, wire, std::get<motion::AgentDeclaration>(decoded));
}

void Intake::Describe(Simulator* simulator, const v1::AgentDescription& wire,
                      const motion::AgentDeclaration& declaration) {
  Slot& slot = simulator->slots[wire.slot()];
  if (wire.generation() < slot.generations_over) return;
  if (Simulator::Describes(slot, wire.generation())) {
    Agent& agent = *slot.agent;
    if (wire.revision() <= agent.revision) return;
    agent.revision = wire.revision();
    agent.declaration = declaration;
    ReferTo(ShapeHashOf(wire), simulator, wire.slot(), &agent);
    simulator->chunks_changed.insert(wire.slot() / kSlotsPerChunk);
    if (agent.admitted) {
      detector_.Redeclare(simulator->IdOf(wire.slot(), agent.generation), agent.declaration,
                          world_.EffectiveFrom(agent.stamp));
    }
    return;
  }
  if (slot.agent) RemoveAgent(simulator, wire.slot());
  slot.generations_over = wire.generation();
  slot.agent = Agent{
      .generation = wire.generation(), .revision = wire.revision(), .declaration = declaration};
  ReferTo(ShapeHashOf(wire), simulator, wire.slot(), &*slot.agent);
  ++simulator->agents;
  AdmitIfComplete(simulator, wire.slot());
}

void Intake::TakeStates(const v1::Input& input) {
  const v1::AgentStates& chunk = input.agent_states();
  Simulator* simulator = Claimed(input, At(chunk), nullptr);
  if (simulator == nullptr) return;
  // Refused or not, they have arrived: a clock that waits for them must not wait for ever.
  for (const v1::AgentState& state : chunk.states()) {
    simulator->states_seen = std::max(simulator->states_seen, state.sequence());
  }
  if (const auto refusal = CheckChunk(chunk)) return Refuse(*refusal);
  for (const v1::AgentState& state : chunk.states()) TakeState(simulator, chunk, state);
}

void Intake::TakeState(Simulator* simulator, const v1::AgentStates& chunk,
                       const v1::AgentState& wire) {
  ++counters_.states_received;
  if (const auto refusal = CheckSlot(chunk, wire)) return Refuse(*refusal);
  Slot& slot = simulator->slots[wire.slot()];
  if (wire.generation() < slot.generations_over) {
    ++counters_.states_older;
    return;
  }
  const std::pair<std::uint32_t, std::uint64_t> order(wire.generation(), wire.sequence());
  if (slot.handled && order <= *slot.handled) {
    ++counters_.states_repeated;
    return;
  }
  slot.handled = order;
  const bool described = Simulator::Describes(slot, wire.generation());
  const bool admitted = described && slot.agent->admitted;
  const Decoded<motion::MotionState> decoded =
      DecodeState(chunk, wire, world_.RulesForState(*simulator, admitted));
  if (const auto* refusal = std::get_if<Refusal>(&decoded)) return Refuse(*refusal);
  const motion::MotionState& state = std::get<motion::MotionState>(decoded);
  if (admitted) {
    UpdateAgent(simulator, wire.slot(), &*slot.agent, wire.sequence(), state);
  } else {
    KeepWaiting(simulator, wire.slot(), {wire.generation(), wire.sequence(), state});
  }
}

void Intake::TakeClock(const v1::Input& input) {
  const v1::SimulatorClock& wire = input.simulator_clock();
  ++counters_.clocks_received;
  if (const auto refusal = CheckIdentity(wire)) return Refuse(*refusal);
  Simulator* simulator = Claimed(input, At(wire), &wire.simulator_name());
  if (simulator == nullptr) return;
  const Decoded<Instant> decoded = DecodeClock(wire, world_.RulesForClock(*simulator));
  if (const auto* refusal = std::get_if<Refusal>(&decoded)) {
    // With a wall clock its agents need not have waited for it.
    if (wire.lock_step() != world_.simulated() && simulator->told == Instant::Always()) {
      simulator->other_time = true;
      if (!world_.simulated()) RemoveAgents(simulator);
    }
    return Refuse(*refusal);
  }
  simulator->other_time = false;
  simulator->OfferClock({.clock = std::get<Instant>(decoded),
                         .states_sequence = wire.states_sequence(),
                         .descriptions_sequence = wire.descriptions_sequence(),
                         .lock_step = wire.lock_step()});
}

void Intake::TakeRemoval(const v1::Input& input) {
  const v1::AgentRemoval& removal = input.agent_removal();
  Simulator* simulator = world_.Find(removal.simulator_id());
  if (simulator == nullptr) return;
  // Without a sender it is the description itself that says it.
  if (input.sender() != 0 && simulator->sender != input.sender()) {
    if (!HoldBehindItsLike(simulator, input)) Refuse(NotItsOwn(removal));
    return;
  }
  const auto slot = simulator->slots.find(removal.slot());
  if (slot == simulator->slots.end()) return;
  if (slot->second.agent) return RemoveAgent(simulator, removal.slot());
  if (!slot->second.waiting) return;
  slot->second.generations_over = std::uint64_t{slot->second.waiting->generation} + 1;
  slot->second.waiting.reset();
}

void Intake::TakeLiveliness(const v1::Input& input) {
  Simulator* simulator = world_.Find(input.liveliness().simulator_id());
  if (simulator == nullptr) return;
  // Without a sender it is the clock itself that says it: the owner's, if that has told one.
  const bool deserted = input.sender() == 0 && simulator->told > Instant::Always();
  if (simulator->sender != input.sender() && !deserted) {
    // What the dead wrote is not to come to life when the owner goes.
    if (!input.liveliness().alive()) {
      std::erase_if(simulator->held,
                    [&input](const v1::Input& held) { return held.sender() == input.sender(); });
      CountHeldBytes();
    }
    return;
  }
  simulator->alive = input.liveliness().alive();
  simulator->silent_since_ns = world_.monotonic_ns();
  if (simulator->alive) {
    simulator->released = false;
    return;
  }
  // It died while it waited, and its death was told last: nobody has ever waited for its agents.
  if (simulator->taken_over) RemoveAgents(simulator);
}

bool Intake::HoldBehindItsLike(Simulator* simulator, const v1::Input& input) {
  std::vector<v1::Input>& held = simulator->held;
  const auto same = [&input](const v1::Input& other) { return other.sender() == input.sender(); };
  if (std::none_of(held.begin(), held.end(), same)) return false;
  // The newest replaces the last, so that a removal is never lost.
  if (held.size() == kHeldInputsMax) held.pop_back();
  held.push_back(input);
  CountHeldBytes();
  return true;
}

/// At the end of the batch: those who wait may have ended in the same one.
void Intake::HandOver(Simulator* simulator) {
  if (simulator->alive || simulator->held.empty()) return;
  const std::vector<v1::Input> held = std::exchange(simulator->held, {});
  CountHeldBytes();
  for (const v1::Input& input : held) Apply(input);
  simulator->taken_over = simulator->alive;
}

void Intake::EndBatch() {
  for (auto& [id, simulator] : world_.simulators()) {
    HandOver(&simulator);
    const bool first = !simulator.clock;
    if (!world_.TakeClock(&simulator)) continue;
    for (auto& [index, slot] : simulator.slots) {
      if (first) AdmitIfComplete(&simulator, index);
      if (!first && slot.agent && slot.agent->admitted) {
        detector_.Hear(simulator.IdOf(index, slot.agent->generation), *simulator.clock);
      }
    }
  }
  ReleaseShapes();
  ReportUndescribed();
  ReportMissingShapes();
}

}  // namespace collision::server
