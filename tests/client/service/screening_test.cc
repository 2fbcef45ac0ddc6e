// Goal:   a simulator with the library screens a manoeuvre before it flies it: it hears what its
//         hypothetical agent would meet, of its own and of others' agents, and until when that is
//         clear; the other simulator hears nothing, and time goes on as without it.
// Method: two simulators in lock-step, over a daemon in the same thread.
#include <gtest/gtest.h>

#include <set>

#include "collision/event_text.h"
#include "tests/client/service/in_process_service.h"

namespace collision::client {
namespace {

constexpr std::int64_t kMillisecond = 1'000'000;

class ScreeningTest : public testing::Test {
 protected:
  ScreeningTest() {
    pilot_.OnEvent([this](const Event& event) { heard_.push_back(event); });
    other_.OnEvent([this](const Event& event) { heard_by_other_.push_back(event); });
  }

  void AdvanceTo(std::int64_t clock_ns) { AdvanceBoth(clock_ns, &service_, &pilot_, &other_); }

  static AgentDescription Ball(const std::string& name, bool hypothetical = false) {
    AgentDescription ball{.name = name, .radius_m = 1, .acceleration_max_m_s2 = 0.1};
    ball.hypothetical = hypothetical;
    return ball;
  }

  static State At(std::int64_t t, double x, double v) {
    return {.stamp_ns = t,
            .position_m = {x + 1e-9 * v * static_cast<double>(t), 0, 0},
            .velocity_m_s = {v, 0, 0}};
  }

  InProcessService service_{RoundsOfTwo(), 1};
  World pilot_ = service_.Connect(1, {.simulator = "pilot"});
  World other_ = service_.Connect(2, {.simulator = "other"});
  std::vector<Event> heard_, heard_by_other_;
};

TEST_F(ScreeningTest, TheOwnerHearsWhatItsPlanWouldMeet) {
  Agent rock = other_.AddAgent(Ball("rock"), At(0, 0, 0));
  Agent ship = pilot_.AddAgent(Ball("ship"), At(0, 500, 0));
  AgentDescription description = Ball("plan", true);
  description.never_meets = {"ship"};
  Agent plan = pilot_.AddAgent(description, At(0, 22, -4));
  for (std::int64_t t = 0; t <= 14'000 * kMillisecond; t += 100 * kMillisecond) {
    rock.SetState(At(t, 0, 0));
    ship.SetState(At(t, 500, 0));
    plan.SetState(At(t, 22, -4));
    AdvanceTo(t);
  }
  ASSERT_GE(heard_.size(), 3u);
  for (const Event& event : heard_) {
    EXPECT_TRUE(event.hypothetical);
    EXPECT_EQ(event.contacts_sequence, 0u);
    EXPECT_EQ(std::set({event.lower, event.higher}), std::set({plan.id(), rock.id()}));
  }
  EXPECT_EQ(heard_.front().status, EventStatus::kPossible);
  EXPECT_EQ(heard_.front().expected->outcome, ExpectedOutcome::kTouch);
  EXPECT_LT(heard_.front().now_ns, 5000 * kMillisecond);
  EXPECT_EQ(heard_.back().status, EventStatus::kEnded);
  EXPECT_LE(heard_.back().begin.earliest_ns, 5000 * kMillisecond) << "|22 - 4 t| = 2";
  EXPECT_GE(heard_.back().begin.latest_ns, 5000 * kMillisecond);
  EXPECT_TRUE(heard_by_other_.empty());
  EXPECT_EQ(pilot_.contacts_missed(), 0u);
  EXPECT_NE(EventLine(
                heard_[0], [](const AgentId&) { return "x"; }, 0)
                .find("hypothetical"),
            std::string::npos);
}

// Goal:   with the first new grant after a plan was told its owner knows what it may meet, and
//         until when it is clear.
TEST_F(ScreeningTest, TheAnswerComesWithTheNextGrant) {
  const Agent rock = other_.AddAgent(Ball("rock"), At(0, 0, 0));
  AdvanceTo(0);
  AdvanceTo(100 * kMillisecond);
  const Agent near = pilot_.AddAgent(Ball("near", true), At(100 * kMillisecond, 2.2, 0));
  const Agent far = pilot_.AddAgent(Ball("far", true), At(100 * kMillisecond, 5000, 0));
  const std::int64_t granted_ns = pilot_.granted_until_ns();
  AdvanceTo(granted_ns + 1);
  ASSERT_FALSE(heard_.empty());
  EXPECT_EQ(heard_[0].status, EventStatus::kPossible);
  EXPECT_LT(near.clearance().clear_until_ns, 1700 * kMillisecond) << "0.2 m apart: 0.1 t²";
  EXPECT_GT(far.clearance().clear_until_ns, 100'000 * kMillisecond);
}

TEST_F(ScreeningTest, WhetherAnAgentIsHypotheticalNeverChanges) {
  Agent plan = pilot_.AddAgent(Ball("plan", true), At(0, 22, -4));
  EXPECT_THROW(plan.SetDescription(Ball("plan")), std::invalid_argument);
  EXPECT_NO_THROW(plan.SetDescription(Ball("plan", true)));
}

}  // namespace
}  // namespace collision::client
