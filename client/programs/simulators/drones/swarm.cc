#include "client/programs/simulators/drones/swarm.h"

#include <algorithm>
#include <cmath>

namespace collision::client {

Swarm::Swarm(const SwarmOptions& options, Pace* pace, MotionLog* log)
    : options_(options), pace_(pace), log_(log) {
  const auto starts = StartPositions(options.limits, options.first + options.drones, options.seed);
  for (std::size_t i = options.first; i < starts.size(); ++i) {
    Drone drone(options.limits, starts[i], options.seed + (i + 1) * 0x10001);
    Member& member = members_.emplace_back("drone-" + std::to_string(i), drone);
    member.piece = {pace_->start_ns(), pace_->start_ns(), {}};
  }
  pace_->world().OnEvent([this](const Event& event) { Handle(event); });
}

void Swarm::Handle(const Event& event) {
  if (event.status != EventStatus::kConfirmed) return;
  const bool has_normal = event.proximity && event.proximity->normal;
  const Vector3 normal = has_normal ? event.proximity->normal->direction : Vector3{};
  if (!answered_.emplace(event.lower, event.higher, event.contact).second) return;
  for (const auto& [id, side] : {std::pair(event.lower, 1), std::pair(event.higher, -1)}) {
    const auto found = by_slot_.find(id.slot);
    if (found == by_slot_.end()) continue;
    Member& member = members_[found->second];
    if (member.agent && member.agent->id() == id) member.bounces.emplace_back(normal, side);
  }
}

void Swarm::Add(Member* member) {
  AgentDescription description;
  description.name = member->name;
  description.radius_m = options_.limits.radius_m;
  description.acceleration_max_m_s2 = options_.limits.acceleration_max_m_s2;
  if (options_.declares_speed) description.speed_max_m_s = options_.limits.speed_max_m_s;
  State state;
  state.stamp_ns = pace_->start_ns();
  state.position_m = member->drone.position_m();
  state.velocity_m_s = member->drone.velocity_m_s();
  member->agent.emplace(pace_->world().AddAgent(description, state));
  by_slot_[member->agent->id().slot] = static_cast<std::size_t>(member - members_.data());
  log_->Agent(member->name, options_.limits.radius_m);
}

void Swarm::Stage(Member* member, std::int64_t stamp_ns, bool bounced) {
  const PositionAndVelocity motion = Evaluate(member->piece, stamp_ns);
  State state;
  state.stamp_ns = stamp_ns;
  state.position_m = motion.position_m;
  state.velocity_m_s = bounced ? member->drone.velocity_m_s() : motion.velocity_m_s;
  state.discontinuity = bounced;
  member->agent->SetState(state);
}

// Spreads the drones' changes of force over the steps.
std::int64_t Swarm::HeldUntil(std::size_t member) const {
  const std::size_t steps = step_ == 1 ? 1 + member % options_.force_every : options_.force_every;
  const double elapsed = static_cast<double>(step_ - 1 + steps) * 1e9 / options_.rate_hz;
  return std::min(pace_->end_ns(), pace_->start_ns() + std::int64_t{std::llround(elapsed)});
}

// A bounce ends the force that the drone held.
bool Swarm::Bounce(Member* member, std::int64_t stamp_ns) {
  if (member->bounces.empty()) return false;
  const PositionAndVelocity motion = Evaluate(member->piece, stamp_ns);
  Drone turned = member->drone;
  turned.SetPosition(motion.position_m);
  turned.SetVelocity(motion.velocity_m_s);
  bool bounced = false;
  for (const auto& [normal, side] : member->bounces) {
    bounced = turned.Bounce(normal, side) || bounced;
  }
  member->bounces.clear();
  if (!bounced) return false;
  member->drone = turned;
  member->piece.t1_ns = stamp_ns;
  log_->Jump(member->name, stamp_ns);
  ++bounces_;
  return true;
}

void Swarm::StepTo(std::int64_t t0_ns, std::int64_t t1_ns, bool states) {
  ++step_;
  for (std::size_t i = 0; i < members_.size(); ++i) {
    Member& member = members_[i];
    if (member.piece.t1_ns <= t0_ns) member.piece = member.drone.Step(t0_ns, HeldUntil(i));
    const bool bounced = Bounce(&member, t1_ns);
    if (member.piece.t1_ns == t1_ns) log_->Piece(member.name, member.piece);
    if (bounced || states) Stage(&member, t1_ns, bounced);
  }
}

void Swarm::Fly() {
  for (Member& member : members_) Add(&member);
  std::int64_t flown_ns = pace_->start_ns();
  pace_->Fly(options_.rate_hz, options_.state_every, [&](const PaceStep& step) {
    StepTo(step.t0_ns, step.t1_ns, step.with_states);
    flown_ns = step.t1_ns;
    return true;
  });
  // A run that is stopped early ends within the last force.
  for (Member& member : members_) {
    if (member.piece.t1_ns <= flown_ns) continue;
    member.piece.t1_ns = flown_ns;
    log_->Piece(member.name, member.piece);
  }
  pace_->Linger();
}

}  // namespace collision::client
