#include "server/intake/intake.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "idl/identity.h"
#include "server/codec/hello.h"
#include "server/process/logging.h"

namespace collision::server {
namespace {

/// The refusal of a message over which the service has failed.
Refusal Quarantined(Refusal where) {
  where.reason = v1::REJECTED_OUT_OF_RANGE;
  where.field = "content";
  where.detail = "the service failed twice while it applied this message; allowed: other content";
  return where;
}

}  // namespace

Intake::Intake(const v1::Config& config, std::uint64_t instance, World* world, Detectors* detectors,
               Rejections* rejections, ShapeStore* shapes)
    : instance_(instance),
      world_(*world),
      detectors_(*detectors),
      rejections_(*rejections),
      shapes_(*shapes),
      classes_(config),
      agent_shapes_(config, world, detectors, rejections, shapes),
      agents_(config, world, detectors, rejections, &agent_shapes_),
      sender_clocks_(config, world, &agents_),
      hello_(HelloOf(config)) {}

void Intake::Apply(const v1::Input& input) {
  switch (input.message_case()) {
    case v1::Input::kSimulatorHello:
      return TakeHello(input);
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
    case v1::Input::kServiceHeard:     // for the claim
    case v1::Input::kEventHeard:       // for the publisher
    case v1::Input::kOperatorCommand:  // for the OperatorCommands
    case v1::Input::kWatch:            // for simulators
    case v1::Input::MESSAGE_NOT_SET:
      return;
  }
}

Simulator* Intake::Claimed(const v1::Input& input, Refusal where, const std::string* name) {
  if (IsUnfit(input, where)) return nullptr;
  const Claim claim = world_.ClaimFor(where.simulator_id, input.sender(), where.run, name);
  if (claim.unproven) {
    AwaitName(input, where.simulator_id);
    return nullptr;
  }
  if (!claim.accepted) {
    where.reason = claim.reason;
    where.field = claim.reason == v1::REJECTED_OLD_RUN ? "run" : "simulator_id";
    where.detail = claim.detail;
    const bool contends = claim.reason == v1::REJECTED_ID_OWNED;
    const bool succeeds = contends && where.run > claim.simulator->run();
    // It writes again if the service in force refuses it, which may have heard of its owner's end
    // already.
    if (succeeds && world_.stands_by()) AwaitName(input, where.simulator_id);
    if (!contends || claim.simulator->contenders().Add(input.sender(), succeeds)) {
      rejections_.Add(where);
    } else {
      rejections_.Count(where);
    }
    return nullptr;
  }
  if (claim.new_run) {
    Log(spdlog::level::info, "run begins",
        fmt::format("simulator {} \"{}\": run {} follows run {}, whose {} agents are removed",
                    IdText(claim.simulator->id()), claim.simulator->name(), where.run,
                    claim.simulator->run(), claim.simulator->agents().size()));
    const bool held = claim.simulator->holds_time();
    agents_.RemoveAll(claim.simulator);
    shapes_.Release(claim.simulator->id());
    world_.StartRun(claim.simulator, input.sender(), where.run, held);
  }
  if (name != nullptr) {
    claim.simulator->SetIncarnation(where.incarnation);
    ApplyProved(*claim.simulator);
  }
  if (where.topic != v1::TOPIC_SIMULATOR_CLOCK) claim.simulator->CountTold();
  return claim.simulator;
}

void Intake::TakeHello(const v1::Input& input) {
  const v1::SimulatorHello& hello = input.simulator_hello();
  const std::optional<Refusal> refusal = CheckHello(hello, hello_);
  if (!refusal) {
    unfit_.erase(input.sender());
    return;
  }
  if (unfit_.size() >= kUnfitMax) unfit_.erase(unfit_.begin());
  unfit_.insert_or_assign(input.sender(), Unfitting{hello.simulator_name(), *refusal});
  Log(spdlog::level::warn, "simulator does not fit",
      fmt::format("simulator \"{}\" is refused: {}: {}", hello.simulator_name(), refusal->field,
                  refusal->detail));
  rejections_.Add(*refusal);
  // Topics overtake each other: it may have been taken in already.
  Simulator* simulator = world_.Find(hello.simulator_id());
  if (simulator != nullptr && simulator->sender() == input.sender()) {
    EndRun(simulator, EndCause::kRefused);
  }
}

bool Intake::IsUnfit(const v1::Input& input, const Refusal& where) {
  const auto found = unfit_.find(input.sender());
  if (found == unfit_.end() || input.sender() == 0) return false;
  if (found->second.refusal.simulator_id != where.simulator_id) return false;
  rejections_.Count(found->second.refusal);
  return true;
}

std::vector<std::string> Intake::Unfit() const {
  std::vector<std::string> texts;
  for (const auto& [sender, one] : unfit_) {
    texts.push_back(one.name + ": " + one.refusal.field + " " + one.refusal.detail);
  }
  return texts;
}

bool Intake::SucceedsLast(const v1::Input& input) const {
  const auto succeeds = [&](const auto& wire) {
    return !CheckIdentity(wire) &&
           world_.SucceedsLast(wire.simulator_id(), input.sender(), wire.run());
  };
  if (input.has_agent_description()) return succeeds(input.agent_description());
  return input.has_simulator_clock() && succeeds(input.simulator_clock());
}

void Intake::AwaitName(const v1::Input& input, std::uint64_t simulator_id) {
  if (input.sender() == 0) return;  // An instance has ended with its writer: no name will come.
  unproven_.Add(world_.monotonic_ns(), simulator_id, input);
}

void Intake::ApplyProved(const Simulator& simulator) {
  const UnprovenInputs::Proved proved = unproven_.Take(simulator.id(), simulator.sender());
  for (const v1::Input& input : proved.inputs) Apply(input);
  if (proved.lost == 0) return;
  rejections_.Add({.reason = v1::REJECTED_TOO_MANY_SIMULATORS,
                   .topic = v1::TOPIC_AGENT_STATES,
                   .simulator_id = simulator.id(),
                   .run = simulator.run(),
                   .incarnation = simulator.incarnation(),
                   .field = "simulator_id",
                   .detail = fmt::format("{} messages came before the name of their simulator and "
                                         "were dropped; allowed: {} bytes of all such messages",
                                         proved.lost, kUnprovenBytesMax)});
}

void Intake::DropUnproven() {
  const std::uint64_t dropped = unproven_.DropOverdue(world_.monotonic_ns());
  if (dropped == 0) return;
  Log(spdlog::level::warn, "no such simulator",
      fmt::format("{} messages are dropped: for {} s no description or clock of their senders has "
                  "named the simulator whose id they carry, or its owner has not ended",
                  dropped, kUnprovenTime / 1'000'000'000));
}

void Intake::TakeDescription(const v1::Input& input) {
  const v1::AgentDescription& wire = input.agent_description();
  ++counters_.descriptions_received;
  if (const auto refusal = CheckIdentity(wire)) return rejections_.Add(*refusal);
  Simulator* simulator = Claimed(input, At(wire), &wire.simulator_name());
  if (simulator == nullptr) return;
  simulator->time().RecordDescriptions(wire.sequence());
  if (input.quarantined()) return rejections_.Add(Quarantined(At(wire)));
  const Decoded<detection::AgentDeclaration> decoded = DecodeDescription(wire, classes_);
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
  if (input.quarantined()) return rejections_.Add(Quarantined(At(chunk)));
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
  if (input.quarantined()) return rejections_.Add(Quarantined(At(wire)));
  simulator->SetFollows(Names(wire));
  sender_clocks_.Take(simulator, wire);
  SimulatorTime& time = simulator->time();
  const bool tells_none = wire.clock_ns() == Instant::Always().nanoseconds();
  if (tells_none && wire.lock_step() == world_.simulated()) {
    NoteFollower(wire);
    if (world_.simulated()) {
      world_.Join(simulator, wire.next_ns() == Instant::Never().nanoseconds());
    } else {
      time.TellPresence(wire.descriptions_sequence(), wire.agents());
    }
    return simulator->refusals().Accept(v1::TOPIC_SIMULATOR_CLOCK, 0);
  }
  const Decoded<Instant> decoded = DecodeClock(wire, world_.RulesForClock(*simulator));
  if (const auto* refusal = std::get_if<Refusal>(&decoded)) {
    if (wire.lock_step() != world_.simulated() && time.newest() == Instant::Always()) {
      time.SetOtherKind();
      // With a wall clock, agents are admitted before their simulator tells a clock.
      if (!world_.simulated()) agents_.RemoveAll(simulator);
    }
    return rejections_.Add(*refusal);
  }
  // A clock that is only repeated is no progress.
  if (std::get<Instant>(decoded) > time.newest() || time.awaits_own_clock()) simulator->Resume();
  NoteFollower(wire);
  if (wire.service_id() == instance_) {
    simulator->agents().clearances().Acknowledge(wire.clearances_sequence(), world_.monotonic_ns(),
                                                 contended_);
  }
  const bool tells_next = wire.next_ns() > wire.clock_ns();
  time.Offer(
      {.clock = std::get<Instant>(decoded),
       .next = tells_next ? std::optional(Instant::FromNanoseconds(wire.next_ns())) : std::nullopt,
       .states_sequence = wire.states_sequence(),
       .descriptions_sequence = wire.descriptions_sequence(),
       .lock_step = wire.lock_step(),
       .agents = wire.agents()});
  simulator->refusals().Accept(v1::TOPIC_SIMULATOR_CLOCK, 0);
}

/// Whether its sender has heard this service, or none.
bool Intake::Names(const v1::SimulatorClock& clock) const {
  return clock.service_id() == instance_ || clock.service_id() == 0;
}

void Intake::NoteFollower(const v1::SimulatorClock& clock) {
  Simulator* simulator = world_.Find(clock.simulator_id());
  if (simulator == nullptr || simulator->run() != clock.run()) return;
  simulator->SetFollows(Names(clock));
  if (simulator->follows()) simulator->EndInheritance();
}

bool Intake::MayRemove(const Simulator& simulator, const v1::Input& input, bool is_owners,
                       const Refusal& refusal) {
  if (input.sender() == simulator.sender()) return true;
  // Without a sender, the instance itself has ended: it says whose it was.
  if (input.sender() == 0 && is_owners) return true;
  if (input.sender() == 0) {
    ++counters_.removals_ignored;
  } else {
    rejections_.Add(refusal);
    if (world_.stands_by()) AwaitName(input, simulator.id());  // as in Claimed()
  }
  return false;
}

void Intake::TakeRemoval(const v1::Input& input) {
  const v1::AgentRemoval& removal = input.agent_removal();
  Simulator* simulator = world_.Find(removal.simulator_id());
  if (simulator == nullptr) return AwaitName(input, removal.simulator_id());
  const bool is_owners = removal.incarnation() == simulator->incarnation();
  if (!MayRemove(*simulator, input, is_owners, NotItsOwn(removal))) return;
  simulator->time().RecordDescriptions(removal.sequence());
  agents_.Remove(simulator, removal.slot(), removal.sequence());
}

void Intake::TakeLiveliness(const v1::Input& input) {
  if (!input.liveliness().alive()) {
    unproven_.Forget(input.sender());
    unfit_.erase(input.sender());
  }
  Simulator* simulator = world_.Find(input.liveliness().simulator_id());
  if (simulator == nullptr) return;
  const bool alive = input.liveliness().alive();
  // Without a sender, the instance of the clock itself has ended: the owner's, if it has a clock.
  const bool deserted = input.sender() == 0 && simulator->time().newest() > Instant::Always() &&
                        input.liveliness().incarnation() == simulator->incarnation();
  if (simulator->sender() != input.sender() && !deserted) {
    if (!alive) simulator->contenders().Drop(input.sender());
    return;
  }
  if (!alive && world_.IsWaking() && !simulator->contenders().empty()) {
    return simulator->Doubt(world_.monotonic_ns() + kWakingTime);
  }
  simulator->SetAlive(alive, world_.monotonic_ns());
}

void Intake::TakeShapePart(const v1::Input& input) {
  const v1::ShapePart& part = input.shape_part();
  Simulator* simulator = Claimed(input, At(part), nullptr);
  if (simulator == nullptr) return;
  if (input.quarantined()) {
    rejections_.Add(Quarantined(At(part)));
    return agent_shapes_.GiveUp(part.content_hash());
  }
  if (const auto refusal = shapes_.Take(part)) {
    rejections_.Add(*refusal);
    agent_shapes_.GiveUp(part.content_hash());
    return;
  }
  simulator->refusals().Accept(v1::TOPIC_SHAPE, 0);
}

void Intake::TakeShapeRemoval(const v1::Input& input) {
  const v1::ShapeRemoval& removal = input.shape_removal();
  const Simulator* simulator = world_.Find(removal.simulator_id());
  if (simulator == nullptr) return AwaitName(input, removal.simulator_id());
  // The numbers of another program are other ones.
  const bool is_owners = shapes_.Knows(removal.simulator_id(), removal.shape());
  if (!MayRemove(*simulator, input, is_owners, NotItsOwn(removal))) return;
  shapes_.Dispose(removal.simulator_id(), removal.shape(), removal.part());
}

void Intake::Enact(Simulator* simulator) {
  agents_.Enact(simulator);
  if (!simulator->time().clock()) return;
  detectors_.SetHeardUntil({simulator->id(), simulator->run()}, *simulator->time().clock(),
                           simulator->time().told_until());
}

void Intake::Enact() {
  for (auto& [id, simulator] : world_.simulators()) Enact(&simulator);
}

bool Intake::AllLeave() const {
  return std::ranges::all_of(world_.simulators(), [&](const auto& one) {
    const Simulator& simulator = one.second;
    const bool is_over = simulator.agents().size() == 0 || simulator.time().is_settled();
    return is_over && agents_.AllLeave(simulator);
  });
}

void Intake::EndRun(Simulator* simulator, EndCause cause) {
  Enact(simulator);
  agents_.RemoveAll(simulator);
  shapes_.Release(simulator->id());
  world_.EndRun(simulator, cause);
}

std::vector<std::string> Intake::RemoveSilent() {
  std::vector<std::string> removed;
  for (const std::uint64_t id : world_.Overdue()) {
    Simulator* simulator = world_.Find(id);
    removed.push_back(simulator->name());
    EndRun(simulator, EndCause::kSilent);
  }
  return removed;
}

void Intake::FollowEnd(const EndedRun& ended) {
  if (world_.ended_runs().Refusal(ended.simulator, ended.run)) return;
  Simulator* const simulator = world_.Find(ended.simulator);
  if (simulator != nullptr && simulator->run() <= ended.run) EndRun(simulator, ended.cause);
  if (world_.ended_runs().Refusal(ended.simulator, ended.run)) return;
  world_.ended_runs().Add(ended.simulator, ended.run, ended.cause);
}

void Intake::EndEpoch() {
  for (auto& [id, simulator] : world_.simulators()) {
    if (!World::LeavesWithEpoch(simulator)) continue;
    Enact(&simulator);
    agents_.RemoveAll(&simulator);
  }
}

void Intake::ExpelAgents() {
  for (auto& [id, simulator] : world_.simulators()) agents_.ExpelAll(&simulator);
}

void Intake::EndBatch() {
  for (auto& [id, simulator] : world_.simulators()) {
    simulator.time().TakeCensus(simulator.agents().size(), simulator.refusals().descriptions());
  }
  world_.UpdateQuotas();
  sender_clocks_.WriteNames();
  DropUnproven();
  agent_shapes_.ReleaseLeft();
  agents_.ReportUndescribed();
  agent_shapes_.ReportMissing();
  if (!world_.simulated()) return;
  for (const std::string& line : agent_shapes_.wait().TakeLines(world_.monotonic_ns())) {
    Log(spdlog::level::info, "waiting for shapes", line);
  }
}

void Intake::TakeClocks() {
  for (auto& [id, simulator] : world_.simulators()) {
    if (HasLeftUnheard(simulator)) {
      for (const bool finishes : {false, true}) world_.Join(&simulator, finishes);
    }
    simulator.time().Take();
  }
}

bool Intake::HasLeftUnheard(const Simulator& simulator) const {
  const bool awaits_clock = !simulator.alive() && simulator.time().newest() == Instant::Always();
  return world_.simulated() && world_.started() && awaits_clock && simulator.agents().size() > 0 &&
         agents_.AllLeave(simulator);
}

std::vector<std::string> Intake::AwaitedShapes() const {
  if (!world_.simulated()) return {};
  return agent_shapes_.wait().Waiting(world_.monotonic_ns());
}

std::optional<std::int64_t> Intake::NextDue() const {
  const std::optional<std::int64_t> state = agents_.NextDue();
  const std::optional<std::int64_t> shape = agent_shapes_.NextDue();
  const std::optional<std::int64_t> wait =
      world_.simulated() ? agent_shapes_.wait().NextDue() : std::nullopt;
  std::optional<std::int64_t> next;
  for (const auto& due : {state, shape, wait, unproven_.NextDue(), agents_.NextBreachDue()}) {
    if (due) next = next ? std::min(*next, *due) : *due;
  }
  return next;
}

}  // namespace collision::server
