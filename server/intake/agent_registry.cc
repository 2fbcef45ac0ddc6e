#include "server/intake/agent_registry.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <utility>

#include "collision_core/motion/contract.h"
#include "collision_core/shape/fixed_half_space.h"
#include "idl/identity.h"
#include "server/process/logging.h"

namespace collision::server {
namespace {

/// While more agents than this wait for their descriptions, only the newest state of each is kept.
constexpr std::size_t kUndescribedFew = 1024;

bool SameHalfSpace(const detection::AgentDeclaration& a, const detection::AgentDeclaration& b) {
  if (!a.half_space || !b.half_space) return !a.half_space && !b.half_space;
  return a.half_space->IsSameAs(*b.half_space);
}

/// Whether no motion that was declared with the one state leads from it to the other.
bool Breaks(const Agent& agent, std::uint64_t sequence, const motion::MotionState& before,
            const motion::MotionState& next) {
  if (next.discontinuity) return false;
  motion::MotionLimits limits = agent.declaration.limits;
  if (agent.former && sequence <= agent.former->until_sequence) {
    limits = motion::Wider(agent.former->limits, limits);
  }
  const auto orientation = agent.declaration.shape != nullptr ? motion::OrientationUse::kMatters
                                                              : motion::OrientationUse::kIgnored;
  return motion::CheckContract({before, limits}, next, orientation).verdict ==
         motion::ContractVerdict::kBreached;
}

}  // namespace

AgentRegistry::AgentRegistry(const v1::Config& config, World* world, Detectors* detectors,
                             Rejections* rejections, AgentShapes* shapes)
    : agents_max_(config.agents_max()),
      world_(*world),
      detectors_(*detectors),
      rejections_(*rejections),
      shapes_(*shapes),
      names_(config),
      undescribed_(ToNanoseconds(config.undescribed_after_s())),
      breaches_(&world_, detectors) {}

void AgentRegistry::Describe(Simulator* simulator, const v1::AgentDescription& wire,
                             const detection::AgentDeclaration& declaration) {
  if (const auto refusal = CheckKind(*simulator, wire)) return rejections_.Add(*refusal);
  const Agent* agent = simulator->agents().Find(wire.slot());
  if (agent == nullptr || !agent->admitted()) return Introduce(simulator, wire, declaration);
  Told& told = told_[simulator->id()][wire.slot()];
  const std::pair<std::uint32_t, std::uint32_t> newest =
      told.description ? std::pair(told.description->generation(), told.description->revision())
                       : std::pair(agent->generation(), agent->revision());
  if (std::pair(wire.generation(), wire.revision()) <= newest) return;
  if (told.removed && wire.generation() <= newest.first) return;
  told = {.description = wire, .declaration = declaration};
}

std::optional<Refusal> AgentRegistry::CheckKind(const Simulator& simulator,
                                                const v1::AgentDescription& wire) const {
  std::optional<bool> hypothetical;
  const Agent* agent = simulator.agents().Find(wire.slot(), wire.generation());
  if (agent != nullptr) hypothetical = agent->hypothetical();
  const v1::AgentDescription* told = ToldOf(simulator, wire.slot());
  if (told != nullptr && told->generation() == wire.generation()) {
    hypothetical = told->hypothetical();
  }
  if (!hypothetical || *hypothetical == wire.hypothetical()) return std::nullopt;
  return Changed(wire, "hypothetical",
                 fmt::format("{}; allowed: {}, as this agent was described first, or an agent of "
                             "another generation",
                             wire.hypothetical(), *hypothetical));
}

void AgentRegistry::Introduce(Simulator* simulator, const v1::AgentDescription& wire,
                              detection::AgentDeclaration declaration) {
  AgentTable& agents = simulator->agents();
  const std::uint32_t slot = wire.slot();
  if (agents.HasEnded(slot, wire.generation())) return;
  if (agents.Find(slot, wire.generation())) return Revise(simulator, wire, declaration);
  if (Agent* former = agents.Find(slot)) RemoveAgent(simulator, slot, former);
  std::shared_ptr<const void> names = names_.Complete(wire, &declaration.filter);
  Agent* agent = agents.Add(slot, {wire.generation(), wire.revision(), declaration});
  agent->names = std::move(names);
  simulator->refusals().Accept(v1::TOPIC_AGENT_DESCRIPTION, slot);
  simulator->refusals().Accept(v1::TOPIC_AGENT_STATES, slot);
  agent->description_sequence = wire.sequence();
  agent->label = std::make_shared<const v1::AgentLabel>(LabelOf(wire));
  shapes_.Refer(simulator, slot, ShapeHashOf(wire), agent);
  told_[simulator->id()].try_emplace(slot);
}

void AgentRegistry::Revise(Simulator* simulator, const v1::AgentDescription& wire,
                           detection::AgentDeclaration declaration) {
  Agent* agent = simulator->agents().Find(wire.slot());
  if (wire.revision() <= agent->revision()) return;
  if (!SameHalfSpace(agent->declaration, declaration)) {
    return rejections_.Add(Changed(wire, "half_space",
                                   "it cannot change while the agent is there; allowed: to remove "
                                   "the agent and to add another one"));
  }
  KeepFormer(wire, agent);
  agent->names = names_.Complete(wire, &declaration.filter);
  simulator->agents().Revise(wire.slot(), wire.revision(), declaration);
  simulator->refusals().Accept(v1::TOPIC_AGENT_DESCRIPTION, wire.slot());
  agent->description_sequence = wire.sequence();
  agent->label = std::make_shared<const v1::AgentLabel>(LabelOf(wire));
  shapes_.Refer(simulator, wire.slot(), ShapeHashOf(wire), agent);
  if (!agent->admitted()) return;
  const detection::AgentId id = simulator->IdOf(wire.slot(), agent->generation());
  detectors_.Redeclare(id, agent->declaration, world_.EffectiveFrom(agent->stamp()));
  world_.AddRevision({id, wire.revision()});
}

void AgentRegistry::KeepFormer(const v1::AgentDescription& wire, Agent* agent) {
  FormerDeclaration former{.limits = agent->declaration.limits,
                           .same_shape = agent->shape_hash == ShapeHashOf(wire),
                           .until_sequence = wire.states_sequence()};
  if (agent->former) {
    former.limits = motion::Wider(agent->former->limits, former.limits);
    former.same_shape = former.same_shape && agent->former->same_shape;
  }
  agent->former = former;
}

void AgentRegistry::TakeState(Simulator* simulator, const v1::AgentStates& chunk,
                              const v1::AgentState& wire) {
  ++counters_.states_received;
  if (const auto refusal = CheckSlot(chunk, wire)) return rejections_.Add(*refusal);
  const StateOrder order =
      simulator->agents().RecordState(wire.slot(), wire.generation(), wire.sequence());
  if (order == StateOrder::kEnded) ++counters_.states_older;
  if (order == StateOrder::kRepeated) ++counters_.states_repeated;
  if (order != StateOrder::kNew) return;
  const Agent* agent = simulator->agents().Find(wire.slot(), wire.generation());
  const bool admitted = agent != nullptr && agent->admitted();
  const Decoded<motion::MotionState> decoded =
      DecodeState(chunk, wire, world_.RulesForState(*simulator, admitted));
  if (const auto* refusal = std::get_if<Refusal>(&decoded)) return rejections_.Add(*refusal);
  simulator->refusals().Accept(v1::TOPIC_AGENT_STATES, wire.slot());
  const motion::MotionState& state = std::get<motion::MotionState>(decoded);
  if (admitted && !world_.simulated()) {
    Update(simulator, wire.slot(), wire.sequence(), state);
  } else {
    SetWaiting(simulator, wire.slot(), {wire.generation(), wire.sequence(), state});
  }
}

void AgentRegistry::Update(Simulator* simulator, std::uint32_t slot, std::uint64_t sequence,
                           const motion::MotionState& state) {
  Agent& agent = *simulator->agents().Find(slot);
  const detection::AgentId id = simulator->IdOf(slot, agent.generation());
  agent.EndFormer(sequence);
  const detection::UpdateOutcome outcome =
      state.stamp < agent.stamp() ? detection::UpdateOutcome::kOlder
      : agent.former              ? UpdateFormer(id, agent, state)
                                  : detectors_.Update(id, state, world_.EffectiveFrom(state.stamp));
  if (outcome == detection::UpdateOutcome::kOlder) {
    ++counters_.states_older;
    return;
  }
  CountAccepted(simulator);
  simulator->agents().Acknowledge(slot, state.stamp, sequence);
  if (outcome == detection::UpdateOutcome::kBreached) {
    breaches_.Add(*simulator, id, ++agent.breaches);
  }
}

// Of another shape than now nothing is known but that it is within the ball. A declaration that
// differs from the one that follows it leaves the shape unknown until the next state.
detection::AgentDeclaration AgentRegistry::FormerOf(const Agent& agent) {
  detection::AgentDeclaration former = agent.declaration;
  former.limits = motion::Wider(agent.former->limits, former.limits);
  if (agent.former->same_shape) return former;
  former.shape_awaited = former.shape == nullptr && !former.shape_awaited;
  former.shape = nullptr;
  return former;
}

// Wider values of either declaration stay in force. Narrower ones apply from the next state.
detection::UpdateOutcome AgentRegistry::UpdateFormer(const detection::AgentId& id,
                                                     const Agent& agent,
                                                     const motion::MotionState& state) {
  const Instant effective = world_.EffectiveFrom(state.stamp);
  detectors_.Redeclare(id, FormerOf(agent), effective);
  const detection::UpdateOutcome outcome = detectors_.Update(id, state, effective);
  detectors_.Redeclare(id, agent.declaration, effective);
  return outcome;
}

void AgentRegistry::SetWaiting(Simulator* simulator, std::uint32_t slot,
                               const WaitingState& waiting) {
  AgentTable& agents = simulator->agents();
  const WaitingState* before = agents.Waiting(slot);
  const bool first = before == nullptr || before->generation != waiting.generation;
  if (!first && waiting.state.stamp < before->state.stamp) {
    ++counters_.states_older;
    return;
  }
  if (first && !IsDescribed(*simulator, slot, waiting.generation)) {
    const detection::AgentId id = simulator->IdOf(slot, waiting.generation);
    if (undescribed_.full()) {
      return rejections_.Add(NotDescribed(
          id, fmt::format("the state is dropped: {} states already wait for a description",
                          kOverdueMax)));
    }
    undescribed_.Add(world_.monotonic_ns(), id);
  }
  agents.SetWaiting(slot, waiting,
                    CountsBefore(*simulator, slot, waiting) ? AgentTable::Former::kWaitsOn
                                                            : AgentTable::Former::kReplaced);
  told_[simulator->id()].try_emplace(slot);
}

bool AgentRegistry::CountsBefore(const Simulator& simulator, std::uint32_t slot,
                                 const WaitingState& next) const {
  const Agent* agent = simulator.agents().Find(slot, next.generation);
  const std::span<const WaitingState> all = simulator.agents().AllWaiting(slot);
  if (all.empty() || (agent == nullptr && undescribed_.size() > kUndescribedFew)) return false;
  const WaitingState& newest = all.back();
  const bool is_first = all.size() == 1 && (agent == nullptr || !agent->admitted());
  if (is_first) return newest.state.stamp < next.state.stamp;
  if (newest.state.discontinuity) return true;
  if (agent == nullptr) return false;
  if (Breaks(*agent, newest.sequence, newest.state, next.state)) return true;
  if (all.size() > 1) {
    const WaitingState& before = all[all.size() - 2];
    return Breaks(*agent, before.sequence, before.state, newest.state);
  }
  const motion::MotionState* in_force = detectors_.StateOf(simulator.IdOf(slot, next.generation));
  return in_force != nullptr &&
         Breaks(*agent, agent->acknowledged_sequence(), *in_force, newest.state);
}

bool AgentRegistry::IsDescribed(const Simulator& simulator, std::uint32_t slot,
                                std::uint32_t generation) const {
  if (simulator.agents().Find(slot, generation) != nullptr) return true;
  const v1::AgentDescription* told = ToldOf(simulator, slot);
  return told != nullptr && told->generation() == generation;
}

const v1::AgentDescription* AgentRegistry::ToldOf(const Simulator& simulator,
                                                  std::uint32_t slot) const {
  const auto told = told_.find(simulator.id());
  if (told == told_.end()) return nullptr;
  const auto one = told->second.find(slot);
  const bool is_described = one != told->second.end() && one->second.description;
  return is_described ? &*one->second.description : nullptr;
}

void AgentRegistry::Enact(Simulator* simulator) {
  const auto all = told_.find(simulator->id());
  if (all == told_.end() || simulator->time().is_other_kind()) return;
  if (world_.simulated() && !simulator->time().clock()) return;
  const std::map<std::uint32_t, Told> told = std::move(all->second);
  told_.erase(all);
  for (const auto& [slot, one] : told) {
    EnactState(simulator, slot);
    if (one.description) Introduce(simulator, *one.description, one.declaration);
    if (one.removed) RemoveNow(simulator, slot);
    if (one.description) EnactState(simulator, slot);
  }
  told_.erase(simulator->id());
}

void AgentRegistry::EnactState(Simulator* simulator, std::uint32_t slot) {
  AgentTable& agents = simulator->agents();
  const Agent* agent = agents.Find(slot);
  const WaitingState* waiting = agents.Waiting(slot);
  if (agent == nullptr || waiting == nullptr) return;
  if (waiting->generation != agent->generation()) return;
  if (!agent->admitted()) return AdmitIfComplete(simulator, slot);
  for (const WaitingState& state : agents.TakeWaiting(slot)) {
    Update(simulator, slot, state.sequence, state.state);
  }
}

void AgentRegistry::AdmitIfComplete(Simulator* simulator, std::uint32_t slot) {
  AgentTable& agents = simulator->agents();
  Agent* agent = agents.Find(slot);
  const WaitingState* waiting = agents.Waiting(slot);
  if (agent == nullptr || agent->admitted() || waiting == nullptr) return;
  if (waiting->generation != agent->generation()) return;
  if (const auto refusal = RoomRefusal(*simulator, *agent)) {
    if (std::exchange(agent->room_refused, true)) return;
    return rejections_.Add(NoRoom(simulator->IdOf(slot, agent->generation()), *refusal));
  }
  const std::vector<WaitingState> states = agents.TakeWaiting(slot);
  const detection::AgentId id = simulator->IdOf(slot, agent->generation());
  const StampRules rules = world_.RulesForState(*simulator, false);
  const auto first = std::find_if(states.begin(), states.end() - 1, [&](const WaitingState& one) {
    return !CheckStamp(id, one.state.stamp, rules);
  });
  if (!Admit(simulator, slot, *first)) return;
  for (auto next = first + 1; next != states.end(); ++next) {
    Update(simulator, slot, next->sequence, next->state);
  }
}

std::optional<std::string> AgentRegistry::RoomRefusal(const Simulator& simulator,
                                                      const Agent& agent) const {
  if (agent.declaration.half_space && !detectors_.contacts().HasRoomForHalfSpace()) {
    return fmt::format("no room for another half-space; allowed: {} of all simulators together",
                       detection::kHalfSpacesMax);
  }
  const std::uint64_t free =
      agents_max_ - std::min<std::uint64_t>(agents_max_, detectors_.agents());
  if (world_.quotas().RoomFor(simulator.id(), Resource::kAgents, free) > 0) return std::nullopt;
  return fmt::format(
      "no room for another agent; allowed to this simulator now: the {} that it has (at most {}; "
      "of the {} of all simulators {} are used, and what others are guaranteed is kept)",
      world_.quotas().Used(simulator.id(), Resource::kAgents),
      world_.quotas().ShareOf(simulator.id(), Resource::kAgents).max, agents_max_,
      detectors_.agents());
}

bool AgentRegistry::Admit(Simulator* simulator, std::uint32_t slot, const WaitingState& waiting) {
  const detection::AgentId id = simulator->IdOf(slot, waiting.generation);
  const Instant stamp = waiting.state.stamp;
  const StampRules rules = world_.RulesForState(*simulator, false);
  if (const auto refusal = CheckStamp(id, stamp, rules)) {
    rejections_.Add(*refusal);
    return false;
  }
  Agent& agent = *simulator->agents().Find(slot);
  agent.EndFormer(waiting.sequence);
  const Instant effective = world_.EffectiveFrom(stamp);
  const detection::AgentDeclaration& declared = agent.declaration;
  if (!detectors_.Admit(id, agent.former ? FormerOf(agent) : declared, waiting.state, effective)) {
    return false;
  }
  if (agent.former) detectors_.Redeclare(id, declared, effective);
  world_.quotas().Take(simulator->id(), Resource::kAgents, 1);
  detectors_.SetPairShare(OwnerOf(id), world_.quotas().ShareOf(simulator->id(), Resource::kPairs));
  ++counters_.admitted;
  if (agent.room_refused) {
    simulator->refusals().Accept(v1::TOPIC_AGENT_DESCRIPTION, slot);
  }
  CountAccepted(simulator);
  simulator->agents().Admit(slot, stamp, waiting.sequence);
  if (simulator->time().clock()) {
    detectors_.SetHeardUntil(OwnerOf(id), *simulator->time().clock(),
                             simulator->time().told_until());
  }
  return true;
}

void AgentRegistry::CountAccepted(Simulator* simulator) {
  ++counters_.states_accepted;
  simulator->CountState();
}

void AgentRegistry::Remove(Simulator* simulator, std::uint32_t slot, std::uint64_t sequence) {
  const Agent* agent = simulator->agents().Find(slot);
  const bool late = sequence != 0 && sequence < DescriptionSequence(*simulator, slot);
  if (late) return;
  // In a round what it did may still be on its way, as the clock of its simulator may.
  const bool in_round = world_.started() && world_.RunsInRounds();
  if (agent == nullptr || !(agent->admitted() || in_round)) return RemoveNow(simulator, slot);
  told_[simulator->id()][slot].removed = true;
}

bool AgentRegistry::AllLeave(const Simulator& simulator) const {
  const auto told = told_.find(simulator.id());
  const auto leaves = [&](std::uint32_t slot) {
    if (told == told_.end()) return false;
    const auto one = told->second.find(slot);
    return one != told->second.end() && one->second.removed && !one->second.description;
  };
  bool all_leave = true;
  simulator.agents().ForEachSlot([&](std::uint32_t slot) {
    if (simulator.agents().Find(slot) != nullptr && !leaves(slot)) all_leave = false;
  });
  return all_leave;
}

std::uint64_t AgentRegistry::DescriptionSequence(const Simulator& simulator,
                                                 std::uint32_t slot) const {
  if (const auto* told = ToldOf(simulator, slot)) return told->sequence();
  const Agent* agent = simulator.agents().Find(slot);
  return agent != nullptr ? agent->description_sequence : 0;
}

void AgentRegistry::RemoveNow(Simulator* simulator, std::uint32_t slot) {
  if (Agent* agent = simulator->agents().Find(slot)) return RemoveAgent(simulator, slot, agent);
  simulator->agents().RemoveWaiting(slot);
  simulator->refusals().RemoveAgent(slot);
}

void AgentRegistry::RemoveAgent(Simulator* simulator, std::uint32_t slot, Agent* agent) {
  Withdraw(*simulator, slot, *agent);
  shapes_.Refer(simulator, slot, {}, agent);
  simulator->agents().Remove(slot);
  simulator->refusals().RemoveAgent(slot);
}

void AgentRegistry::Withdraw(const Simulator& simulator, std::uint32_t slot, const Agent& agent) {
  if (!agent.admitted()) return;
  const detection::AgentId id = simulator.IdOf(slot, agent.generation());
  const Instant told = simulator.time().clock().value_or(Instant::Always());
  world_.departed().Add(id, agent.label, std::max(agent.stamp(), told));
  detectors_.Remove(id);
  world_.quotas().GiveBack(simulator.id(), Resource::kAgents, 1);
  ++counters_.removed;
}

void AgentRegistry::RemoveAll(Simulator* simulator) {
  told_.erase(simulator->id());
  simulator->agents().ForEachSlot([&](std::uint32_t slot) {
    if (Agent* agent = simulator->agents().Find(slot)) RemoveAgent(simulator, slot, agent);
  });
}

void AgentRegistry::ExpelAll(Simulator* simulator) {
  AgentTable& agents = simulator->agents();
  agents.ForEachSlot([&](std::uint32_t slot) {
    if (const Agent* agent = agents.Find(slot)) Withdraw(*simulator, slot, *agent);
    agents.Expel(slot);
  });
}

void AgentRegistry::VoidAll(Simulator* simulator, Instant from) {
  AgentTable& agents = simulator->agents();
  detectors_.VoidOwner({simulator->id(), simulator->run()}, from);
  agents.ForEachSlot([&](std::uint32_t slot) { agents.DropWaiting(slot); });
}

void AgentRegistry::ReportUndescribed() {
  while (const auto id = undescribed_.TakeDue(world_.monotonic_ns())) {
    Simulator* simulator = world_.Find(id->simulator);
    if (simulator == nullptr || simulator->run() != id->run) continue;
    const WaitingState* waiting = simulator->agents().Waiting(id->slot);
    if (waiting == nullptr || waiting->generation != id->generation) continue;
    if (simulator->agents().Find(id->slot, id->generation)) continue;
    rejections_.Add(
        NotDescribed(*id, "the state is kept, but no description of its agent has arrived"));
  }
}

}  // namespace collision::server
