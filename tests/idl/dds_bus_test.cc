// Goal:   what one program writes reaches the others as idl/PROTOCOL.md says: complete, from
//         a known sender, to those of its world only.
// Method: real DDS on loopback, several participants in one process, each test in a domain and
//         world of its own; waiting loops with a deadline.
#include "server/bus/dds_bus.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <future>
#include <stdexcept>

#include "idl/identity.h"
#include "idl/limits.h"
#include "tests/idl/dds_bus_support.h"
#include "tests/idl/random_message.h"

namespace collision::server {
namespace {

constexpr std::size_t kNoLimit = 1'000'000;

/// A message with random contents and the key under which a test looks for it.
template <class Message>
Message RandomMessage(std::uint64_t seed) {
  Random random(seed);
  Message message;
  FillRandomly(random, {}, &message);
  return message;
}

TEST(DdsBus, WhatASimulatorWritesArrivesWithOneSender) {
  DdsBus bus(TestWorld(), TestDomain());
  DdsSession a(SimulatorOptions("a"));
  DdsSession b(SimulatorOptions("b"));
  for (DdsSession* session : {&a, &b}) {
    const std::string name = session == &a ? "a" : "b";
    session->Write(Description(name, 0));
    session->Write(States(name, 1));
    session->Write(SimulatorTime(name, 1));
    session->Flush();
  }
  std::vector<v1::Input> inputs;
  ASSERT_TRUE(ReceiveUntil(bus, &inputs, [&] { return inputs.size() >= 6; }));
  std::set<std::uint64_t> of_a, of_b;
  for (const v1::Input& input : inputs) {
    std::uint64_t simulator = 0;
    if (input.has_agent_description()) simulator = input.agent_description().simulator_id();
    if (input.has_agent_states()) simulator = input.agent_states().simulator_id();
    if (input.has_simulator_clock()) simulator = input.simulator_clock().simulator_id();
    (simulator == SimulatorId("a") ? of_a : of_b).insert(input.sender());
  }
  EXPECT_EQ(inputs.size(), 6u);
  ASSERT_EQ(of_a.size(), 1u);
  ASSERT_EQ(of_b.size(), 1u);
  EXPECT_NE(*of_a.begin(), *of_b.begin());
  EXPECT_NE(*of_a.begin(), 0u);
}

TEST(DdsBus, InputsCrossBitForBit) {
  DdsBus bus(TestWorld(), TestDomain());
  DdsSession simulator(SimulatorOptions("a"));
  std::set<std::string> written;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    v1::Input input;
    *input.mutable_agent_description() = RandomMessage<v1::AgentDescription>(seed);
    simulator.Write(input.agent_description());
    written.insert(input.SerializeAsString());
    *input.mutable_shape_part() = RandomMessage<v1::ShapePart>(seed);
    simulator.Write(input.shape_part());
    written.insert(input.SerializeAsString());
    *input.mutable_agent_states() = RandomMessage<v1::AgentStates>(seed);
    simulator.Write(input.agent_states());
    written.insert(input.SerializeAsString());
    *input.mutable_simulator_clock() = RandomMessage<v1::SimulatorClock>(seed);
    simulator.Write(input.simulator_clock());
    written.insert(input.SerializeAsString());
  }
  simulator.Flush();
  std::vector<v1::Input> inputs;
  ASSERT_TRUE(ReceiveUntil(bus, &inputs, [&] { return inputs.size() >= written.size(); }));
  std::set<std::string> received;
  for (v1::Input& input : inputs) {
    input.clear_sender();
    received.insert(input.SerializeAsString());
  }
  EXPECT_EQ(received, written);
}

TEST(DdsBus, OutputsCrossBitForBit) {
  DdsBus bus(TestWorld(), TestDomain());
  DdsSession monitor(MonitorOptions(false));
  std::set<std::string> written;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    v1::Output output;
    *output.mutable_clearance() = RandomMessage<v1::Clearance>(seed);
    bus.Publish(output);
    written.insert(output.SerializeAsString());
    *output.mutable_earliest_intersection() = RandomMessage<v1::EarliestIntersection>(seed);
    bus.Publish(output);
    written.insert(output.SerializeAsString());
    *output.mutable_collision_event() = RandomMessage<v1::CollisionEvent>(seed);
    bus.Publish(output);
    written.insert(output.SerializeAsString());
    *output.mutable_service_status() = RandomMessage<v1::ServiceStatus>(seed);
    bus.Publish(output);
    written.insert(output.SerializeAsString());
  }
  bus.Flush();
  std::vector<v1::Output> outputs;
  ASSERT_TRUE(ReceiveUntil(monitor, &outputs, [&] { return outputs.size() >= written.size(); }));
  std::set<std::string> received;
  for (const v1::Output& output : outputs) received.insert(output.SerializeAsString());
  EXPECT_EQ(received, written);
}

TEST(DdsBus, ASimulatorHearsEventsAndItsOwnClearancesAndRejections) {
  DdsBus bus(TestWorld(), TestDomain());
  DdsSession simulator(SimulatorOptions("a"));
  DdsSession monitor(MonitorOptions(false));

  for (const char* name : {"b", "a"}) {
    v1::Output output;
    output.mutable_clearance()->set_simulator_id(SimulatorId(name));
    bus.Publish(output);
    output.mutable_rejection()->set_simulator_id(SimulatorId(name));
    bus.Publish(output);
  }
  v1::Output event;
  event.mutable_collision_event()->set_contact(1);
  bus.Publish(event);
  bus.Flush();
  std::vector<v1::Output> heard, seen;
  ASSERT_TRUE(ReceiveUntil(simulator, &heard, [&] { return heard.size() >= 3; }));
  ASSERT_TRUE(ReceiveUntil(monitor, &seen, [&] { return seen.size() >= 5; }));
  EXPECT_EQ(heard.size(), 3u);
  for (const v1::Output& output : heard) {
    if (output.has_clearance()) {
      EXPECT_EQ(output.clearance().simulator_id(), SimulatorId("a"));
    }
    if (output.has_rejection()) {
      EXPECT_EQ(output.rejection().simulator_id(), SimulatorId("a"));
    }
  }
  EXPECT_EQ(Count(seen, v1::Output::kClearance), 2u);
  EXPECT_EQ(Count(seen, v1::Output::kRejection), 2u);
}

TEST(DdsBus, AMonitorMaySeeTheSimulatorsToo) {
  DdsSession simulator(SimulatorOptions("a"));
  DdsSession monitor(MonitorOptions(true));
  simulator.Write(Description("a", 7));
  simulator.Flush();
  std::vector<v1::Input> inputs;
  std::vector<v1::Output> outputs;
  const auto end = std::chrono::steady_clock::now() + kDeadline;
  while (inputs.empty() && std::chrono::steady_clock::now() < end) {
    monitor.Receive(kShort, kNoLimit, &inputs, &outputs);
  }
  ASSERT_EQ(inputs.size(), 1u);
  EXPECT_EQ(inputs[0].agent_description().slot(), 7u);
}

TEST(DdsBus, ALateReaderReceivesTheNewestSamples) {
  DdsSession simulator(SimulatorOptions("a"));
  for (std::uint64_t sequence = 1; sequence <= 3; ++sequence)
    simulator.Write(States("a", sequence));
  for (std::uint32_t slot = 0; slot < 100; ++slot) simulator.Write(Description("a", slot));
  simulator.Write(SimulatorTime("a", 5));
  simulator.Flush();
  DdsBus bus(TestWorld(), TestDomain());
  std::vector<v1::Input> inputs;
  ASSERT_TRUE(ReceiveUntil(bus, &inputs, [&] { return inputs.size() >= 102; }));
  ASSERT_EQ(Count(inputs, v1::Input::kAgentStates), 1u);
  EXPECT_EQ(Count(inputs, v1::Input::kAgentDescription), 100u);
  for (const v1::Input& input : inputs) {
    if (input.has_agent_states()) {
      EXPECT_EQ(input.agent_states().states(0).sequence(), 3u);
    }
  }
}

// Goal:   simulators of ever-new names take no memory of the service after they have left.
// Method: readers that join later are told nothing of one that is forgotten, once what was written
//         about it has been acknowledged; what is written about another one comes last.
TEST(DdsBus, WhatIsForgottenIsNotToldToALateReader) {
  DdsBus bus(TestWorld(), TestDomain());
  const auto publish = [&](std::uint64_t simulator) {
    v1::Output report, clearance;
    report.mutable_simulator_report()->set_simulator_id(simulator);
    bus.Publish(report);
    for (const std::uint32_t chunk : {0u, 1023u}) {
      clearance.mutable_clearance()->set_simulator_id(simulator);
      clearance.mutable_clearance()->set_chunk(chunk);
      bus.Publish(clearance);
    }
    for (const std::uint32_t slot : {0u, 70'000u}) {
      v1::Output breach;
      breach.mutable_agent_breach()->set_simulator_id(simulator);
      breach.mutable_agent_breach()->set_slot(slot);
      bus.Publish(breach);
    }
  };
  const std::uint64_t gone = 1, there = 2;
  publish(gone);
  bus.Forget(gone);
  bus.Forget(3);
  publish(there);
  bus.Flush();
  const auto told = [](const std::vector<v1::Output>& outputs, std::uint64_t simulator) {
    return std::count_if(outputs.begin(), outputs.end(), [&](const v1::Output& output) {
      return output.simulator_report().simulator_id() == simulator ||
             output.clearance().simulator_id() == simulator ||
             output.agent_breach().simulator_id() == simulator;
    });
  };
  std::vector<v1::Output> heard;
  const auto end = std::chrono::steady_clock::now() + kDeadline;
  do {
    DdsSession late(MonitorOptions(false));
    heard.clear();
    ASSERT_TRUE(ReceiveUntil(late, &heard, [&] { return told(heard, there) == 5; }));
  } while (told(heard, gone) > 0 && std::chrono::steady_clock::now() < end);
  EXPECT_EQ(told(heard, gone), 0);
}

TEST(DdsBus, WorldsDoNotMix) {
  DdsBus here(TestWorld(), TestDomain());
  DdsBus there(TestWorld() + "-b", TestDomain());
  DdsSession simulator(SimulatorOptions("a"));
  DdsSessionOptions options = MonitorOptions(true);
  options.world += "-b";
  DdsSession stranger(options);
  simulator.Write(Description("a", 0));
  simulator.Flush();
  v1::Output output;
  output.mutable_service_status();
  here.Publish(output);
  here.Flush();
  // The clock of a second simulator, written later, is the sign that the other world would have
  // heard.
  options.role = DdsRole::kSimulator;
  options.simulator = "z";
  DdsSession elsewhere(options);
  elsewhere.Write(SimulatorTime("z", 1));
  elsewhere.Flush();
  std::vector<v1::Input> inputs, of_here, of_stranger;
  std::vector<v1::Output> outputs;
  ASSERT_TRUE(ReceiveUntil(here, &of_here, [&] { return !of_here.empty(); }));
  ASSERT_TRUE(ReceiveUntil(there, &inputs, [&] { return !inputs.empty(); }));
  stranger.Receive(kShort, kNoLimit, &of_stranger, &outputs);
  EXPECT_EQ(Count(inputs, v1::Input::kSimulatorClock), 1u);
  EXPECT_EQ(inputs.size(), 1u);
  EXPECT_EQ(of_here.size(), 1u);
  EXPECT_EQ(Count(of_stranger, v1::Input::kAgentDescription), 0u);
  EXPECT_TRUE(outputs.empty());
}

TEST(DdsBus, ReceiveTakesNoMoreThanItsLimitAndKeepsTheRest) {
  DdsBus bus(TestWorld(), TestDomain());
  DdsSession simulator(SimulatorOptions("a"));
  for (std::uint32_t slot = 0; slot < 9; ++slot) simulator.Write(Description("a", slot));
  simulator.Write(SimulatorTime("a", 1));
  simulator.Flush();
  std::vector<v1::Input> inputs;
  const auto end = std::chrono::steady_clock::now() + kDeadline;
  while (inputs.size() < 10 && std::chrono::steady_clock::now() < end) {
    const std::size_t before = inputs.size();
    bus.Receive(kShort, 3, &inputs);
    EXPECT_LE(inputs.size(), before + 3);
  }
  EXPECT_EQ(inputs.size(), 10u);
}

TEST(DdsBus, AReaderThatNeverReadsDelaysNoOther) {
  DdsBus bus(TestWorld(), TestDomain());
  DdsSession sleeper(MonitorOptions(false));
  DdsSession reader(MonitorOptions(false));
  std::vector<v1::Output> outputs;
  for (std::uint32_t revision = 1; revision <= 1000; ++revision) {
    v1::Output output;
    output.mutable_earliest_intersection()->set_now_ns(revision);
    bus.Publish(output);
    output.mutable_collision_event()->set_revision(revision);
    bus.Publish(output);
    bus.Flush();
    reader.Receive(std::chrono::nanoseconds(0), kNoLimit, nullptr, &outputs);
  }
  EXPECT_EQ(bus.counters().writes_failed, 0u);
  const auto ends = [&] {
    return !outputs.empty() && outputs.back().has_collision_event() &&
           outputs.back().collision_event().revision() == 1000;
  };
  ASSERT_TRUE(ReceiveUntil(reader, &outputs, ends));
  outputs.clear();
  sleeper.Receive(kShort, kNoLimit, nullptr, &outputs);
  ASSERT_EQ(outputs.size(), 64u + wire::kForecastsKept);  // its depths: the newest
  EXPECT_EQ(outputs[63].earliest_intersection().now_ns(), 1000);
  EXPECT_EQ(outputs.back().collision_event().revision(), 1000u);
}

Bus* signalled = nullptr;
void OnSignal(int) { signalled->Wake(); }

TEST(DdsBus, WakeEndsAReceiveThatWaits) {
  DdsBus bus(TestWorld(), TestDomain());
  const auto wait = [&] {
    std::vector<v1::Input> inputs;
    return bus.Receive(std::chrono::nanoseconds::max(), kNoLimit, &inputs) && inputs.empty();
  };
  bus.Wake();  // before
  EXPECT_TRUE(wait());
  auto waiting = std::async(std::launch::async, wait);
  bus.Wake();  // meanwhile
  ASSERT_EQ(waiting.wait_for(kDeadline), std::future_status::ready);
  signalled = &bus;
  const auto previous = std::signal(SIGUSR1, OnSignal);
  waiting = std::async(std::launch::async, wait);
  std::raise(SIGUSR1);
  std::signal(SIGUSR1, previous);
  EXPECT_EQ(waiting.wait_for(kDeadline), std::future_status::ready);
}

TEST(DdsSession, WhatIsNotOfTheRoleIsAnError) {
  DdsSession monitor(MonitorOptions(false));
  EXPECT_THROW(monitor.Write(Description("a", 0)), std::logic_error);
  EXPECT_THROW(monitor.RemoveAgent({}), std::logic_error);
}

TEST(DdsSession, BadOptionsSayWhatIsAllowed) {
  EXPECT_THROW(DdsBus("", TestDomain()), std::runtime_error);
  EXPECT_THROW(DdsBus("a.b", TestDomain()), std::runtime_error);
  EXPECT_THROW(DdsBus("*", TestDomain()), std::runtime_error);
  EXPECT_THROW(DdsBus(std::string(65, 'a'), TestDomain()), std::runtime_error);
  EXPECT_NO_THROW(DdsBus(std::string(64, 'a'), TestDomain()));
  EXPECT_THROW(DdsBus(TestWorld(), TestDomain(), {.lease = std::chrono::nanoseconds(0)}),
               std::runtime_error);
  EXPECT_THROW(DdsSession(SimulatorOptions("")), std::runtime_error);
  try {
    DdsBus(TestWorld(), 231);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "DDS domain 231: allowed are 0 to 230");
  }
}

TEST(DdsSession, WithoutItsInterfaceThereIsNoDds) {
  setenv("CYCLONEDDS_URI",
         "<CycloneDDS><Domain><General><Interfaces><NetworkInterface "
         "name=\"none0\"/></Interfaces></General>"
         "</Domain></CycloneDDS>",
         1);
  EXPECT_THROW(DdsBus(TestWorld(), TestDomain()), std::runtime_error);
  setenv("CYCLONEDDS_URI", COLLISION_DDS_LOOPBACK, 1);
}

// Both settings files that we hand out are understood by Cyclone DDS, which refuses unknown
// elements.
TEST(DdsSession, TheLanProfileIsWellFormed) {
  const std::string loopback_only =
      ",<CycloneDDS><Domain Id=\"any\"><General><Interfaces><NetworkInterface "
      "name=\"lo\"/></Interfaces>"
      "</General></Domain></CycloneDDS>";
  setenv("CYCLONEDDS_URI", (COLLISION_DDS_LAN + loopback_only).c_str(), 1);
  EXPECT_NO_THROW(DdsBus(TestWorld(), TestDomain()));
  setenv("CYCLONEDDS_URI", COLLISION_DDS_LOOPBACK, 1);
}

// Readers of the status ask for a lease of 2 s: they would not match a longer one.
TEST(DdsBus, AServiceHasNoLongerLeaseThanItsReadersAskFor) {
  const DdsBus bus(TestWorld(), TestDomain(), {.lease = std::chrono::seconds(2)});
  EXPECT_THROW(
      DdsBus(TestWorld(), TestDomain(), {.lease = std::chrono::nanoseconds(2'000'000'001)}),
      std::runtime_error);
}

}  // namespace
}  // namespace collision::server
