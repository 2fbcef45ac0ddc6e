// Goal:   a program that leaves, dies, stops or comes back is reported as such; no other is.
// Method: a second session in this process that is destroyed, and a child process that is killed or
// stopped.
#include <gtest/gtest.h>

#include <algorithm>
#include <future>
#include <optional>
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

/// The senders whose end was reported.
std::vector<std::uint64_t> Gone(const std::vector<v1::Input>& inputs) {
  std::vector<std::uint64_t> all;
  for (const v1::Input& input : inputs) {
    if (input.has_liveliness() && !input.liveliness().alive()) all.push_back(input.sender());
  }
  return all;
}

/// The sender of a clock of this time.
std::set<std::uint64_t> SendersOfClock(const std::vector<v1::Input>& inputs,
                                       std::int64_t clock_ns) {
  std::set<std::uint64_t> all;
  for (const v1::Input& input : inputs) {
    if (input.has_simulator_clock() && input.simulator_clock().clock_ns() == clock_ns)
      all.insert(input.sender());
  }
  return all;
}

/// Whether a simulator's end was reported for the sender of its clock.
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
  simulator.RemoveAgent(RemovalOf("a", 3));
  simulator.Flush();
  ASSERT_TRUE(ReceiveUntil(bus, &inputs, [&] { return !inputs.empty(); }));
  ASSERT_EQ(inputs.size(), 1u);
  EXPECT_EQ(inputs[0].sender(), sender);
  EXPECT_EQ(inputs[0].agent_removal().simulator_id(), SimulatorId("a"));
  EXPECT_EQ(inputs[0].agent_removal().slot(), 3u);
  EXPECT_EQ(inputs[0].agent_removal().incarnation(), kIncarnation);
  EXPECT_EQ(inputs[0].agent_removal().sequence(), kRemovalSequence);
}

TEST(DdsBusLiveliness, ARemovalBeforeTheFirstReadComesAfterTheDescription) {
  DdsBus bus(TestWorld(), TestDomain());
  DdsSession simulator(SimulatorOptions("a"));
  simulator.Write(Description("a", 3));
  simulator.RemoveAgent(RemovalOf("a", 3));
  simulator.Flush();
  std::vector<v1::Input> inputs;
  ASSERT_TRUE(
      ReceiveUntil(bus, &inputs, [&] { return Count(inputs, v1::Input::kAgentRemoval) > 0; }));
  EXPECT_TRUE(inputs.back().has_agent_removal());
  EXPECT_EQ(inputs.back().agent_removal().slot(), 3u);
}

// Goal:   a description that its removal has overwritten is not lost.
TEST(DdsBusLiveliness, ADescriptionWrittenWithTheRemovalComesBeforeIt) {
  DdsBus bus(TestWorld(), TestDomain());
  DdsSession simulator(SimulatorOptions("a"));
  v1::AgentRemoval removal = RemovalOf("a", 3);
  *removal.mutable_description() = Description("a", 3);
  removal.mutable_description()->set_radius_m(7);
  simulator.RemoveAgent(removal);
  simulator.Flush();
  std::vector<v1::Input> inputs;
  ASSERT_TRUE(
      ReceiveUntil(bus, &inputs, [&] { return Count(inputs, v1::Input::kAgentRemoval) > 0; }));
  ASSERT_EQ(inputs.size(), 2u);
  EXPECT_EQ(inputs[0].agent_description().radius_m(), 7);
  EXPECT_EQ(inputs[0].agent_description().slot(), 3u);
  EXPECT_EQ(inputs[0].agent_description().sequence(), kRemovalSequence);
  EXPECT_EQ(inputs[1].agent_removal().sequence(), kRemovalSequence);
}

// Goal:   a service that comes later hears of removals, too: a clock may wait for one of them.
TEST(DdsBusLiveliness, ARemovalReachesALateReader) {
  DdsSession simulator(SimulatorOptions("a"));
  simulator.Write(Description("a", 3));
  simulator.RemoveAgent(RemovalOf("a", 3));
  simulator.Flush();
  DdsBus bus(TestWorld(), TestDomain());
  std::vector<v1::Input> inputs;
  ASSERT_TRUE(ReceiveUntil(bus, &inputs, [&] { return !inputs.empty(); }));
  ASSERT_TRUE(inputs[0].has_agent_removal()) << inputs[0].ShortDebugString();
  EXPECT_EQ(inputs[0].agent_removal().sequence(), kRemovalSequence);
}

TEST(DdsBusLiveliness, EachProgramThatLeavesIsReportedOnceAndItsAgentsStay) {
  DdsBus bus(TestWorld(), TestDomain());
  std::vector<v1::Input> inputs;
  for (std::size_t visit = 1; visit <= 2; ++visit) {
    {
      DdsSession simulator(SimulatorOptions("a"));
      simulator.Write(Description("a", 0));
      simulator.Write(SimulatorTime("a", visit));
      simulator.Flush();
      ASSERT_TRUE(ReceiveUntil(bus, &inputs,
                               [&] { return Count(inputs, v1::Input::kSimulatorClock) == visit; }));
    }
    ASSERT_TRUE(ReceiveUntil(bus, &inputs, [&] { return Gone(inputs).size() >= visit; }));
    if (visit == 1) {
      EXPECT_TRUE(OneSender(inputs));
    }
  }
  ASSERT_EQ(Gone(inputs).size(), 2u);
  EXPECT_EQ(std::set<std::uint64_t>{Gone(inputs)[0]}, SendersOfClock(inputs, 1));
  EXPECT_EQ(std::set<std::uint64_t>{Gone(inputs)[1]}, SendersOfClock(inputs, 2));
  EXPECT_EQ(Livelinesses(inputs, "a"), (std::vector<bool>{false, false}));
  EXPECT_EQ(Count(inputs, v1::Input::kAgentRemoval), 0u);
}

TEST(DdsBusLiveliness, TheEndOfASenderOfDescriptionsIsReported) {
  DdsBus bus(TestWorld(), TestDomain());
  std::vector<v1::Input> inputs;
  {
    DdsSession simulator(SimulatorOptions("a"));
    simulator.Write(Description("a", 0));
    simulator.Flush();
    ASSERT_TRUE(ReceiveUntil(bus, &inputs, [&] { return !inputs.empty(); }));
  }
  ASSERT_TRUE(ReceiveUntil(bus, &inputs, [&] { return !Gone(inputs).empty(); }));
  EXPECT_TRUE(OneSender(inputs));
}

TEST(DdsBusLiveliness, AWriterThatLeftBeforeTheFirstReadIsKnownAndItsEndReported) {
  DdsBus bus(TestWorld(), TestDomain());
  {
    DdsSession simulator(SimulatorOptions("a"));
    simulator.Write(SimulatorTime("a", 1));
    simulator.Flush();
  }
  std::vector<v1::Input> inputs;
  ASSERT_TRUE(ReceiveUntil(bus, &inputs, [&] { return !Gone(inputs).empty(); }));
  EXPECT_TRUE(OneSender(inputs));
  EXPECT_TRUE(inputs.front().has_simulator_clock());
  EXPECT_EQ(Livelinesses(inputs, "a"), std::vector<bool>{false});
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

// The clock never lacks a writer here: only the dead one's own end says that it is gone. Two end
// before the bus looks, since a status tells the last of several changes only; the witness sees
// when.
TEST(DdsBusLiveliness, KilledSimulatorsAreReportedWhileTheirSuccessorsLive) {
  DdsBus bus(TestWorld(), TestDomain());
  DdsBus witness(TestWorld(), TestDomain());
  PublishStatus(bus);
  ChildSimulator child(0), other(0);
  std::vector<v1::Input> inputs, witnessed;
  std::set<std::uint64_t> old;
  ASSERT_TRUE(
      ReceiveUntil(bus, &inputs, [&] { return (old = SendersOfClock(inputs, 2)).size() == 2; }));
  DdsSession successor(SimulatorOptions("child"));
  successor.Write(SimulatorTime("child", 3));
  successor.Flush();
  const auto told = [&](std::int64_t ns) {
    return [&inputs, ns] { return !SendersOfClock(inputs, ns).empty(); };
  };
  ASSERT_TRUE(ReceiveUntil(bus, &inputs, told(3)));
  EXPECT_TRUE(Gone(inputs).empty());
  ASSERT_TRUE(
      ReceiveUntil(witness, &witnessed, [&] { return SendersOfClock(witnessed, 2).size() == 2; }));
  child.Kill();
  other.Kill();
  ASSERT_TRUE(ReceiveUntil(witness, &witnessed, [&] { return Gone(witnessed).size() >= 2; }));
  ASSERT_TRUE(ReceiveUntil(bus, &inputs, [&] { return Gone(inputs).size() >= 2; }));
  // Nothing false about the new one, which outlived a lease.
  successor.Write(SimulatorTime("child", 4));
  successor.Flush();
  ASSERT_TRUE(ReceiveUntil(bus, &inputs, told(4)));
  const std::vector<std::uint64_t> gone = Gone(inputs);
  EXPECT_EQ(gone.size(), 2u);
  EXPECT_EQ(std::set<std::uint64_t>(gone.begin(), gone.end()), old);
  EXPECT_EQ(Livelinesses(inputs, "child"), (std::vector<bool>{false, false}));
}

TEST(DdsBusLiveliness, AnEndEndsAReceiveThatWaits) {
  DdsBus bus(TestWorld(), TestDomain());
  std::vector<v1::Input> inputs;
  DdsSession first(SimulatorOptions("a"));
  std::optional<DdsSession> second(SimulatorOptions("a"));
  for (DdsSession* session : {&first, &*second}) {
    session->Write(SimulatorTime("a", session == &first ? 1 : 2));
    session->Flush();
  }
  ASSERT_TRUE(
      ReceiveUntil(bus, &inputs, [&] { return Count(inputs, v1::Input::kSimulatorClock) == 2; }));
  auto waiting = std::async(std::launch::async, [&] {
    while (Gone(inputs).empty()) bus.Receive(std::chrono::nanoseconds::max(), 1, &inputs);
  });
  second.reset();
  const auto ended = waiting.wait_for(kDeadline);
  EXPECT_EQ(ended, std::future_status::ready);
  if (ended != std::future_status::ready) {
    first.Write(Description("a", 0));  // wakes it
    first.Flush();
  }
  waiting.get();
  ASSERT_EQ(Gone(inputs).size(), 1u);
  EXPECT_EQ(std::set<std::uint64_t>{Gone(inputs)[0]}, SendersOfClock(inputs, 2));
}

// A process that stands still acknowledges nothing: by default, Cyclone DDS makes the
// writer wait.
TEST(DdsBusLiveliness, AStoppedProcessDelaysNoOtherAndCatchesUp) {
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
  ASSERT_TRUE(ReceiveUntil(bus, &inputs, [&] { return !Gone(inputs).empty(); }));
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
  EXPECT_TRUE(ReceiveUntil(bus, &inputs, [&] { return Livelinesses(inputs, "child").size() > 1; }));
  EXPECT_EQ(Livelinesses(inputs, "child"), (std::vector<bool>{false, true}));
  EXPECT_TRUE(OneSender(inputs));
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
