// Goal:   an operator sees in one line what the service does, and in the log all that it knows.
#include "server/publish/text/state_lines.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/server/messages.h"
#include "tests/server/scripted_bus.h"

namespace collision::server {
namespace {

TEST(StateLines, SayWhatIsThere) {
  ScriptedDaemon daemon(Simulated());
  daemon.Step({});
  EXPECT_EQ(daemon.daemon().StatusLine(), "0 simulators, 0 agents, time has not begun");
  daemon.Step(AlphaJoins(1));
  daemon.Step({});
  // 100 m apart, radius 1 m each, at rest, 2 m/s²: they touch at the earliest after 7 s; rounded
  // down.
  EXPECT_EQ(daemon.daemon().StatusLine(), "1 simulator, 2 agents, next contact not before 6.9 s");
  const std::vector<std::string> lines = daemon.daemon().StateLines();
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[0].front(), '{');
  EXPECT_NE(lines[0].find("\"name\":\"alpha\""), std::string::npos) << lines[0];
  EXPECT_NE(lines[1].find("agent \"agent 0\" of \"alpha\", slot 0 generation 1: newest state "
                          "0.000 s, clear until 7.000 s, 0 breaches"),
            std::string::npos)
      << lines[1];
}

TEST(StateLines, AreBounded) {
  World world(CompleteConfig(Simulated()));
  const std::string name = "alpha";
  Simulator* simulator = world.ClaimFor(SimulatorId(name), 1, 1, &name).simulator;
  for (std::uint32_t slot = 0; slot < 5; ++slot) {
    simulator->agents().Add(slot, Agent(1, 1, {}));
  }
  const std::vector<std::string> lines = StateLines(v1::ServiceStatus(), world, 2);
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_EQ(lines[3], "and 3 more agents");
}

}  // namespace
}  // namespace collision::server
