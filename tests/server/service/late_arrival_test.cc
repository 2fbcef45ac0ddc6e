// Goal:   a standby that hears of a simulator later than the service beside it does not run ahead
//         with the others, and misses none of their contacts.
// Method: one simulator alone far from everybody, free for as long as a grant may reach; another
//         one, whose agents pass through each other, is heard when time has begun here.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/server/service/standby_of_daemon.h"

namespace collision::server {
namespace {

constexpr std::uint64_t kOwn = 2;

class LateArrivalTest : public StandbyOfDaemonTest {
 protected:
  LateArrivalTest() {
    // What there is of one agent that meets nobody.
    std::vector<v1::Input> alone = {From(1, Description("alpha", 0, 1)), From(1, Still(), "alpha")};
    alone.push_back(From(1, AloneAt(0, 0)));
    HearOther({.granted_until_ns = kTenth, .agents = 1});
    daemon_.Step(alone, 0.01);
    daemon_.Step({}, 0.01);
  }

  static v1::AgentState Still() {
    v1::AgentState state = State(0, 0, 1);
    state.mutable_position_m()->set_y(1000);
    return state;
  }

  static v1::SimulatorClock AloneAt(std::int64_t clock_ns, std::uint64_t service) {
    v1::SimulatorClock clock = ClockAfter("alpha", clock_ns, 1, 1);
    clock.set_next_ns(clock_ns + kTenth);
    clock.set_service_id(service);
    return clock;
  }

  bool HasEnded() {
    const std::vector<v1::CollisionEvent> contacts = Contacts();
    return std::any_of(contacts.begin(), contacts.end(), [](const v1::CollisionEvent& event) {
      return event.status() == v1::EVENT_ENDED;
    });
  }

  const Voyage late_{.simulator = "beta", .sender = 2, .in_rounds = true};
};

TEST_F(LateArrivalTest, TimeGoesOnWithWhomItHearsOfLater) {
  EXPECT_GT(daemon_.status().granted_until_ns(), kSecond) << "as far as it knows";
  daemon_.Step(late_.Told(0), 0.01);
  for (int step = 1; step <= 3; ++step) {
    daemon_.Step(Joined({From(1, AloneAt(step * kTenth, 0))}, late_.Told(step)), 0.01);
    EXPECT_LT(daemon_.status().granted_until_ns(), kSecond);
  }
  EXPECT_GT(daemon_.status().now_ns(), 2 * kTenth);
}

TEST_F(LateArrivalTest, ItsContactIsToldAfterATakeOver) {
  for (int step = 0; step <= 3; ++step) {
    daemon_.Step(Joined({From(1, AloneAt(step * kTenth, 0))}, late_.Told(step)), 0.01);
  }
  EndOther();
  for (int step = 3; step <= kSteps; ++step) {
    daemon_.Step(Joined({From(1, AloneAt(step * kTenth, kOwn))}, late_.ToldTo(kOwn, step)), 0.01);
  }
  EXPECT_TRUE(HasEnded());
}

TEST_F(LateArrivalTest, NothingIsGrantedBeyondWhatWasHeardAtATakeOver) {
  EXPECT_GT(daemon_.status().granted_until_ns(), kSecond);
  EndOther();
  EXPECT_EQ(daemon_.status().granted_until_ns(), kTenth);
  const auto both_tell = [this](int step) {
    daemon_.Step(Joined(late_.ToldTo(kOwn, step), {From(1, AloneAt(step * kTenth, kOwn))}), 0.01);
  };
  both_tell(0);
  EXPECT_LT(daemon_.clearance(SimulatorId("alpha")).granted_until_ns(), kSecond);
  for (int step = 1; step <= kSteps; ++step) both_tell(step);
  EXPECT_TRUE(HasEnded());
}

// Goal:   time does not begin here by a status from before it began there.
TEST_F(StandbyOfDaemonTest, TimeBeginsHereAfterItHasBegunThere) {
  const Voyage run{.in_rounds = true};
  HearOther({.granted_until_ns = Instant::Always().nanoseconds()});
  daemon_.Step(run.Told(0), 0.01);
  daemon_.Step(run.Told(1), 0.01);
  EXPECT_EQ(daemon_.status().now_ns(), 0);
  HearOther({.granted_until_ns = kTenth, .agents = 2});
  daemon_.Step(run.Told(1), 0.01);
  EXPECT_EQ(daemon_.status().now_ns(), kTenth);
}

// Goal:   nobody is waited for after a take-over from a service in which time had not begun.
TEST_F(StandbyOfDaemonTest, TimeBeginsAtOnceAfterATakeOverFromAnIdleService) {
  HearOther({.granted_until_ns = Instant::Always().nanoseconds()});
  EndOther();
  const Voyage run{.in_rounds = true};
  daemon_.Step(run.ToldTo(kOwn, 0), 0.01);
  EXPECT_GT(daemon_.status().granted_until_ns(), 0);
}

}  // namespace
}  // namespace collision::server
