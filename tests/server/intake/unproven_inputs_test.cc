#include "server/intake/unproven_inputs.h"

#include <gtest/gtest.h>

#include "tests/server/messages.h"
#include "tests/server/scripted_bus.h"
#include "tests/server/shapes/shapes.h"

namespace collision::server {
namespace {

constexpr std::size_t kInputsMax = kUnprovenBytesMax / kUnprovenInputBytesMin;
constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::uint64_t kAlpha = 10, kBeta = 20, kGhost = 66;  // senders

v1::Input StateOf(std::uint64_t sender, std::uint32_t slot) {
  return From(sender, State(slot, 0, slot + 1), "alpha");
}

/// One state under an id that no name has.
v1::Input Ghost(std::uint64_t id) {
  v1::Input ghost = From(kGhost, State(0, 0, 1), "alpha");
  ghost.mutable_agent_states()->set_simulator_id(id);
  return ghost;
}

// Goal:   ids that no name has proved do not take the places of simulators, and leave nothing.
// Method: as many ghosts as there may be simulators, in a world for one; then that one.
TEST(UnprovenInputs, GhostsDoNotCloseTheWorld) {
  v1::Config config = Simulated();
  config.set_simulators_max(1);
  ScriptedDaemon daemon(config);
  std::vector<v1::Input> ghosts;
  for (std::uint64_t id = 1; id <= 64; ++id) ghosts.push_back(Ghost(id));
  daemon.Step(ghosts);
  daemon.Step(AlphaJoins(kAlpha));
  EXPECT_TRUE(daemon.rejections().empty());
  v1::ServiceStatus status = daemon.status();
  ASSERT_EQ(status.simulators_size(), 1);
  EXPECT_EQ(status.simulators(0).name(), "alpha");
  EXPECT_EQ(status.agents(), 2u);
  EXPECT_EQ(daemon.counter("unproven_inputs"), 64u);

  daemon.Step({}, 1e-9 * kUnprovenTime);
  EXPECT_EQ(daemon.counter("unproven_inputs"), 0u);
  EXPECT_EQ(daemon.counter("unproven_dropped"), 64u);
  EXPECT_EQ(daemon.status().agents(), 2u);
}

// Goal:   the order in which topics arrive makes no difference: states, parts of a shape and a
//         removal that precede the name count as soon as it is there, and are not refused.
TEST(UnprovenInputs, WhatPrecedesTheNameCounts) {
  const std::string bytes = EncodeShape(Cube(1));
  const std::vector<v1::Input> described = {From(kAlpha, Shaped("alpha", 0, bytes)),
                                            From(kAlpha, Description("alpha", 1)),
                                            From(kAlpha, ClockAfter("alpha", 0, 2, 3))};
  v1::Input removal = Removal(kAlpha, "alpha", 2);
  removal.mutable_agent_removal()->set_sequence(3);
  ScriptedDaemon daemon(Simulated());
  daemon.Step(From(kAlpha, PartsOf("alpha", bytes)));
  daemon.Step({StateOf(kAlpha, 0)});
  daemon.Step({StateOf(kAlpha, 1), removal});
  EXPECT_EQ(daemon.status().simulators_size(), 0);
  daemon.Step(described);
  EXPECT_EQ(daemon.status().agents(), 2u);
  EXPECT_EQ(daemon.counter("shapes"), 1u);
  EXPECT_EQ(daemon.counter("unproven_inputs"), 0u);
  EXPECT_TRUE(daemon.rejections().empty());
}

// Goal:   a name proves what its own sender wrote, and nothing else: another sender's states of the
//         same id change nothing.
TEST(UnprovenInputs, ANameProvesItsOwnSenderOnly) {
  ScriptedDaemon daemon(Simulated());
  daemon.Step({StateOf(kGhost, 1)});
  daemon.Step({From(kAlpha, Description("alpha", 0)), From(kAlpha, Description("alpha", 1)),
               StateOf(kAlpha, 0), From(kAlpha, ClockAfter("alpha", 0, 1, 2))});
  EXPECT_EQ(daemon.status().agents(), 1u);
  EXPECT_EQ(daemon.counter("unproven_inputs"), 1u);
  daemon.Step({Liveliness(kGhost, "alpha", false)});
  EXPECT_EQ(daemon.counter("unproven_inputs"), 0u);
}

// Goal:   states alone do not take over the id of a simulator that has ended: its agents stay until
//         a successor names itself, whose earlier states then count.
TEST(UnprovenInputs, StatesDoNotTakeOverAnIdThatIsFree) {
  ScriptedDaemon daemon(Simulated());
  daemon.Step(AlphaJoins(kAlpha));
  daemon.Step({Liveliness(kAlpha, "alpha", false)});
  daemon.Step({From(kBeta, State(0, 0, 1), "alpha", 2)});
  EXPECT_EQ(daemon.status().agents(), 2u);
  EXPECT_EQ(daemon.status().simulators(0).run(), 1u);
  daemon.Step({From(kBeta, Description("alpha", 0, 2)), From(kBeta, ClockOf("alpha", 0, 2))});
  EXPECT_EQ(daemon.status().simulators(0).run(), 2u);
  EXPECT_EQ(daemon.status().agents(), 1u);
  EXPECT_TRUE(daemon.rejections().empty());
}

// Goal:   a simulator that named itself too late is told that it must write again.
TEST(UnprovenInputs, WhatDidNotFitIsToldWhenTheNameComes) {
  ScriptedDaemon daemon(Simulated());
  std::vector<v1::Input> states(kInputsMax + 3, StateOf(kAlpha, 0));
  daemon.Step(states);
  EXPECT_EQ(daemon.counter("unproven_dropped"), 3u);
  EXPECT_TRUE(daemon.rejections().empty());
  daemon.Step({From(kAlpha, Description("alpha", 0))});
  ASSERT_EQ(daemon.rejections().size(), 1u);
  EXPECT_EQ(daemon.rejections()[0].reason(), v1::REJECTED_TOO_MANY_SIMULATORS);
  EXPECT_NE(daemon.rejections()[0].detail().find("3 messages"), std::string::npos);
  EXPECT_EQ(daemon.counter("states_received"), kInputsMax);
}

// Goal:   one sender cannot crowd another out, whatever it writes, nor grow the room.
TEST(UnprovenInputs, TheSenderThatTakesMostLosesItsOldest) {
  UnprovenInputs room;
  room.Add(0, 1, StateOf(kAlpha, 0));
  const std::vector<v1::ShapePart> parts =
      PartsOf("beta", std::string(20 * wire::kShapePartBytes, 'x'));
  for (std::size_t i = 0; i < 1000; ++i) {
    room.Add(1000, 2, From(kBeta, parts[i % parts.size()]));
  }
  EXPECT_LT(room.size(), kUnprovenBytesMax / wire::kShapePartBytes + 2);
  for (std::size_t i = 0; i < 2 * kInputsMax; ++i) room.Add(2000, 3, Ghost(3));
  EXPECT_EQ(room.Take(1, kAlpha).inputs.size(), 1u);
  const UnprovenInputs::Proved beta = room.Take(2, kBeta);
  EXPECT_EQ(beta.inputs.size() + beta.lost, 1000u);
  EXPECT_GT(beta.inputs.size(), kUnprovenBytesMax / wire::kShapePartBytes / 2 - 2);
  const auto last_part = static_cast<std::uint32_t>(999 % parts.size());
  EXPECT_EQ(beta.inputs.back().shape_part().part(), last_part) << "the oldest are lost first";
}

// Goal:   the number of senders is bounded as well, and each is forgotten in time.
TEST(UnprovenInputs, SendersAreBoundedAndForgotten) {
  UnprovenInputs room;
  for (std::uint64_t sender = 1; sender <= kUnprovenSendersMax + 5; ++sender) {
    room.Add(kSecond, 1, StateOf(sender, 0));
  }
  EXPECT_EQ(room.size(), kUnprovenSendersMax);
  EXPECT_EQ(room.dropped(), 5u);
  EXPECT_EQ(room.NextDue(), kSecond + kUnprovenTime);
  EXPECT_EQ(room.DropOverdue(kSecond + kUnprovenTime - 1), 0u);
  EXPECT_EQ(room.DropOverdue(kSecond + kUnprovenTime), kUnprovenSendersMax);
  EXPECT_EQ(room.NextDue(), std::nullopt);
}

}  // namespace
}  // namespace collision::server
