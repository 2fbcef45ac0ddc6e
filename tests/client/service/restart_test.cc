// Goal:   a simulator that is started again, also before the service has noticed the end of the one
//         before, or on a host whose clock is behind, or beside a program of the same name, is
//         there in the end with all of its agents, or is told in words why not; and the other is
//         not disturbed.
// Method: the library and the daemon in one process. The end of a program is a message that comes
//         when the test says.
#include <gtest/gtest.h>

#include <vector>

#include "collision/shape.h"
#include "tests/client/service/in_process_service.h"

namespace collision::client {
namespace {

using namespace std::chrono_literals;

/// Steps of the daemon that are enough for anything here.
constexpr int kSteps = 2000;

class RestartTest : public testing::Test {
 protected:
  struct Program {
    World world;
    std::vector<Agent> agents;
  };

  Program Start(std::uint64_t sender, std::uint32_t run, std::size_t agents,
                bool lock_step = true) {
    Program program{service_.Connect(sender, {.simulator = "alpha",
                                              .lock_step = lock_step,
                                              .run = run,
                                              .incarnation = static_cast<std::uint32_t>(sender),
                                              .on_leave = OnLeave::kLeave}),
                    {}};
    for (std::size_t i = 0; i < agents; ++i) {
      const AgentDescription description = {
          .name = "agent", .radius_m = 0.1, .acceleration_max_m_s2 = 0};
      program.agents.push_back(
          program.world.AddAgent(description, {.position_m = {static_cast<double>(i), 0, 0}}));
    }
    program.world.Publish(0);
    return program;
  }

  /// As after a kill: the agents stay.
  static void Kill(Program* program) {
    { const World gone = std::move(program->world); }
    program->agents.clear();
  }

  /// Lets everything happen until `done`, or it never will.
  template <typename Done>
  bool Until(std::vector<Program*> programs, const Done& done) {
    for (int step = 0; step < kSteps && !done(); ++step) {
      service_.Step(0.01);
      for (Program* program : programs) program->world.Poll();
    }
    return done();
  }

  std::size_t AgentsOfRun(std::uint32_t run) {
    const v1::ServiceStatus status = service_.daemon().status();
    for (const v1::SimulatorStatus& simulator : status.simulators()) {
      if (simulator.run() == run && simulator.alive()) return status.agents();
    }
    return 0;
  }

  static v1::Config Config() {
    v1::Config config = server::Simulated();
    config.set_agents_max(10'000);
    return config;
  }

  InProcessService service_{Config(), 1};
};

TEST_F(RestartTest, WithinTheLeaseAllAgentsAreThereAfterIt) {
  for (const std::size_t agents : {50, 5000}) {
    SCOPED_TRACE(agents);
    const auto run = static_cast<std::uint32_t>(agents);
    Program first = Start(run + 1, run, agents);
    ASSERT_TRUE(Until({&first}, [&] { return first.world.granted_until_ns() > 0; }));
    Kill(&first);
    Program second = Start(run + 2, run + 1, agents);
    ASSERT_TRUE(Until({&second}, [&] { return !second.world.waits_for_name().empty(); }));
    EXPECT_LE(second.world.TakeRejections().size(), 1u) << "told once, not for each agent";
    EXPECT_EQ(AgentsOfRun(run + 1), 0u);
    service_.End(run + 1, "alpha");
    ASSERT_TRUE(Until({&second}, [&] { return second.world.granted_until_ns() > 0; }));
    EXPECT_EQ(second.world.waits_for_name(), "");
    EXPECT_EQ(AgentsOfRun(run + 1), agents);
    EXPECT_EQ(second.world.AdvanceTo(1'000'000, 5s), Advance::kReached);
    Kill(&second);
    service_.End(run + 2, "alpha");
  }
}

// Goal:   a host whose clock is behind has a lower run, and takes the next one.
TEST_F(RestartTest, AClockThatIsBehindTakesTheNextRun) {
  for (const bool within_the_lease : {true, false}) {
    const std::uint64_t sender = within_the_lease ? 1 : 3;
    Program first = Start(sender, 4'000'000'000, 3);
    ASSERT_TRUE(Until({&first}, [&] { return first.world.granted_until_ns() > 0; }));
    const std::uint32_t in_force = first.agents[0].id().run;
    Kill(&first);
    if (!within_the_lease) service_.End(sender, "alpha");
    Program second = Start(sender + 1, 5, 3);
    EXPECT_EQ(second.agents[0].id().run, 5u);
    if (within_the_lease) {
      Until({&second}, [&] { return !second.world.waits_for_name().empty(); });
      service_.End(sender, "alpha");
    }
    ASSERT_TRUE(Until({&second}, [&] { return second.world.granted_until_ns() > 0; }));
    EXPECT_EQ(second.agents[0].id().run, in_force + 1);
    EXPECT_EQ(AgentsOfRun(in_force + 1), 3u);
    EXPECT_EQ(second.agents[0].clearance().not_clear, false);
    EXPECT_EQ(second.world.AdvanceTo(1'000'000, 5s), Advance::kReached);
    Kill(&second);
    service_.End(sender + 1, "alpha");
  }
}

// Goal:   of two live programs of one name the second waits and says so; the first goes on, and
//         when it has ended, the second is there.
TEST_F(RestartTest, TheSecondOfTwoLivePrograms) {
  for (const std::uint32_t second_run : {9, 10, 11}) {
    SCOPED_TRACE(second_run);
    const std::uint64_t sender = 10 * second_run;
    Program first = Start(sender, 10, 2);
    ASSERT_TRUE(Until({&first}, [&] { return first.world.granted_until_ns() > 0; }));
    const std::uint32_t in_force = first.agents[0].id().run;
    Program second = Start(sender + 1, in_force - 10 + second_run, 4);
    ASSERT_TRUE(Until({&first, &second}, [&] { return !second.world.waits_for_name().empty(); }));
    EXPECT_EQ(first.world.AdvanceTo(500'000'000, 5s), Advance::kReached);
    EXPECT_EQ(first.world.waits_for_name(), "");
    EXPECT_TRUE(first.world.TakeRejections().empty());
    EXPECT_EQ(AgentsOfRun(in_force), 2u);
    EXPECT_LT(second.world.granted_until_ns(), 0) << "what is granted to the first is not its own";
    Kill(&first);
    service_.End(sender, "alpha");
    ASSERT_TRUE(Until({&second}, [&] { return second.world.granted_until_ns() > 0; }));
    EXPECT_EQ(AgentsOfRun(second.agents[0].id().run), 4u);
    EXPECT_GT(second.agents[0].id().run, in_force);
    Kill(&second);
    service_.End(sender + 1, "alpha");
  }
}

// Goal:   the shapes that were refused with all else while the first counted as alive are there.
TEST_F(RestartTest, ShapesComeAgain) {
  const auto box = Shape::Make({.solids = {Solid::Box({0.5, 0.3, 0.1})}});
  const auto start = [&](std::uint64_t sender) {
    Program program = Start(sender, static_cast<std::uint32_t>(sender), 1);
    program.agents[0].SetDescription(
        {.name = "box", .radius_m = 1, .acceleration_max_m_s2 = 0, .shape = box});
    return program;
  };
  Program first = start(1);
  ASSERT_TRUE(Until({&first}, [&] { return service_.daemon().counter("shapes") == 1; }));
  Kill(&first);
  Program second = start(2);
  ASSERT_TRUE(Until({&second}, [&] { return !second.world.waits_for_name().empty(); }));
  service_.End(1, "alpha");
  ASSERT_TRUE(Until({&second}, [&] { return second.world.granted_until_ns() > 0; }));
  EXPECT_TRUE(Until({&second}, [&] { return service_.daemon().counter("shapes") == 1; }));
  constexpr double kReported = 6;  // [s] after the time within which a shape must come
  service_.Step(kReported);
  service_.Step(kReported);
  second.world.Poll();
  EXPECT_TRUE(second.world.standing_refusals().empty());
}

// Goal:   what is refused is there to be read as long as it is refused.
TEST_F(RestartTest, RefusalsStandInTheReport) {
  Program program = Start(1, 1, 1);
  ASSERT_TRUE(Until({&program}, [&] { return program.world.granted_until_ns() > 0; }));
  v1::Input bad;
  *bad.mutable_agent_states() = server::Chunk("alpha", 1);
  v1::AgentState state = server::State(0, 0, 100);
  state.set_velocity_error_m_s(-1);
  *bad.mutable_agent_states()->add_states() = state;
  service_.Send(1, bad);
  ASSERT_TRUE(Until({&program}, [&] { return !program.world.standing_refusals().empty(); }));
  EXPECT_EQ(program.world.standing_refusals()[0].field, "velocity_error_m_s");
  state = server::State(0, 0, 101);
  *bad.mutable_agent_states()->mutable_states(0) = state;
  service_.Send(1, bad);
  EXPECT_TRUE(Until({&program}, [&] { return program.world.standing_refusals().empty(); }));
}

}  // namespace
}  // namespace collision::client
