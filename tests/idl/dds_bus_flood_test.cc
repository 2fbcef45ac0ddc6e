// Goal:   a program that writes or disposes of ever-new keys takes no memory and no turn from
//         another one, and is ignored while it goes on.
// Method: real DDS on loopback, with limits small enough to reach.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <thread>

#include "idl/identity.h"
#include "idl/limits.h"
#include "tests/idl/dds_bus_support.h"

namespace collision::server {
namespace {

constexpr std::size_t kNoLimit = 1'000'000;
constexpr std::uint32_t kAtATime = 1000;

dds::SenderLimits SmallLimits() {
  dds::SenderLimits limits;
  limits.samples_per_second = 2000;
  limits.waiting_bytes_max = 4'000'000;
  return limits;
}

/// Disposes of keys, none of them twice.
class Disposer {
 public:
  void Dispose() {
    session_.RemoveShape(SimulatorId("hostile"), shape_++, kAtATime);
    session_.Flush();
  }

 private:
  DdsSession session_{SimulatorOptions("hostile")};
  std::uint32_t shape_ = 0;
};

TEST(DdsBusFlood, AnotherIsHeardAtOnce) {
  DdsBus bus(TestWorld(), TestDomain(), {.lease = kLease, .sender_limits = SmallLimits()});
  Disposer hostile;
  DdsSession honest(SimulatorOptions("honest"));
  std::vector<v1::Input> inputs;
  hostile.Dispose();
  ASSERT_TRUE(ReceiveUntil(bus, &inputs, [&] { return !inputs.empty(); }));
  for (std::int64_t time = 1; time <= 50; ++time) {
    hostile.Dispose();
    honest.Write(SimulatorTime("honest", time));
    honest.Flush();
    const auto heard = [&] {
      return !inputs.empty() && std::any_of(inputs.begin(), inputs.end(), [&](const auto& input) {
        return input.simulator_clock().clock_ns() == time;
      });
    };
    inputs.clear();
    ASSERT_TRUE(ReceiveUntil(bus, &inputs, heard)) << time;
  }
}

TEST(DdsBusFlood, OneThatGoesOnIsIgnoredAndNamed) {
  DdsBus bus(TestWorld(), TestDomain(), {.lease = kLease, .sender_limits = SmallLimits()});
  Disposer hostile;
  std::vector<v1::Input> inputs;
  std::vector<BusWarning> warnings;
  const auto end = std::chrono::steady_clock::now() + kDeadline;
  while (warnings.empty() && std::chrono::steady_clock::now() < end) {
    hostile.Dispose();
    bus.Receive(std::chrono::nanoseconds(0), kNoLimit, &inputs);
    warnings = bus.TakeWarnings();
  }
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].text,
            "simulator \"hostile\" writes more than it may: it is ignored for 10 s");
  EXPECT_EQ(bus.counters().senders_ignored, 1u);
  EXPECT_GT(bus.counters().samples_refused, dds::kRefusedMax);
  EXPECT_TRUE(bus.TakeWarnings().empty());
  const std::vector<std::string> flooding = bus.flooding();
  ASSERT_EQ(flooding.size(), 1u);
  EXPECT_TRUE(flooding[0].starts_with("simulator \"hostile\": ")) << flooding[0];
  EXPECT_NE(flooding[0].find(" messages dropped; 0 wait; ignored for "), std::string::npos)
      << flooding[0];
}

/// As large as a message can become: negative integers take the most bytes.
v1::AgentStates LargestStates(std::uint32_t chunk) {
  v1::AgentStates message;
  message.set_simulator_id(SimulatorId("a"));
  message.set_chunk(chunk);
  for (int i = 0; i < wire::kStatesPerSampleMax; ++i) {
    v1::AgentState& state = *message.add_states();
    state.set_slot(~0u);
    state.set_generation(~0u);
    state.set_sequence(~std::uint64_t{0});
    for (v1::Vector3* vector :
         {state.mutable_position_m(), state.mutable_velocity_m_s(),
          state.mutable_angular_velocity_rad_s(), state.mutable_thrust_direction()}) {
      vector->set_x(1);
      vector->set_y(1);
      vector->set_z(1);
    }
    state.mutable_orientation()->set_w(1);
    state.mutable_orientation()->set_x(1);
    state.mutable_orientation()->set_y(1);
    state.mutable_orientation()->set_z(1);
    state.set_stamp_ns(-1);
    state.set_direction_until_ns(-1);
    state.set_expiry_ns(-1);
    state.set_position_error_m(1);
    state.set_velocity_error_m_s(1);
    state.set_rotation_error_rad(1);
    state.set_discontinuity(true);
  }
  return message;
}

// What a bus leaves to its readers' threads must neither outlive it nor go before them: the
// sanitizers watch.
TEST(DdsBusFlood, ABusMayEndWhileProgramsWrite) {
  constexpr int kBuses = 5;
  const DdsBus last_and_unread(TestWorld(), TestDomain(),
                               {.lease = kLease, .sender_limits = SmallLimits()});
  std::atomic<bool> ends = false;
  std::vector<std::thread> programs;
  for (const std::string name : {"a", "b"}) {
    programs.emplace_back([&ends, name] {
      DdsSession simulator(SimulatorOptions(name));
      for (std::uint32_t slot = 0; !ends; slot = (slot + 1) % kAtATime) {
        simulator.Write(Description(name, slot));
        simulator.RemoveShape(SimulatorId(name), slot, 1);
        simulator.Flush();
      }
    });
  }
  const ChildSimulator child(1);
  int heard = 0;
  for (int i = 0; i < kBuses; ++i) {
    DdsBus bus(TestWorld(), TestDomain(), {.lease = kLease, .sender_limits = SmallLimits()});
    std::vector<v1::Input> inputs;
    if (ReceiveUntil(bus, &inputs, [&] { return !inputs.empty(); })) ++heard;
  }
  ends = true;
  for (std::thread& program : programs) program.join();
  EXPECT_EQ(heard, kBuses);
}

TEST(DdsBusFlood, ABatchFitsIntoARecording) {
  constexpr std::uint32_t kChunks = 1000;
  constexpr std::size_t kRecordedMax = std::size_t{64} << 20;
  DdsBus bus(TestWorld(), TestDomain());
  DdsSession simulator(SimulatorOptions("a"));
  for (std::uint32_t chunk = 0; chunk < kChunks; ++chunk) simulator.Write(LargestStates(chunk));
  simulator.Flush();
  std::size_t taken = 0, largest = 0;
  const auto end = std::chrono::steady_clock::now() + kDeadline;
  while (taken < kChunks && std::chrono::steady_clock::now() < end) {
    std::vector<v1::Input> inputs;
    bus.Receive(kShort, kNoLimit, &inputs);
    taken += inputs.size();
    std::size_t bytes = 0;
    for (const v1::Input& input : inputs) bytes += input.ByteSizeLong();
    largest = std::max(largest, bytes);
  }
  EXPECT_EQ(taken, kChunks);
  EXPECT_LT(largest, kRecordedMax / 2);
}

TEST(DdsBusFlood, WhatAProgramWroteBeforeItWasReadComesInItsOrder) {
  constexpr std::uint32_t kSlots = 3000;
  DdsBus bus(TestWorld(), TestDomain());
  DdsSession simulator(SimulatorOptions("a"));
  for (std::uint32_t slot = 0; slot < kSlots; ++slot) simulator.Write(Description("a", slot));
  simulator.Flush();
  std::vector<v1::Input> inputs;
  ASSERT_TRUE(ReceiveUntil(bus, &inputs, [&] { return inputs.size() >= kSlots; }));
  for (std::uint32_t slot = 0; slot < kSlots; ++slot) {
    ASSERT_EQ(inputs[slot].agent_description().slot(), slot);
  }
}

}  // namespace
}  // namespace collision::server
