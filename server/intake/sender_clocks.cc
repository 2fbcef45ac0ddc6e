#include "server/intake/sender_clocks.h"

#include <spdlog/fmt/fmt.h>

#include "idl/identity.h"
#include "server/process/logging.h"

namespace collision::server {

SenderClocks::SenderClocks(const v1::Config& config, World* world, AgentRegistry* agents)
    : skew_max_s_(config.clock().skew_max_s()), world_(*world), agents_(*agents) {}

void SenderClocks::Take(Simulator* simulator, const v1::SimulatorClock& clock) {
  const std::optional<RoundTrip> trip = world_.RoundTripOf(clock, service_id_);
  if (!trip) return;
  const Instant within_until = simulator->sender_clock().within_until();
  const SenderVerdict verdict =
      simulator->sender_clock().Take(*trip, world_.monotonic_ns(), ToNanoseconds(skew_max_s_));
  if (verdict == SenderVerdict::kRefused) {
    agents_.VoidAll(simulator, within_until);
    names_.Add(simulator->name());
    Log(spdlog::level::warn, "clock of a simulator is off",
        fmt::format("simulator {} \"{}\": its clock is {}", IdText(simulator->id()),
                    simulator->name(), WhatIsWrong(*simulator)));
  } else if (verdict == SenderVerdict::kTaken) {
    Log(spdlog::level::info, "clock of a simulator is right again",
        fmt::format("simulator {} \"{}\": its clock is {}; its states are taken",
                    IdText(simulator->id()), simulator->name(),
                    OffsetText(simulator->sender_clock().offset(world_.monotonic_ns()))));
  }
}

std::optional<Refusal> SenderClocks::Check(const Simulator& simulator,
                                           const v1::AgentStates& chunk) const {
  if (!simulator.sender_clock().refused()) return std::nullopt;
  Refusal refusal = At(chunk);
  refusal.reason = v1::REJECTED_CLOCK_SKEW;
  refusal.field = "stamp_ns";
  refusal.detail = "the sender's clock is " + WhatIsWrong(simulator);
  return refusal;
}

std::string SenderClocks::WhatIsWrong(const Simulator& simulator) const {
  const OffsetBracket offset = simulator.sender_clock().offset(world_.monotonic_ns());
  return fmt::format("{}; allowed: {} ms. Synchronise it, or set clock.skew_max_s to {} or more",
                     OffsetText(offset), skew_max_s_ * 1e3, SufficientSkew(offset));
}

}  // namespace collision::server
