// Goal:   an operator can evict any simulator and let simulated time begin anew; each command is
//         answered once, and a refusal says what would have been allowed.
// Method: commands as inputs of a daemon, in step with what simulators write.
#include "server/service/operator_commands.h"

#include <gtest/gtest.h>

#include "tests/server/messages.h"
#include "tests/server/scripted_bus.h"

namespace collision::server {
namespace {

std::string AnswerTo(ScriptedDaemon* daemon, const v1::Input& command) {
  daemon->Step({command}, 0.01);
  for (auto output = daemon->bus().outputs.rbegin(); output != daemon->bus().outputs.rend();
       ++output) {
    if (!output->has_service_status()) continue;
    char key[32];
    std::snprintf(key, sizeof key, "operator.%016llx",
                  static_cast<unsigned long long>(command.operator_command().command_id()));
    return Extension(output->service_status(), key);
  }
  return "";
}

TEST(OperatorCommands, EvictRemovesALivingSimulatorAndAHigherRunIsWelcome) {
  ScriptedDaemon daemon(Simulated());
  daemon.Step(AlphaJoins(1), 0.01);
  EXPECT_EQ(AnswerTo(&daemon, Command(7, v1::OPERATOR_EVICT, "alpha")),
            "done: simulator \"alpha\" is removed with its 2 agents; it is welcome again with a "
            "higher run");
  EXPECT_EQ(daemon.status().agents(), 0u);
  EXPECT_EQ(daemon.status().simulators_size(), 0);
  EXPECT_EQ(daemon.counter("simulators_evicted"), 1u);
  daemon.Step({From(1, ClockAfter("alpha", 0, 2, 2)), Liveliness(1, "alpha", true)}, 0.01);
  ASSERT_EQ(daemon.rejections().size(), 1u);
  EXPECT_EQ(daemon.rejections()[0].reason(), v1::REJECTED_OLD_RUN);
  daemon.Step({From(1, Description("alpha", 0, 2))}, 0.01);
  EXPECT_EQ(daemon.rejections().size(), 1u);
  EXPECT_EQ(daemon.status().simulators_size(), 1);
}

TEST(OperatorCommands, AnotherProgramMayTakeTheNameOfTheEvicted) {
  ScriptedDaemon daemon(Simulated());
  daemon.Step(AlphaJoins(1), 0.01);
  AnswerTo(&daemon, Command(7, v1::OPERATOR_EVICT, "alpha"));
  daemon.Step({From(2, Description("alpha", 0, 2))}, 0.01);
  EXPECT_TRUE(daemon.rejections().empty());
}

TEST(OperatorCommands, TheWorldGoesOnWithoutTheEvicted) {
  v1::Config config = Simulated();
  config.mutable_clock()->set_simulators_awaited(2);
  ScriptedDaemon daemon(config);
  daemon.Step(AlphaJoins(1), 0.01);
  daemon.Step({From(2, Description("beta", 0)), From(2, State(0, 0, 1), "beta"),
               From(2, ClockAfter("beta", 0, 1, 1))},
              0.01);
  daemon.Step({From(1, ClockAfter("alpha", 10'000'000, 2, 2)), Liveliness(2, "beta", false)}, 0.01);
  EXPECT_EQ(daemon.status().now_ns(), 0);
  AnswerTo(&daemon, Command(7, v1::OPERATOR_EVICT, "beta"));
  EXPECT_EQ(daemon.status().now_ns(), 10'000'000);
  EXPECT_EQ(daemon.status().stamp().epoch(), 1u);
}

TEST(OperatorCommands, AnUnknownNameIsRefusedWithTheKnownOnes) {
  ScriptedDaemon daemon(Simulated());
  EXPECT_EQ(AnswerTo(&daemon, Command(7, v1::OPERATOR_EVICT, "beta")),
            "refused: no simulator \"beta\" in this world; known: none");
  daemon.Step(AlphaJoins(1), 0.01);
  EXPECT_EQ(AnswerTo(&daemon, Command(8, v1::OPERATOR_EVICT, "beta")),
            "refused: no simulator \"beta\" in this world; known: alpha");
  EXPECT_EQ(AnswerTo(&daemon, Command(9, v1::OPERATOR_EVICT, "a.b\n")),
            "refused: simulator: not a name; allowed: 1 to 64 of A-Z a-z 0-9 _ -");
  v1::Input unknown_kind = Command(10, static_cast<v1::OperatorCommandKind>(7));
  EXPECT_EQ(AnswerTo(&daemon, unknown_kind), "refused: kind: 7; allowed: 0 to 1");
  EXPECT_EQ(daemon.status().agents(), 2u);
}

TEST(OperatorCommands, RestartTimeBeginsANewEpochForEveryone) {
  ScriptedDaemon daemon(Simulated());
  daemon.Step(AlphaJoins(1), 0.01);
  daemon.Step({From(1, ClockAfter("alpha", 16'000'000, 2, 2))}, 0.01);
  ASSERT_EQ(daemon.status().now_ns(), 16'000'000);
  const std::string answer = AnswerTo(&daemon, Command(7, v1::OPERATOR_RESTART_TIME));
  EXPECT_EQ(answer,
            "done: the world's time begins anew with the next first clock; simulators that were in "
            "it, each welcome again with a higher run: 1; others, which had told no clock and go "
            "on: 0");
  EXPECT_EQ(daemon.status().stamp().epoch(), 2u);
  EXPECT_EQ(daemon.status().agents(), 0u);
  // The run of before must not drag its clock into the new time.
  daemon.Step({From(1, ClockAfter("alpha", 17'000'000, 2, 2))}, 0.01);
  EXPECT_EQ(daemon.rejections().back().reason(), v1::REJECTED_OLD_RUN);
  v1::SimulatorClock clock = ClockAfter("alpha", 1'000'000, 0, 1);
  clock.set_run(2);
  daemon.Step({From(1, Description("alpha", 0, 2)), From(1, clock)}, 0.01);
  EXPECT_EQ(daemon.status().now_ns(), 1'000'000);
  EXPECT_EQ(daemon.status().stamp().epoch(), 2u);
}

TEST(OperatorCommands, RestartTimeCountsSimulatorsWithoutAClockApart) {
  ScriptedDaemon daemon(Simulated());
  daemon.Step({From(1, Description("alpha", 0)), From(2, Description("beta", 0))}, 0.01);
  const std::string answer = AnswerTo(&daemon, Command(7, v1::OPERATOR_RESTART_TIME));
  EXPECT_TRUE(
      answer.ends_with("with a higher run: 0; others, which had told no clock and go on: 2"))
      << answer;
  EXPECT_EQ(daemon.status().simulators_size(), 2) << "they go on";
  daemon.Step({From(1, ClockAfter("alpha", 16'000'000, 0, 1))}, 0.01);
  ASSERT_TRUE(daemon.rejections().empty()) << "under the run that they have";
}

TEST(OperatorCommands, AWallClockCannotBeRestarted) {
  v1::Config config;
  config.mutable_clock()->set_kind(v1::Clock::REAL_TIME);
  ScriptedDaemon daemon(config);
  const std::string answer = AnswerTo(&daemon, Command(7, v1::OPERATOR_RESTART_TIME));
  EXPECT_TRUE(answer.starts_with("refused: the world runs in real time")) << answer;
  EXPECT_EQ(daemon.status().stamp().epoch(), 1u);
}

TEST(OperatorCommands, OneCommandIsObeyedOnceAndTheLastAnswersAreShown) {
  ScriptedDaemon daemon(Simulated());
  daemon.Step(AlphaJoins(1), 0.01);
  AnswerTo(&daemon, Command(7, v1::OPERATOR_EVICT, "alpha"));
  daemon.Step({From(1, Description("alpha", 0, 2))}, 0.01);
  AnswerTo(&daemon, Command(7, v1::OPERATOR_EVICT, "alpha"));
  EXPECT_EQ(daemon.counter("simulators_evicted"), 1u) << "the same sample came twice";
  std::vector<v1::Input> more;
  for (std::uint64_t id = 100; id < 100 + kAnswersKept; ++id) {
    more.push_back(Command(id, v1::OPERATOR_EVICT, "nobody"));
  }
  daemon.Step(more, 0.01);
  int answers = 0;
  const v1::ServiceStatus status = daemon.status();
  for (const v1::KeyValue& extension : status.extensions()) {
    answers += extension.key().starts_with("operator.");
  }
  EXPECT_EQ(answers, static_cast<int>(kAnswersKept));
  EXPECT_EQ(Extension(status, "operator.0000000000000007"), "");
}

TEST(OperatorCommands, AServiceThatStillClaimsObeysNobody) {
  ScriptedDaemon daemon(Simulated(), DaemonParts{.claim = {.wait_ns = 1'000'000'000'000}});
  daemon.Step(AlphaJoins(1), 0.01);
  EXPECT_EQ(AnswerTo(&daemon, Command(7, v1::OPERATOR_EVICT, "alpha")), "");
}

}  // namespace
}  // namespace collision::server
