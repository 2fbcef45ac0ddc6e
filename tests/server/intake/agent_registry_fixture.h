// One simulator in a world without a bus; the test hands over each message.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "server/config/config.h"
#include "server/intake/agent_registry.h"
#include "tests/server/messages.h"

namespace collision::server {

class AgentRegistryTest : public testing::Test {
 protected:
  static constexpr std::int64_t kSecond = 1'000'000'000;
  static constexpr std::uint64_t kSender = 10;

  static v1::Config ConfigOf(v1::Clock::Kind kind) {
    v1::Config config;
    config.mutable_clock()->set_kind(kind);
    config.set_agents_max(2);
    config.set_undescribed_after_s(3);
    return CompleteConfig(config);
  }

  explicit AgentRegistryTest(v1::Clock::Kind kind = v1::Clock::LOCK_STEP) : config(ConfigOf(kind)) {
    const std::string name = "alpha";
    alpha = world.ClaimFor(SimulatorId(name), kSender, 1, &name).simulator;
    SetTime(0);
  }

  /// The daemon's clocks.
  void SetTime(std::int64_t ns) {
    world.SetReading({.wall_ns = 1'700'000'000 * kSecond + ns, .monotonic_ns = ns});
  }
  /// The clock of the simulator comes into force.
  void SetClock(std::int64_t ns) {
    alpha->time().Offer({.clock = Instant::FromNanoseconds(ns)});
    ASSERT_TRUE(alpha->time().Take());
    world.MoveOn();
    registry.Enact(alpha);
  }
  void Describe(const v1::AgentDescription& wire) {
    const auto decoded = DecodeDescription(wire);
    ASSERT_TRUE(std::holds_alternative<detection::AgentDeclaration>(decoded));
    registry.Describe(alpha, wire, std::get<detection::AgentDeclaration>(decoded));
    registry.Enact(alpha);
  }
  void Describe(std::uint32_t slot) { Describe(Description("alpha", slot)); }
  void Take(const v1::AgentState& state) {
    registry.TakeState(alpha, Chunk("alpha"), state);
    registry.Enact(alpha);
  }
  void Remove(std::uint32_t slot, std::uint64_t sequence = 0) {
    registry.Remove(alpha, slot, sequence);
    registry.Enact(alpha);
  }
  /// The agent of slot 0 is there, with its state at 0 s.
  void Join() {
    SetClock(0);
    Describe(0);
    Take(State(0, 0, 1));
    ASSERT_EQ(detector.agents(), 1u);
  }

  std::vector<v1::RejectionReason> TakeReasons() {
    std::vector<v1::RejectionReason> reasons;
    for (const v1::Rejection& rejection : rejections.Take()) reasons.push_back(rejection.reason());
    return reasons;
  }
  const AgentCounters& counters() const { return registry.counters(); }

  const v1::Config config;
  World world{config};
  Detectors detectors{config};
  const detection::Detector& detector = detectors.contacts();
  Rejections rejections{100, &world};
  InlineShapeBuilder builder{BuildOptions{.triangles_max = 1000}};
  ShapeStore store{config, &builder, &world.quotas()};
  AgentShapes shapes{config, &world, &detectors, &rejections, &store};
  AgentRegistry registry{config, &world, &detectors, &rejections, &shapes};
  Simulator* alpha = nullptr;
};

}  // namespace collision::server
