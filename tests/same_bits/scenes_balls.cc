// Balls: losses, everything that can be declared, extreme values, and much at one instant.
#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/same_bits/scene.h"

namespace collision::server {
namespace {

Scene Losses() {
  const auto fill = [](Scenario* scenario) { AddCrowds(30 * kSecond, scenario); };
  return {.name = "losses", .config = ConfigFor(2), .network = Lossy(5), .fill = fill};
}

/// Speed caps, integrator steps, errors, assemblies, margins, directions of thrust and expiry, in
/// turns. What is declared need not be true: a breach has to be the same bits as well.
SimulatedAgent Declaring(int i, std::int64_t end_ns, Random* random) {
  const WanderOptions options{.half_side = 6, .speed = 5, .acceleration_max = 3};
  SimulatedAgent agent{.radius = random->Uniform(0.2, 0.8),
                       .acceleration_max = options.acceleration_max,
                       .motion = Wander(options, end_ns, random)};
  const Eigen::Vector3d direction = random->UnitVector();
  agent.declare = [i](v1::AgentDescription* wire) {
    if (i % 2 == 0) wire->set_speed_max_m_s(9);
    if (i % 3 == 0) wire->set_time_step_s(0.01);
    if (i % 5 <= 1) wire->set_assembly("crew");
    if (i % 10 == 0) wire->set_margin_m(0.125);
  };
  agent.tell = [i, direction](v1::AgentState* state) {
    if (i % 4 == 0) state->set_velocity_error_m_s(0.05);
    if (i % 4 == 1) state->set_position_error_m(0.02);
    if (i % 6 == 2) {
      state->mutable_thrust_direction()->set_x(direction.x());
      state->mutable_thrust_direction()->set_y(direction.y());
      state->mutable_thrust_direction()->set_z(direction.z());
      state->set_direction_until_ns(state->stamp_ns() + 400'000'000);
    }
    if (i % 7 == 3) state->set_expiry_ns(state->stamp_ns() + 150'000'000);
  };
  return agent;
}

Scene Declarations() {
  v1::Config config = ConfigFor(2);
  config.mutable_clock()->set_skew_max_s(0.003);
  config.set_pairs_per_agent_max(6);
  config.set_history_max(8);
  const auto fill = [](Scenario* scenario) {
    constexpr std::int64_t kEnd = 12 * kSecond;
    Random random(7);
    std::vector<SimulatedAgent> alpha, beta;
    for (int i = 0; i < 20; ++i) alpha.push_back(Declaring(i, kEnd, &random));
    for (int i = 20; i < 40; ++i) beta.push_back(Declaring(i, kEnd, &random));
    scenario->Add({.name = "alpha", .sender = 1, .period_ns = 90'000'000, .end_ns = kEnd}, alpha);
    scenario->Add({.name = "beta", .sender = 2, .period_ns = 250'000'000, .end_ns = kEnd}, beta);
  };
  return {.name = "declarations", .config = config, .network = Lossy(8), .fill = fill};
}

/// Two that meet about half-way through, of one size, far from everything else; not faster than
/// light.
void AddMeeting(double size, const Eigen::Vector3d& at, double acceleration_max,
                std::int64_t end_ns, std::vector<SimulatedAgent>* agents) {
  const double speed = std::min(8 * size, 299'792'458.0);
  const double half = 0.5e-9 * static_cast<double>(end_ns);
  const Eigen::Vector3d offset(size + speed * half, 0.3 * size, -0.1 * size);
  for (const double side : {-1.0, 1.0}) {
    agents->push_back({.radius = size,
                       .acceleration_max = acceleration_max,
                       .motion = Straight(at + side * offset, {-side * speed, 0, 0}, end_ns)});
  }
}

/// Radii of 1e-12 to 1e12 m, of no and of denormal size, 1e15 m out, at the speed of light, and one
/// that says nothing of its acceleration.
Scene Extremes() {
  v1::Config config = ConfigFor(1);
  config.set_temporal_resolution_s(0.02);
  const auto fill = [](Scenario* scenario) {
    constexpr std::int64_t kEnd = 2 * kSecond;
    std::vector<SimulatedAgent> agents;
    for (int exponent = -12; exponent <= 12; ++exponent) {
      const double size = std::min(std::ldexp(1.0, exponent * 10 / 3), 1e12);
      const Eigen::Vector3d at(exponent * 1e13, exponent % 2 * 1e11, exponent % 3 * 3e10);
      AddMeeting(size, exponent < 0 ? Eigen::Vector3d(0, exponent * 10, 0) : at,
                 exponent % 2 ? size : 0, kEnd, &agents);
    }
    const Eigen::Vector3d far(9.99e14, -9.99e14, 9.99e14);
    AddMeeting(100, far, 1e-3, kEnd, &agents);
    AddMeeting(1e8, {-1e14, 0, 0}, 0, kEnd, &agents);
    AddMeeting(0, {0, 500, 0}, 0, kEnd, &agents);
    AddMeeting(std::numeric_limits<double>::denorm_min(), {0, 600, 0}, 1e-300, kEnd, &agents);
    const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
    agents.push_back({.radius = 1, .acceleration_max = 1e18, .motion = Straight(zero, zero, kEnd)});
    agents.back().from_ns = kSecond;
    scenario->Add({.name = "alpha", .sender = 1, .period_ns = 250'000'000, .end_ns = kEnd}, agents);
  };
  return {.name = "extremes", .config = config, .fill = fill};
}

/// A lattice of couples that all touch in the same nanosecond, and couples that rest on each other.
Scene Simultaneous() {
  v1::Config config = ConfigFor(1);
  config.set_agents_max(2000);
  const auto fill = [](Scenario* scenario) {
    constexpr std::int64_t kEnd = 2 * kSecond;
    std::vector<SimulatedAgent> agents;
    for (int i = 0; i < 300; ++i) {
      const Eigen::Vector3d at(8 * (i % 10), 8 * (i / 10 % 10), 8 * (i / 100));
      const bool rests = i % 4 == 0;
      const double gap = rests ? 0.5 : 1.5, speed = rests ? 0 : 1;
      for (const double side : {-1.0, 1.0}) {
        agents.push_back({.radius = 0.5,
                          .acceleration_max = i % 2 ? 0.125 : 0,
                          .motion = Straight(at + Eigen::Vector3d(side * gap, 0, 0),
                                             {-side * speed, 0, 0}, kEnd)});
      }
    }
    scenario->Add({.name = "alpha", .sender = 1, .period_ns = 125'000'000, .end_ns = kEnd}, agents);
  };
  return {.name = "simultaneous", .config = config, .fill = fill};
}

}  // namespace

std::vector<Scene> BallScenes() { return {Losses(), Declarations(), Extremes(), Simultaneous()}; }

}  // namespace collision::server
