// Goal:   a program that writes or disposes of ever-new keys takes no memory and no turn from
//         another one, and is ignored while it goes on.
// Method: real DDS on loopback, with limits small enough to reach.
#include <gtest/gtest.h>

#include "idl/identity.h"
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
  DdsBus bus(TestWorld(), TestDomain(), kLease, SmallLimits());
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
  DdsBus bus(TestWorld(), TestDomain(), kLease, SmallLimits());
  Disposer hostile;
  std::vector<v1::Input> inputs;
  std::vector<std::string> warnings;
  const auto end = std::chrono::steady_clock::now() + kDeadline;
  while (warnings.empty() && std::chrono::steady_clock::now() < end) {
    hostile.Dispose();
    bus.Receive(std::chrono::nanoseconds(0), kNoLimit, &inputs);
    warnings = bus.TakeWarnings();
  }
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0], "a program in partition \"" + TestWorld() +
                             ".hostile\" writes more than it may: it is ignored for 10 s");
  EXPECT_EQ(bus.counters().senders_ignored, 1u);
  EXPECT_GT(bus.counters().samples_refused, dds::kRefusedMax);
  EXPECT_TRUE(bus.TakeWarnings().empty());
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
