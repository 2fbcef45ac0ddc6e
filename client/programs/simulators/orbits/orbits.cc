#include "client/programs/simulators/orbits/orbits.h"

#include <algorithm>
#include <cstdio>

namespace collision::client {
namespace {

// Declared error of a position [m]: it is exact up to rounding, which is far smaller.
constexpr double kSatellitePositionError = 1e-6;

}  // namespace

std::string SatelliteName(std::size_t number) { return "satellite-" + std::to_string(number); }

AgentDescription SatelliteDescription(const OrbitsOptions& options, std::size_t number,
                                      const Orbit& orbit) {
  AgentDescription description;
  description.name = SatelliteName(number);
  description.radius_m = options.radius_m;
  description.acceleration_max_m_s2 =
      options.tells_acceleration ? orbit.deviation_max_m_s2() : orbit.acceleration_max_m_s2();
  if (options.tells_acceleration) description.jerk_max_m_s3 = orbit.jerk_max_m_s3();
  return description;
}

State SatelliteState(const OrbitsOptions& options, const Orbit& orbit, std::int64_t stamp_ns) {
  const PositionAndVelocity at = orbit.curve().At(stamp_ns);
  State state;
  state.stamp_ns = stamp_ns;
  state.position_m = at.position_m;
  state.velocity_m_s = at.velocity_m_s;
  if (options.tells_acceleration) state.acceleration_m_s2 = Gravity(at.position_m);
  state.position_error_m = kSatellitePositionError;
  return state;
}

Orbits::Orbits(const OrbitsOptions& options, Pace* pace, MotionLog* log)
    : options_(options), pace_(pace), log_(log) {
  for (std::size_t i = 0; i < options.satellites; ++i) {
    const std::size_t number = options.first + i;
    const PositionAndVelocity start = SatelliteAtStart(options.constellation, number);
    members_.push_back(
        {number, Orbit(start, pace->start_ns(), pace->end_ns(), options.constellation.step_s)});
  }
}

void Orbits::PrintBounds() const {
  if (!options_.tells_acceleration) {
    double most = 0;
    for (const Member& member : members_) {
      most = std::max(most, member.orbit.acceleration_max_m_s2());
    }
    std::printf("%zu satellites; acceleration at most %.4g m/s2\n", members_.size(), most);
    return;
  }
  double deviation = 0, jerk = 0;
  for (const Member& member : members_) {
    deviation = std::max(deviation, member.orbit.deviation_max_m_s2());
    jerk = std::max(jerk, member.orbit.jerk_max_m_s3());
  }
  std::printf("%zu satellites; a of gravity, deviation at most %.3g m/s2, jerk %.4g m/s3\n",
              members_.size(), deviation, jerk);
}

void Orbits::Add(Member* member) {
  const AgentDescription description =
      SatelliteDescription(options_, member->number, member->orbit);
  member->agent.emplace(pace_->world().AddAgent(
      description, SatelliteState(options_, member->orbit, pace_->start_ns())));
  log_->Agent(description.name, options_.radius_m);
}

void Orbits::Log(std::int64_t flown_ns) {
  for (Member& member : members_) {
    const auto& pieces = member.orbit.curve().pieces();
    for (; member.logged < pieces.size() && pieces[member.logged].t1_ns <= flown_ns;
         ++member.logged) {
      log_->Piece(SatelliteName(member.number), pieces[member.logged]);
    }
  }
}

// A run that is stopped early ends within a piece.
void Orbits::Finish(std::int64_t flown_ns) {
  for (const Member& member : members_) {
    const auto& pieces = member.orbit.curve().pieces();
    if (member.logged == pieces.size() || pieces[member.logged].t0_ns >= flown_ns) continue;
    MotionPiece piece = pieces[member.logged];
    piece.t1_ns = flown_ns;
    log_->Piece(SatelliteName(member.number), piece);
  }
}

void Orbits::Fly() {
  for (Member& member : members_) Add(&member);
  std::int64_t flown_ns = pace_->start_ns();
  pace_->Fly(options_.rate_hz, 1, [&](const PaceStep& step) {
    for (Member& member : members_) {
      member.agent->SetState(SatelliteState(options_, member.orbit, step.t1_ns));
    }
    Log(step.t0_ns);
    flown_ns = step.t1_ns;
    return true;
  });
  Log(flown_ns);
  Finish(flown_ns);
  pace_->Linger();
}

}  // namespace collision::client
