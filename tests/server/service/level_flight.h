// Agents in known motion, and what a daemon with levels tells of them.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "tests/server/messages.h"
#include "tests/server/scripted_bus.h"

namespace collision::server {

/// Of one agent of "alpha".
struct Flyer {
  v1::AgentDescription description;
  /// Position and velocity along x at so many seconds; y stays 0.
  std::function<std::pair<double, double>(double)> motion;
  double y = 0;
};

/// A level of this margin [m], and nothing else.
inline v1::Level* AddLevel(const std::string& name, double margin, v1::Config* config) {
  v1::Level* level = config->add_levels();
  level->set_name(name);
  level->set_margin_m(margin);
  return level;
}

/// Lock-step with as many steps a second as states are told.
inline v1::Config TwentyAStep() {
  v1::Config config = Simulated();
  config.set_temporal_resolution_s(0.05);
  return config;
}

/// A ball of 1 m, with 2 m/s² at most.
inline v1::AgentDescription Ball(std::uint32_t slot, const std::string& class_name = "") {
  v1::AgentDescription description = Description("alpha", slot);
  description.set_class_name(class_name);
  return description;
}

inline Flyer AtRest(const v1::AgentDescription& description, double x, double y = 0) {
  return {description, [x](double) { return std::pair(x, 0.0); }, y};
}

inline Flyer Straight(const v1::AgentDescription& description, double x, double speed, double y) {
  return {description, [=](double t) { return std::pair(x + speed * t, speed); }, y};
}

/// Flies them for so many seconds, 20 states a second each; `before`: inputs that come first.
inline std::vector<v1::CollisionEvent> Fly(const v1::Config& config,
                                           const std::vector<Flyer>& flyers, double seconds,
                                           std::vector<v1::Input> before = {},
                                           std::uint64_t* log_hash = nullptr) {
  ScriptedDaemon daemon(config);
  std::vector<v1::Input> inputs = std::move(before);
  for (const Flyer& flyer : flyers) inputs.push_back(From(1, flyer.description));
  std::uint64_t sequence = 0;
  for (int step = 0; step * 0.05 <= seconds; ++step) {
    v1::AgentStates chunk = Chunk("alpha");
    const std::int64_t stamp_ns = step * std::int64_t{50'000'000};
    for (std::size_t slot = 0; slot < flyers.size(); ++slot) {
      const auto [x, speed] = flyers[slot].motion(step * 0.05);
      v1::AgentState state = State(static_cast<std::uint32_t>(slot), stamp_ns, ++sequence);
      state.mutable_position_m()->set_x(x);
      state.mutable_position_m()->set_y(flyers[slot].y);
      state.mutable_velocity_m_s()->set_x(speed);
      *chunk.add_states() = state;
    }
    inputs.push_back(From(1, chunk));
    inputs.push_back(From(1, ClockAfter("alpha", stamp_ns, sequence, flyers.size())));
    daemon.Step(std::exchange(inputs, {}), 0.05);
  }
  EXPECT_TRUE(daemon.rejections().empty()) << daemon.rejections()[0].ShortDebugString();
  if (log_hash != nullptr) *log_hash = daemon.daemon().event_log().hash();
  std::vector<v1::CollisionEvent> events;
  for (const v1::Output& output : daemon.bus().outputs) {
    if (output.has_collision_event()) events.push_back(output.collision_event());
  }
  return events;
}

/// Of the contacts' topic, those of this level and status, in their order.
inline std::vector<v1::CollisionEvent> Told(const std::vector<v1::CollisionEvent>& events,
                                            const std::string& level, v1::EventStatus status) {
  std::vector<v1::CollisionEvent> told;
  for (const v1::CollisionEvent& event : events) {
    if (event.contacts_sequence() == 0 && status == v1::EVENT_CONFIRMED) continue;
    if (event.level() == level && event.status() == status) told.push_back(event);
  }
  return told;
}

/// Whether the bracket contains the time [s] and is not wider than that [s].
inline testing::AssertionResult Brackets(const v1::TimeBracket& bracket, double time,
                                         double width) {
  const double earliest = 1e-9 * static_cast<double>(bracket.earliest_ns());
  const double latest = 1e-9 * static_cast<double>(bracket.latest_ns());
  constexpr double kRounding = 1e-9;
  if (earliest <= time + kRounding && time <= latest + kRounding && latest - earliest <= width) {
    return testing::AssertionSuccess();
  }
  return testing::AssertionFailure() << "[" << earliest << ", " << latest << "] of " << time;
}

}  // namespace collision::server
