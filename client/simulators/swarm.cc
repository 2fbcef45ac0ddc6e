#include "client/simulators/swarm.h"

#include <cmath>

namespace collision::client {

Swarm::Swarm(const SwarmOptions& options, Pace* pace, MotionLog* log)
    : options_(options), pace_(pace), log_(log) {
  const auto starts = StartPositions(options.limits, options.first + options.drones, options.seed);
  for (std::size_t i = options.first; i < starts.size(); ++i) {
    members_.push_back({"drone-" + std::to_string(i),
                        Drone(options.limits, starts[i], options.seed + (i + 1) * 0x10001),
                        std::nullopt,
                        {}});
  }
  pace_->world().OnEvent([this](const Event& event) { Hear(event); });
}

void Swarm::Hear(const Event& event) {
  if (event.status != EventStatus::kConfirmed) return;
  if (!heard_.emplace(event.lower, event.higher, event.contact).second) return;
  for (Member& member : members_) {
    if (!member.agent) continue;
    if (member.agent->id() == event.lower) member.bounces.emplace_back(event.normal, 1);
    if (member.agent->id() == event.higher) member.bounces.emplace_back(event.normal, -1);
  }
}

void Swarm::Stage(Member* member, std::int64_t stamp_ns, bool discontinuity) {
  State state;
  state.stamp_ns = stamp_ns;
  state.position_m = member->drone.position_m();
  state.velocity_m_s = member->drone.velocity_m_s();
  state.discontinuity = discontinuity;
  if (member->agent) {
    member->agent->SetState(state);
    return;
  }
  AgentDescription description;
  description.name = member->name;
  description.radius_m = options_.limits.radius_m;
  description.acceleration_max_m_s2 = options_.limits.acceleration_max_m_s2;
  member->agent.emplace(pace_->world().AddAgent(description, state));
  log_->Agent(member->name, options_.limits.radius_m);
}

void Swarm::StepTo(std::int64_t t0_ns, std::int64_t t1_ns, bool states) {
  for (Member& member : members_) {
    log_->Piece(member.name, member.drone.Step(t0_ns, t1_ns));
    bool bounced = false;
    for (const auto& [normal, side] : member.bounces) {
      bounced = member.drone.Bounce(normal, side) || bounced;
    }
    member.bounces.clear();
    if (bounced) log_->Jump(member.name, t1_ns);
    if (bounced) ++bounces_;
    if (bounced || states) Stage(&member, t1_ns, bounced);
  }
}

void Swarm::Fly() {
  for (Member& member : members_) Stage(&member, pace_->start_ns(), false);
  pace_->Fly(options_.rate_hz, options_.state_every,
             [this](std::int64_t t0_ns, std::int64_t t1_ns, bool told) {
               StepTo(t0_ns, t1_ns, told);
               return true;
             });
  pace_->Linger();
}

}  // namespace collision::client
