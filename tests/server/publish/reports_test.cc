// Goal:   the report of a simulator says what has arrived of it, what is refused, and who speaks
//         for it; it comes when it changes, at most every 100 ms.
// Method: the daemon on a scripted bus.
#include "server/publish/reports.h"

#include <gtest/gtest.h>

#include "tests/server/messages.h"
#include "tests/server/scripted_bus.h"

namespace collision::server {
namespace {

constexpr std::uint64_t kAlpha = 10, kBeta = 20;  // senders
constexpr std::int64_t kSecond = 1'000'000'000;

class ReportsTest : public testing::Test {
 protected:
  std::vector<v1::SimulatorReport> All() const {
    std::vector<v1::SimulatorReport> all;
    for (const v1::Output& output : daemon_.bus().outputs) {
      if (output.has_simulator_report()) all.push_back(output.simulator_report());
    }
    return all;
  }

  /// The newest one, a second later.
  v1::SimulatorReport Report() {
    daemon_.Step({}, 1);
    return All().empty() ? v1::SimulatorReport() : All().back();
  }

  static v1::SimulatorClock Clock(std::uint64_t descriptions, std::uint64_t states,
                                  std::uint32_t agents) {
    v1::SimulatorClock clock = ClockAfter("alpha", 0, states, descriptions);
    clock.set_agents(agents);
    clock.set_incarnation(77);
    return clock;
  }

  mutable ScriptedDaemon daemon_{Simulated()};
};

TEST_F(ReportsTest, SayWhatHasArrived) {
  daemon_.Step({From(kAlpha, Description("alpha", 0)), From(kAlpha, Description("alpha", 1)),
                From(kAlpha, State(1, 0, 4), "alpha"), From(kAlpha, Clock(2, 4, 2))});
  ASSERT_EQ(All().size(), 1u) << "at once";
  const v1::SimulatorReport report = All()[0];
  EXPECT_EQ(report.simulator_id(), SimulatorId("alpha"));
  EXPECT_EQ(report.stamp().service_id(), 1u);
  EXPECT_EQ(report.name(), "alpha");
  EXPECT_EQ(report.run(), 1u);
  EXPECT_EQ(report.incarnation(), 77u);
  EXPECT_TRUE(report.alive());
  EXPECT_EQ(report.descriptions_sequence(), 2u);
  EXPECT_EQ(report.states_sequence(), 4u);
  EXPECT_EQ(report.agents(), 2u);
  EXPECT_EQ(report.agents_stated(), 1u);
  EXPECT_EQ(report.refused(), 0u);
  EXPECT_EQ(Report().ShortDebugString(), report.ShortDebugString()) << "nothing has changed";
  EXPECT_EQ(All().size(), 1u);
}

// Goal:   descriptions count as arrived only when there are as many agents as the clock names,
//         although the last of them has come.
TEST_F(ReportsTest, AMissingDescriptionShows) {
  daemon_.Step({From(kAlpha, Description("alpha", 1)), From(kAlpha, Clock(2, 0, 2))});
  EXPECT_EQ(Report().descriptions_sequence(), 0u);
  EXPECT_EQ(Report().agents(), 1u);
  daemon_.Step({From(kAlpha, Description("alpha", 0))});
  EXPECT_EQ(Report().descriptions_sequence(), 2u);
  // A removal counts as well, as soon as it is there.
  daemon_.Step({From(kAlpha, Clock(3, 0, 1))});
  EXPECT_EQ(Report().descriptions_sequence(), 2u);
  v1::Input removal = Removal(kAlpha, "alpha", 1);
  removal.mutable_agent_removal()->set_incarnation(77);
  removal.mutable_agent_removal()->set_sequence(3);
  daemon_.Step({removal});
  EXPECT_EQ(Report().descriptions_sequence(), 3u);
}

TEST_F(ReportsTest, TellWhatIsRefusedUntilItIsAccepted) {
  v1::AgentDescription bad = Description("alpha", 1);
  bad.set_radius_m(-1);
  daemon_.Step(
      {From(kAlpha, Description("alpha", 0)), From(kAlpha, bad), From(kAlpha, Clock(2, 0, 2))});
  v1::SimulatorReport report = Report();
  EXPECT_EQ(report.descriptions_sequence(), 2u) << "a refused description has arrived";
  ASSERT_EQ(report.refusals_size(), 1);
  EXPECT_EQ(report.refused(), 1u);
  EXPECT_EQ(report.refusals(0).reason(), v1::REJECTED_OUT_OF_RANGE);
  EXPECT_EQ(report.refusals(0).topic(), v1::TOPIC_AGENT_DESCRIPTION);
  EXPECT_EQ(report.refusals(0).slot(), 1u);
  EXPECT_EQ(report.refusals(0).field(), "radius_m");
  EXPECT_FALSE(report.refusals(0).detail().empty());
  daemon_.Step({From(kAlpha, Description("alpha", 1))});
  EXPECT_EQ(Report().refusals_size(), 0);
}

TEST_F(ReportsTest, ListTheFirstRefusalsAndCountAll) {
  std::vector<v1::Input> inputs = {From(kAlpha, Clock(0, 0, 0))};
  for (std::uint32_t slot = 0; slot < 100; ++slot) {
    v1::AgentState state = State(slot, 0, slot + 1);
    state.set_position_error_m(-1);
    inputs.push_back(From(kAlpha, state, "alpha"));
  }
  daemon_.Step(inputs);
  EXPECT_EQ(Report().refusals_size(), 16);
  EXPECT_EQ(Report().refused(), 100u);
}

// Goal:   who owns the name, and whether that program lives, is told to who waits for it.
TEST_F(ReportsTest, NameTheOwnerAndItsEnd) {
  daemon_.Step({From(kAlpha, Description("alpha", 0)), From(kAlpha, Clock(1, 0, 1))});
  v1::SimulatorClock other = ClockOf("alpha", 0, 2);
  other.set_incarnation(88);
  daemon_.Step({From(kBeta, other)});
  EXPECT_EQ(Report().incarnation(), 77u);
  EXPECT_EQ(Report().refused(), 0u) << "of the owner nothing is refused";
  daemon_.Step({Liveliness(kAlpha, "alpha", false)});
  EXPECT_FALSE(Report().alive());
  EXPECT_EQ(Report().run(), 1u);
  daemon_.Step({From(kBeta, other)});
  const v1::SimulatorReport report = Report();
  EXPECT_EQ(report.run(), 2u);
  EXPECT_EQ(report.incarnation(), 88u);
  EXPECT_TRUE(report.alive());
  EXPECT_EQ(report.agents(), 0u);
  EXPECT_EQ(report.descriptions_sequence(), 0u) << "of the new run nothing has arrived";
}

// Goal:   a simulator that changes all the time is reported every 100 ms, and the last change is
//         not forgotten: the daemon wakes up for it.
TEST_F(ReportsTest, ComeAtABoundedRate) {
  daemon_.Step({From(kAlpha, Clock(0, 0, 0))});
  for (int i = 1; i <= 25; ++i) daemon_.Step({From(kAlpha, State(0, 0, i), "alpha")}, 0.01);
  EXPECT_EQ(All().size(), 3u);
  EXPECT_EQ(All().back().states_sequence(), 20u);
  daemon_.Step({From(kAlpha, State(0, 0, 26), "alpha")});
  daemon_.Step({});
  EXPECT_EQ(daemon_.bus().timeout_ns, 5 * kSecond / 100);
  daemon_.Step({}, 0.05);
  EXPECT_EQ(All().back().states_sequence(), 26u);
}

}  // namespace
}  // namespace collision::server
