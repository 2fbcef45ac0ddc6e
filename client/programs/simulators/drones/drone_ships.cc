#include "client/programs/simulators/drones/drone_ships.h"

#include <cmath>

#include "collision/shape.h"

namespace collision::client {
namespace {

constexpr double kSpaceOfOne = 8000;       // [m³]
constexpr std::size_t kMeetAtOne = 4;      // drones per place where they meet
constexpr int kTurnSteps[] = {15, 90};     // between two choices of the turn rate
constexpr std::uint64_t kTurnSeed = 0x7e;  // torques and forces draw different numbers

}  // namespace

Vector3 BoxFor(std::size_t drones) {
  const double width = std::cbrt(2 * kSpaceOfOne * static_cast<double>(drones));
  return {width, width, width / 2};
}

std::uint64_t PlacesFor(std::size_t drones) { return 1 + drones / kMeetAtOne; }

DroneShip::DroneShip(const DroneLimits& limits, const TurnLimits& turn, const Vector3& position_m,
                     std::uint64_t seed)
    : drone_(limits, position_m, seed), turn_(turn), random_(seed ^ kTurnSeed) {
  state_.position_m = position_m;
  state_.orientation = RandomOrientation(&random_);
}

RigidStep DroneShip::Step(std::int64_t t0_ns, std::int64_t t1_ns) {
  if (steps_left_-- <= 0) {
    steps_left_ = static_cast<int>(random_.Uniform(kTurnSteps[0], kTurnSteps[1]));
    turn_wanted_ = Scaled(random_.InUnitBall(), turn_.angular_speed_max_rad_s);
  }
  const RigidStep step = {drone_.Step(t0_ns, t1_ns),
                          TurnTowards(state_, turn_wanted_, turn_, t0_ns, t1_ns)};
  state_ = {drone_.position_m(), drone_.velocity_m_s(), OrientationAt(step.turn, t1_ns),
            AngularVelocityAt(step.turn, t1_ns)};
  return step;
}

void DroneShip::SetVelocities(const Vector3& velocity_m_s, const Vector3& angular_velocity_rad_s) {
  drone_.SetVelocity(velocity_m_s);
  state_.velocity_m_s = velocity_m_s;
  state_.angular_velocity_rad_s = AtMost(angular_velocity_rad_s, turn_.angular_speed_max_rad_s);
}

DroneShips::DroneShips(const DroneShipOptions& options, Pace* pace, MotionLog* log)
    : options_(options), pace_(pace) {
  if (options_.shape) options_.limits.radius_m = options_.shape->radius_m();
  options_.limits.places = PlacesFor(options_.first + options_.drones);
  const auto starts =
      StartPositions(options_.limits, options_.first + options_.drones, options_.seed);
  for (std::size_t i = options_.first; i < starts.size(); ++i) {
    AgentDescription description;
    description.name = "drone-" + std::to_string(i);
    description.radius_m = options_.limits.radius_m;
    description.acceleration_max_m_s2 = options_.limits.acceleration_max_m_s2;
    description.angular_acceleration_max_rad_s2 = options_.turn.angular_acceleration_max_rad_s2;
    description.shape = options_.shape;
    members_.push_back(
        {DroneShip(options_.limits, options_.turn, starts[i], options_.seed + (i + 1) * 0x10001),
         ShipAgent(description, pace, log)});
  }
  pace_->world().OnEvent([this](const Event& event) {
    for (Member& member : members_) member.agent.Handle(event);
  });
}

void DroneShips::StepTo(std::int64_t t0_ns, std::int64_t t1_ns, bool states) {
  for (Member& member : members_) {
    member.agent.Log(member.ship.Step(t0_ns, t1_ns));
    RigidState state = member.ship.state();
    const bool bounced = member.agent.Answer(t1_ns, &state);
    if (bounced) member.ship.SetVelocities(state.velocity_m_s, state.angular_velocity_rad_s);
    if (bounced) ++bounces_;
    if (bounced || states) member.agent.SetState(member.ship.state(), t1_ns, bounced, {});
  }
}

void DroneShips::Fly() {
  for (Member& member : members_) {
    member.agent.SetState(member.ship.state(), pace_->start_ns(), false, {});
  }
  pace_->Fly(options_.rate_hz, options_.state_every, [this](const PaceStep& step) {
    StepTo(step.t0_ns, step.t1_ns, step.with_states);
    return true;
  });
  pace_->Linger();
}

}  // namespace collision::client
