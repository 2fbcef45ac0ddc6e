#include "server/service/opening/opening_of.h"

#include <algorithm>

namespace collision::server {
namespace {

/// More than all that are remembered take.
constexpr std::size_t kEndedRunsBytes = kEndedRunsMax * 64;

PresentSimulator PresentOf(const Simulator& simulator, const World& world) {
  PresentSimulator present{.sender = simulator.sender(), .run = simulator.run()};
  present.is_alive = simulator.alive();
  present.states_seen = simulator.time().states_seen();
  present.descriptions_seen = simulator.time().descriptions_seen();
  present.is_in_time = !world.simulated() || simulator.time().newest() != Instant::Always();
  simulator.agents().ForEachSlot([&](std::uint32_t slot) {
    const Agent* agent = simulator.agents().Find(slot);
    if (agent == nullptr) return;
    present.agents.emplace_back(slot, agent->generation());
    present.descriptions_sequence =
        std::max(present.descriptions_sequence, agent->description_sequence);
  });
  return present;
}

}  // namespace

Opening OpeningOf(const World& world, const ServiceClaim& claim) {
  Opening opening{.claim = claim.options(), .serves = claim.phase() == ClaimPhase::kServing};
  ClaimOptions& options = opening.claim;
  options.term_before = claim.term() - 1;
  options.wait_ns = 0;
  options.epoch = world.epoch();
  options.ended_runs = EndedRuns(world.ended_runs()).TakeTurn(kEndedRunsBytes);
  options.roster.clear();
  for (const auto& [id, missing] : world.silence().roster().entries()) {
    options.roster.push_back(missing);
  }
  for (const auto& [id, simulator] : world.simulators()) {
    opening.simulators.emplace(id, PresentOf(simulator, world));
    const bool is_held = simulator.time().stands_at().has_value() && !simulator.has_left();
    if (!world.simulated() || !is_held || world.silence().roster().IsMissing(id)) continue;
    options.roster.push_back({.id = id,
                              .run = simulator.run(),
                              .name = simulator.name(),
                              .granted = simulator.time().granted()});
  }
  return opening;
}

void GoOnFrom(const ClaimOptions& claim, const ClockReading& reading, World* world, Intake* intake,
              Publisher* publisher) {
  world->SetReading(reading);
  if (world->FollowEpoch(claim.epoch)) publisher->BeginEpoch(world->epoch(), *world);
  for (const EndedRun& ended : EndedRunsIn(claim.ended_runs)) intake->FollowEnd(ended);
}

}  // namespace collision::server
