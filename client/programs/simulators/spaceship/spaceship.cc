#include "client/programs/simulators/spaceship/spaceship.h"

#include <cstdio>

#include "collision/event_text.h"

namespace collision::client {
namespace {

constexpr double kBeforeTheBox = 15;  // [m]

AgentDescription Description(const SpaceshipOptions& options) {
  AgentDescription description;
  description.name = "spaceship";
  description.radius_m = options.radius_m;
  description.acceleration_max_m_s2 = options.limits.acceleration_max_m_s2;
  description.angular_acceleration_max_rad_s2 = options.limits.turn.angular_acceleration_max_rad_s2;
  description.shape = options.shape;
  return description;
}

}  // namespace

RigidState SpaceshipStart(const Vector3& box_m) {
  RigidState state;
  state.position_m = {-kBeforeTheBox, box_m[1] / 2, box_m[2] / 2};
  return state;
}

Spaceship::Spaceship(const SpaceshipOptions& options, Pace* pace, MotionLog* log,
                     SpaceshipScreen* screen)
    : options_(options),
      pace_(pace),
      screen_(screen),
      ship_(options.limits, SpaceshipStart(options.box_m)),
      agent_(Description(options), pace, log),
      autopilot_(options.box_m, options.seed) {
  pace_->world().OnEvent([this](const Event& event) { agent_.Handle(event); });
}

ShipCommand Spaceship::Ask(std::int64_t t0_ns) {
  if (screen_ == nullptr) return autopilot_.Command(ship_, t0_ns);
  screen_->Update({&ship_, agent_.agent()->id(), agent_.agent()->clearance(), thrust_, bounces_,
                   t0_ns, pace_->start_ns()});
  return screen_->helm().Command(ship_, static_cast<double>(t0_ns - pace_->start_ns()) * 1e-9);
}

void Spaceship::SetState(std::int64_t stamp_ns, bool discontinuity) {
  const std::int64_t holds_ns = ship_.HeadingHoldsFor();
  ThrustBound thrust{ship_.heading(), kNever};
  if (holds_ns < kNever - stamp_ns) thrust.until_ns = stamp_ns + holds_ns;
  agent_.SetState(ship_.state(), stamp_ns, discontinuity, thrust);
}

void Spaceship::PrintBounce(std::int64_t stamp_ns) const {
  const RigidState& state = ship_.state();
  std::printf("%s  bounced at (%.1f, %.1f, %.1f) m, on at %.1f m/s\n",
              InstantText(stamp_ns, pace_->start_ns(), 3).c_str(), state.position_m[0],
              state.position_m[1], state.position_m[2], Norm(state.velocity_m_s));
  std::fflush(stdout);
}

void Spaceship::StepTo(std::int64_t t0_ns, std::int64_t t1_ns, bool with_state) {
  const ShipCommand command = Ask(t0_ns);
  thrust_ = command.thrust;
  agent_.Log(ship_.Step(command, t0_ns, t1_ns));
  RigidState state = ship_.state();
  const bool bounced = agent_.Answer(t1_ns, &state);
  if (bounced) {
    ++bounces_;
    ship_.SetVelocities(state.velocity_m_s, state.angular_velocity_rad_s);
    if (screen_ == nullptr) PrintBounce(t1_ns);
  }
  if (bounced || with_state) SetState(t1_ns, bounced);
}

void Spaceship::Fly() {
  SetState(pace_->start_ns(), false);
  pace_->Fly(options_.rate_hz, options_.state_every, [this](const PaceStep& step) {
    StepTo(step.t0_ns, step.t1_ns, step.with_states);
    return !Quit();
  });
  if (!Quit()) pace_->Linger();
}

}  // namespace collision::client
