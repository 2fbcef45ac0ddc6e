// Goal:   who leaves, dies, stops or comes back is noticed as what it is, and nobody else suffers.
// Method: a second session in this process that is destroyed, and a child process that is killed or
// stopped.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "idl/identity.h"
#include "tests/idl/dds_bus_support.h"

namespace collision::server {
namespace {

std::vector<bool> Livelinesses(const std::vector<v1::Input>& inputs, const std::string& simulator) {
  std::vector<bool> all;
  for (const v1::Input& input : inputs) {
    if (input.has_liveliness() && input.liveliness().simulator_id() == SimulatorId(simulator)) {
      all.push_back(input.liveliness().alive());
    }
  }
  return all;
}

/// Whether a simulator's end was told in the name of whoever wrote its clock.
bool OneSender(const std::vector<v1::Input>& inputs) {
  std::set<std::uint64_t> senders;
  for (const v1::Input& input : inputs) senders.insert(input.sender());
  return senders.size() == 1 && *senders.begin() != 0;
}

void PublishStatus(DdsBus& bus) {
  v1::Output output;
  output.mutable_service_status()->set_world(TestWorld());
  bus.Publish(output);
  bus.Flush();
}

TEST(DdsBusLiveliness, ADisposedAgentArrivesAsRemoval) {
  DdsBus bus(TestWorld(), TestDomain());
  DdsSession simulator(SimulatorOptions("a"));
  simulator.Write(Description("a", 3));
  simulator.Write(Description("a", 4));
  simulator.Flush();
  std::vector<v1::Input> inputs;
  ASSERT_TRUE(ReceiveUntil(bus, &inputs, [&] { return inputs.size() >= 2; }));
  const std::uint64_t sender = inputs[0].sender();
  inputs.clear();
  simulator.RemoveAgent(SimulatorId("a"), 3);
  simulator.Flush();
  ASSERT_TRUE(ReceiveUntil(bus, &inputs, [&] { return !inputs.empty(); }));
  ASSERT_EQ(inputs.size(), 1u);
  EXPECT_EQ(inputs[0].sender(), sender);
  EXPECT_EQ(inputs[0].agent_removal().simulator_id(), SimulatorId("a"));
  EXPECT_EQ(inputs[0].agent_removal().slot(), 3u);
}

TEST(DdsBusLiveliness, ARemovalBeforeAnybodyReadComesAfterTheDescription) {
  DdsBus bus(TestWorld(), TestDomain());
  DdsSession simulator(SimulatorOptions("a"));
  simulator.Write(Description("a", 3));
  simulator.RemoveAgent(SimulatorId("a"), 3);
  simulator.Flush();
  std::vector<v1::Input> inputs;
  ASSERT_TRUE(
      ReceiveUntil(bus, &inputs, [&] { return Count(inputs, v1::Input::kAgentRemoval) > 0; }));
  EXPECT_TRUE(inputs.back().has_agent_removal());
  EXPECT_EQ(inputs.back().agent_removal().slot(), 3u);
}

TEST(DdsBusLiveliness, ASimulatorThatLeavesAndReturnsIsToldOnceEachAndItsAgentsStay) {
  DdsBus bus(TestWorld(), TestDomain());
  std::vector<v1::Input> inputs;
  for (std::size_t visit = 1; visit <= 2; ++visit) {
    {
      DdsSession simulator(SimulatorOptions("a"));
      simulator.Write(Description("a", 0));
      simulator.Write(SimulatorTime("a", 1));
      simulator.Flush();
      ASSERT_TRUE(ReceiveUntil(bus, &inputs,
                               [&] { return Count(inputs, v1::Input::kSimulatorClock) == visit; }));
    }
    ASSERT_TRUE(ReceiveUntil(bus, &inputs,
                             [&] { return Livelinesses(inputs, "a").size() >= 2 * visit - 1; }));
    if (visit == 1) {
      EXPECT_TRUE(OneSender(inputs));
    }
  }
  EXPECT_EQ(Livelinesses(inputs, "a"), (std::vector<bool>{false, true, false}));
  EXPECT_EQ(Count(inputs, v1::Input::kAgentRemoval), 0u);
}

TEST(DdsBusLiveliness, AKilledSimulatorIsGoneAfterItsLeaseAndItsAgentsStay) {
  DdsBus bus(TestWorld(), TestDomain());
  PublishStatus(bus);
  ChildSimulator child(0);
  std::vector<v1::Input> inputs;
  ASSERT_TRUE(
      ReceiveUntil(bus, &inputs, [&] { return Count(inputs, v1::Input::kSimulatorClock) > 0; }));
  EXPECT_TRUE(Livelinesses(inputs, "child").empty());
  child.Kill();
  ASSERT_TRUE(ReceiveUntil(bus, &inputs, [&] { return !Livelinesses(inputs, "child").empty(); }));
  EXPECT_EQ(Livelinesses(inputs, "child"), std::vector<bool>{false});
  EXPECT_TRUE(OneSender(inputs));
  EXPECT_EQ(Count(inputs, v1::Input::kAgentRemoval), 0u);
}

// A process that stands still acknowledges nothing: unless told otherwise, Cyclone DDS makes the
// writer wait.
TEST(DdsBusLiveliness, AStoppedProcessHoldsUpNobodyAndCatchesUp) {
  constexpr std::size_t kEvents = 4000;
  DdsBus bus(TestWorld(), TestDomain());
  PublishStatus(bus);
  ChildSimulator child(kEvents);
  DdsSession monitor(MonitorOptions(false));
  std::vector<v1::Input> inputs;
  const auto clock = [&](std::int64_t ns) {
    return [&inputs, ns] {
      return std::any_of(inputs.begin(), inputs.end(), [ns](const v1::Input& input) {
        return input.has_simulator_clock() && input.simulator_clock().clock_ns() == ns;
      });
    };
  };
  ASSERT_TRUE(ReceiveUntil(bus, &inputs, clock(1)));
  child.Stop();
  std::vector<v1::Output> outputs;
  for (std::uint32_t slot = 0; slot < kEvents; ++slot) {
    v1::Output output;
    output.mutable_collision_event()->set_pair_slot(slot);
    output.mutable_collision_event()->add_extensions()->set_value(std::string(256, 'x'));
    bus.Publish(output);
    if (slot % 100 == 0) bus.Flush();
  }
  bus.Flush();
  EXPECT_EQ(bus.counters().writes_failed, 0u);
  EXPECT_TRUE(ReceiveUntil(monitor, &outputs,
                           [&] { return Count(outputs, v1::Output::kCollisionEvent) == kEvents; }));
  child.Continue();
  EXPECT_TRUE(ReceiveUntil(bus, &inputs, clock(2)));
}

TEST(DdsBusLiveliness, AClientKnowsWhetherAServiceIsThere) {
  DdsSession simulator(SimulatorOptions("a"));
  EXPECT_FALSE(simulator.service_present());
  std::vector<v1::Output> outputs;
  {
    DdsBus bus(TestWorld(), TestDomain());
    PublishStatus(bus);
    EXPECT_TRUE(ReceiveUntil(simulator, &outputs, [&] { return simulator.service_present(); }));
  }
  EXPECT_TRUE(ReceiveUntil(simulator, &outputs, [&] { return !simulator.service_present(); }));
}

}  // namespace
}  // namespace collision::server
