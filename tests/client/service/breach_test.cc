// Goal:   a known acceleration that is wrong is told to its owner, and to nobody else but those who
//         look: field, declared, seen, how often; a right one is not.
// Method: two simulators with the library in lock-step, over a daemon in the same thread; one
//         accelerates by 3 m/s² and tells another acceleration.
#include <gtest/gtest.h>

#include "tests/client/service/in_process_service.h"

namespace collision::client {
namespace {

constexpr std::int64_t kMillisecond = 1'000'000;

class BreachTest : public testing::Test {
 protected:
  void SetUp() override {
    crane_.OnNotice([this](const Notice& notice) { told_.push_back(notice); });
    still_.OnNotice([this](const Notice& notice) { told_to_other_.push_back(notice); });
  }

  void Advance(std::int64_t clock_ns) { AdvanceBoth(clock_ns, &service_, &still_, &crane_); }

  /// Runs for half a second under 3 m/s² and tells this acceleration.
  void Push(double told) {
    const AgentDescription ball{.name = "crane-3", .radius_m = 1, .acceleration_max_m_s2 = 0.5};
    const Agent rest = still_.AddAgent(ball, {.stamp_ns = 0, .position_m = {1000, 0, 0}});
    Agent hook = crane_.AddAgent(ball, {.stamp_ns = 0, .acceleration_m_s2 = {told, 0, 0}});
    Advance(0);
    for (int step = 1; step <= 5; ++step) {
      const double t = 0.1 * step;
      hook.SetState({.stamp_ns = 100 * step * kMillisecond,
                     .position_m = {1.5 * t * t, 0, 0},
                     .velocity_m_s = {3 * t, 0, 0},
                     .acceleration_m_s2 = {told, 0, 0}});
      Advance(100 * step * kMillisecond);
    }
    Advance(600 * kMillisecond);
    service_.Step(1.1);  // the last count is told when a second is over
    service_.Step(0.001);
    crane_.Poll();
    still_.Poll();
  }

  std::vector<v1::AgentBreach> Breaches() const {
    std::vector<v1::AgentBreach> breaches;
    for (const v1::Output& output : service_.said()) {
      if (output.has_agent_breach()) breaches.push_back(output.agent_breach());
    }
    return breaches;
  }

  InProcessService service_{RoundsOfTwo(), 1};
  World still_ = service_.Connect(1, {.simulator = "still"});
  World crane_ = service_.Connect(2, {.simulator = "crane"});
  std::vector<Notice> told_, told_to_other_;
};

TEST_F(BreachTest, AWrongKnownAccelerationIsToldToItsOwner) {
  Push(1);
  const std::vector<v1::AgentBreach> breaches = Breaches();
  ASSERT_GE(breaches.size(), 1u);
  EXPECT_EQ(breaches[0].simulator_id(), SimulatorId("crane"));
  EXPECT_EQ(breaches[0].field(), "acceleration_max_m_s2");
  EXPECT_EQ(breaches[0].declared(), 0.5);
  EXPECT_LE(breaches[0].seen(), 2) << "3 m/s² less the 1 m/s² that was told";
  EXPECT_GE(breaches[0].seen(), 1.99);
  EXPECT_EQ(breaches[0].from_ns(), 0);
  EXPECT_EQ(breaches[0].at_ns(), 100 * kMillisecond);
  EXPECT_EQ(breaches[0].count(), 1u);
  EXPECT_EQ(breaches.back().count(), 5u);
  EXPECT_GT(breaches.back().stamp().sequence(), 0u);
  ASSERT_EQ(told_.size(), 1u);
  EXPECT_EQ(told_[0].kind, NoticeKind::kBreach);
  EXPECT_EQ(told_[0].text,
            "crane-3 broke acceleration_max_m_s2: declared 0.5, at least 1.99 seen between 0.000 s "
            "and 0.100 s (once); see client/BOUNDS.md");
  EXPECT_TRUE(told_to_other_.empty());
}

TEST_F(BreachTest, ARightOneIsNoBreach) {
  Push(3);
  EXPECT_TRUE(Breaches().empty());
  EXPECT_TRUE(told_.empty() && told_to_other_.empty());
}

}  // namespace
}  // namespace collision::client
