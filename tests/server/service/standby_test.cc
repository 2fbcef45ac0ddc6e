// Goal:   a service that stands by knows what the other one knows, whatever single simulators
//         write, and takes over without harm to anybody.
// Method: the statuses of another service by hand, and simulators whose agents pass through each
//         other.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "idl/identity.h"
#include "server/intake/followed_rounds.h"
#include "tests/server/service/standby_of_daemon.h"

namespace collision::server {
namespace {

// Readers and standbys compare epochs of different services.
TEST_F(StandbyOfDaemonTest, ItsEpochIsThatOfTheServiceBesideIt) {
  HearOther({.epoch = 3});
  EXPECT_EQ(daemon_.status().phase(), v1::PHASE_STANDBY);
  EXPECT_EQ(epoch(), 3u);
  HearOther({.epoch = 4});
  EXPECT_EQ(epoch(), 4u) << "before time begins";
  HearOther({.epoch = 2});
  EXPECT_EQ(epoch(), 4u);
  const Voyage run;
  daemon_.Step(run.Told(0), 0.01);
  HearOther({.epoch = 9});
  EXPECT_EQ(epoch(), 4u) << "its own time has begun";
}

// Goal:   what the other service granted in an epoch that is over holds nobody in the next one.
TEST_F(StandbyOfDaemonTest, GrantsOfAnEpochThatIsOverDoNotCount) {
  HearOther({.granted_until_ns = 1000 * kSecond});
  Voyage run;
  daemon_.Step(run.Told(0), 0.01);
  daemon_.Step(Joined(run.Removals(), {run.End()}), 0.01);
  ASSERT_EQ(epoch(), 2u);
  run = {.sender = 2, .run = 2};
  daemon_.Step(run.Told(0), 0.01);
  HearOther({.granted_until_ns = 1000 * kSecond});  // late
  EndOther();
  daemon_.Step(run.ToldTo(2, 0), 0.01);
  EXPECT_LT(EffectiveFrom("alpha"), 100 * kSecond);
}

// Goal:   one that joins a running world, and has heard of its slowest simulator only, does not run
//         ahead with that one, nor once it serves: time begins here when all are known.
TEST_F(StandbyOfDaemonTest, TimeBeginsWhenItKnowsAsManyAgentsAsTheOtherService) {
  const Voyage slow{.in_rounds = true};
  const auto slow_told_to = [&](std::uint64_t service) {
    std::vector<v1::Input> inputs = slow.ToldTo(service, 0);
    inputs.back().mutable_simulator_clock()->set_next_ns(3600 * kSecond);
    return inputs;
  };
  const auto pass = [this](std::vector<v1::Input> inputs) {
    for (int i = 0; i < 20; ++i) daemon_.Step(std::exchange(inputs, {}), 0.01);
    return daemon_.status().now_ns();
  };
  HearOther({.now_ns = 5 * kTenth, .granted_until_ns = 6 * kTenth, .agents = 4});
  EXPECT_EQ(pass(slow_told_to(1)), 0);
  EXPECT_EQ(Extension(daemon_.status(), "standby"), "not ready yet");
  EndOther();
  EXPECT_EQ(pass(slow_told_to(2)), 0);
  const Voyage late{
      .simulator = "beta", .sender = 2, .first_clock_ns = 7 * kTenth, .in_rounds = true};
  for (int step = 0; step <= kSteps; ++step) daemon_.Step(late.ToldTo(2, step), 0.01);
  EXPECT_GE(pass({}), 16 * kTenth);
}

// Goal:   but not for ever: those that have not come by then are gone.
TEST_F(StandbyOfDaemonTest, WaitsForAgentsThatTheOtherServiceHadForALimitedTime) {
  HearOther({.now_ns = 0, .granted_until_ns = kTenth, .agents = 4});
  const Voyage run;
  daemon_.Step(run.Told(0), 0.01);
  EndOther();
  daemon_.Step(run.ToldTo(2, 5), 1);
  EXPECT_EQ(daemon_.status().now_ns(), 0);
  daemon_.Step(run.ToldTo(2, 6), 5);
  EXPECT_EQ(daemon_.status().now_ns(), 6 * kTenth);
}

// Goal:   readiness is of one epoch.
TEST_F(StandbyOfDaemonTest, IsReadyAnewInEachEpoch) {
  const auto standby = [this] { return Extension(daemon_.status(), "standby"); };
  HearOther({.epoch = 1});
  EXPECT_EQ(standby(), "ready") << "there is nothing to know";
  const Voyage run;
  daemon_.Step(run.Told(0), 0.01);
  daemon_.Step(Joined(run.Removals(), {run.End()}), 0.01);
  ASSERT_EQ(epoch(), 2u);
  EXPECT_EQ(standby(), "not ready yet");
  HearOther({.now_ns = 1000 * kSecond});
  EXPECT_EQ(standby(), "not ready yet") << "a status of the epoch that is over";
  HearOther({.epoch = 2});
  EXPECT_EQ(standby(), "ready");
}

// Goal:   a status that waited while this process stood still says nothing of what was missed.
TEST_F(StandbyOfDaemonTest, AfterAStandstillItIsReadyByLaterStatusesOnly) {
  const auto standby = [this] { return Extension(daemon_.status(), "standby"); };
  HearOther({});
  EXPECT_EQ(standby(), "ready");
  daemon_.bus().Pass(5 * kSecond);
  HearOther({});
  EXPECT_EQ(standby(), "not ready yet");
  daemon_.Step({}, 1);
  HearOther({});
  EXPECT_EQ(standby(), "ready");
}

// What a standby says whose own cable was out would be wrong.
TEST_F(StandbyOfDaemonTest, IsSilentButForItsStatusUntilASimulatorFollowsIt) {
  const Voyage run;
  daemon_.Step(run.Told(0), 0.01);
  EndOther();
  EXPECT_EQ(daemon_.status().followers(), 0u);
  const auto says_more_than_its_status = [&] {
    return std::any_of(daemon_.bus().outputs.begin(), daemon_.bus().outputs.end(),
                       [](const v1::Output& output) { return !output.has_service_status(); });
  };
  EXPECT_FALSE(says_more_than_its_status());
  daemon_.Step(run.ToldTo(2, 0), 0.01);
  EXPECT_TRUE(says_more_than_its_status());
  EXPECT_EQ(daemon_.status().followers(), 1u);
}

// Goal:   contacts of an epoch that ends before anybody has heard the successor are told later, as
//         history.
TEST_F(StandbyOfDaemonTest, ContactsOfAnEpochThatEndedUnheardAreToldInTheNextOne) {
  Voyage run;
  for (int step = 0; step <= kSteps; ++step) daemon_.Step(run.Told(step), 0.01);
  EndOther();
  daemon_.Step(Joined(run.Removals(), {run.End()}), 0.01);
  ASSERT_EQ(epoch(), 2u);
  EXPECT_TRUE(Contacts().empty());
  run = {.sender = 2, .run = 2};
  daemon_.Step(run.Told(0), 0.01);
  const std::vector<v1::CollisionEvent> contacts = Contacts();
  ASSERT_FALSE(contacts.empty());
  EXPECT_EQ(contacts.back().status(), v1::EVENT_ENDED);
  for (const v1::CollisionEvent& contact : contacts) {
    EXPECT_EQ(contact.stamp().epoch(), 1u);
    EXPECT_EQ(contact.lower().run(), 1u);
  }
}

class EpochThatEndsBesideItTest : public StandbyOfDaemonTest {
 protected:
  EpochThatEndsBesideItTest() {
    Voyage run;
    for (int step = 0; step <= kSteps; ++step) daemon_.Step(run.Told(step), 0.01);
    daemon_.Step(Joined(run.Removals(), {run.End()}), 0.01);
    EXPECT_EQ(epoch(), 2u);
  }

  /// It takes over and is followed.
  void TakeOver() {
    EndOther();
    const Voyage next = {.sender = 2, .run = 2};
    daemon_.Step(next.ToldTo(2, 0), 0.01);
  }
};

// Goal:   likewise where the epoch ends between the last word of the service in force and the end
//         of its lease.
TEST_F(EpochThatEndsBesideItTest, ContactsThatADeadServiceHasNotToldAreTold) {
  TakeOver();
  ASSERT_FALSE(Contacts().empty());
  EXPECT_EQ(Contacts().back().status(), v1::EVENT_ENDED);
  EXPECT_EQ(Contacts().back().stamp().epoch(), 1u);
}

TEST_F(EpochThatEndsBesideItTest, ButNotWhereThatServiceIsInItsNextEpoch) {
  HearOther({.epoch = 2});
  TakeOver();
  EXPECT_TRUE(Contacts().empty());
}

// Goal:   a simulator that waits for its time to come before it has agents gets it.
TEST_F(StandbyOfDaemonTest, TimeGoesOnWithoutAgents) {
  HearOther({.granted_until_ns = kTenth});
  daemon_.Step({From(1, ClockAfter("alpha", 0, 0, 0))}, 0.01);
  EndOther();
  v1::SimulatorClock clock = ClockAfter("alpha", kTenth, 0, 0);
  clock.set_service_id(2);
  daemon_.Step({From(1, clock)}, 1);
  EXPECT_EQ(daemon_.status().now_ns(), 0) << "others may be there";
  daemon_.Pass(5);
  EXPECT_EQ(daemon_.status().now_ns(), kTenth);
}

// Goal:   what the other service has granted counts, though time has not begun here.
TEST_F(StandbyOfDaemonTest, PromisesCountFromTheGrantsOfTheOtherService) {
  HearOther({.now_ns = 600 * kSecond, .granted_until_ns = 620 * kSecond, .agents = 4});
  const Voyage run{.first_clock_ns = 600 * kSecond};
  daemon_.Step(run.ToldTo(1, 0), 0.01);
  EndOther();
  daemon_.Step(run.ToldTo(2, 0), 0.01);
  daemon_.Pass(6);
  EXPECT_GE(EffectiveFrom("alpha"), 620 * kSecond);
}

// Goal:   a run that the service in force has ended before this one came stays ended.
TEST_F(StandbyOfDaemonTest, RunsThatTheOtherServiceHasEndedNeverComeBack) {
  const Voyage evicted{.run = 3};
  daemon_.Step(evicted.Told(0), 0.01);
  EXPECT_EQ(daemon_.status().agents(), 2u);
  HearOther({.ended_runs = IdText(SimulatorId("alpha")) + ":3:evicted"});
  EXPECT_EQ(daemon_.status().agents(), 0u);
  EXPECT_EQ(daemon_.counter("simulators_evicted"), 1u);
  EndOther();
  daemon_.Step(evicted.ToldTo(2, 0), 0.01);
  EXPECT_EQ(daemon_.status().agents(), 0u);
  const Voyage next{.run = 4};
  daemon_.Step(next.ToldTo(2, 0), 0.01);
  EXPECT_EQ(daemon_.status().agents(), 2u);
  EXPECT_EQ(Extension(daemon_.status(), "ended_runs"), IdText(SimulatorId("alpha")) + ":3:evicted");
}

class OneBesideAnotherTest : public StandbyOfDaemonTest {
 protected:
  OneBesideAnotherTest() {
    HearOther({.granted_until_ns = kTenth});
    daemon_.Step(Joined(honest_.Told(0), other_.Told(0)), 0.01);
  }

  const Voyage honest_{.simulator = "alpha", .in_rounds = true};
  const Voyage other_{.simulator = "beta", .sender = 2, .in_rounds = true};
};

// Goal:   a clock that no service has granted, which the one in force refuses, moves nothing at the
//         one that stands by, nor once that serves.
TEST_F(OneBesideAnotherTest, AClockBeyondAnyGrantHoldsNobody) {
  constexpr std::int64_t kFar = 4'000'000'000 * kSecond;
  daemon_.Step({From(2, ClockAfter("beta", kFar, 2, 2))}, 0.01);
  daemon_.Step({From(7, ClockAfter("alpha", kFar, 2, 2))}, 0.01);  // a program that owns nothing
  EndOther();
  for (int step = 0; step <= kSteps; ++step) {
    daemon_.Step(Joined(honest_.ToldTo(2, step), other_.ToldTo(2, step)), 0.01);
  }
  EXPECT_LE(EffectiveFrom("alpha"), 21 * kSecond);
  EXPECT_EQ(daemon_.status().now_ns(), kSteps * kTenth);
  EXPECT_EQ(Extension(daemon_.status(), "waiting_for"), "");
}

// Goal:   nor does one that a successor must believe, since it may have been granted.
TEST_F(OneBesideAnotherTest, AClockBeyondAnyGrantAfterTheTakeOverHoldsNoOther) {
  constexpr std::int64_t kFar = 4'000'000'000 * kSecond;
  EndOther();
  v1::SimulatorClock far = ClockAfter("beta", kFar, 2, 2);
  far.set_service_id(2);
  for (int step = 0; step <= kSteps; ++step) {
    daemon_.Step(Joined(honest_.ToldTo(2, step), {From(2, far)}), 0.01);
  }
  EXPECT_LE(EffectiveFrom("alpha"), 21 * kSecond);
  EXPECT_EQ(daemon_.status().now_ns(), kSteps * kTenth);
}

// Goal:   one that held time and started again while the other service was in force is waited for
//         by this one, too, unless an operator had evicted it there.
TEST_F(OneBesideAnotherTest, WhoStartedAgainWithoutAClockIsWaitedForAfterTheTakeOver) {
  daemon_.Step({other_.End()}, 0.01);
  daemon_.Step({From(12, Description("beta", 0, 2))}, 0.01);
  EndOther();
  for (int step = 0; step <= kSteps; ++step) daemon_.Step(honest_.ToldTo(2, step), 0.01);
  EXPECT_EQ(daemon_.status().now_ns(), 0);
}

// Goal:   what a program writes before this service has heard of its owner's end, and the other one
//         after, counts here too.
TEST_F(OneBesideAnotherTest, WhatASuccessorWritesTooEarlyWaitsForTheName) {
  v1::SimulatorClock clock = ClockAfter("beta", 0, 2, 2);
  clock.set_run(2);
  daemon_.Step(
      {From(12, Description("beta", 0, 2)), From(12, Description("beta", 1, 2)),
       From(12, State(0, 0, 1), "beta", 2), From(12, State(1, 0, 2), "beta", 2), From(12, clock)},
      0.01);
  daemon_.Step({Removal(12, "beta", 1)}, 0.01);
  EXPECT_EQ(daemon_.status().agents(), 4u);
  daemon_.Step({other_.End()}, 0.01);
  daemon_.Step({From(12, clock)}, 0.01);  // which it repeats
  clock.set_clock_ns(kTenth);
  clock.set_next_ns(2 * kTenth);
  daemon_.Step(Joined(honest_.Told(1), {From(12, clock)}), 0.01);
  EXPECT_EQ(daemon_.status().agents(), 3u);
}

TEST_F(OneBesideAnotherTest, WhoStartedAgainAndWasEvictedThereIsNotWaitedFor) {
  daemon_.Step({other_.End()}, 0.01);
  daemon_.Step({From(12, Description("beta", 0, 2))}, 0.01);
  HearOther({.granted_until_ns = kTenth, .ended_runs = IdText(SimulatorId("beta")) + ":2:evicted"});
  EndOther();
  for (int step = 0; step <= kSteps; ++step) daemon_.Step(honest_.ToldTo(2, step), 0.01);
  EXPECT_GT(daemon_.status().now_ns(), kTenth);
}

// Goal:   an agent that one simulator removes before the others have come so far has met whom it
//         has met.
TEST_F(OneBesideAnotherTest, WhatOneRemovesAheadOfTheOthersIsThereUntilThen) {
  HearOther({.granted_until_ns = 2 * kSecond});
  for (int step = 1; step <= kSteps; ++step) daemon_.Step(honest_.Told(step), 0.01);
  daemon_.Step(honest_.Removals(), 0.01);
  EXPECT_EQ(daemon_.status().agents(), 4u);
  for (int step = 1; step <= kSteps; ++step) daemon_.Step(other_.Told(step), 0.01);
  EXPECT_EQ(daemon_.status().agents(), 2u);
  EndOther();
  daemon_.Step(other_.ToldTo(2, kSteps), 0.01);
  const std::vector<v1::CollisionEvent> contacts = Contacts();
  EXPECT_TRUE(std::any_of(contacts.begin(), contacts.end(), [](const v1::CollisionEvent& event) {
    return event.status() == v1::EVENT_ENDED &&
           event.lower().simulator_id() == SimulatorId("alpha") &&
           event.higher().simulator_id() == SimulatorId("alpha");
  }));
}

// Goal:   a breach that this service found before it was ready may be a jump that it has not heard
//         of; one that it finds later is told.
class BreachTest : public OneBesideAnotherTest, public testing::WithParamInterface<bool> {};

TEST_P(BreachTest, PromisesAreVoidByWhatItFoundOnceItWasReady) {
  HearOther({.granted_until_ns = 2 * kSecond});
  const auto jump = [&](int step) {
    std::vector<v1::Input> jumps = other_.Told(step);
    for (v1::Input& input : jumps) {
      if (!input.has_agent_states()) continue;
      input.mutable_agent_states()->mutable_states(0)->mutable_position_m()->set_y(1000 * step);
    }
    daemon_.Step(Joined(honest_.Told(step), jumps), 0.01);
  };
  daemon_.Step({}, 9);  // It stood still, and is ready by later statuses.
  jump(1);
  jump(2);
  EXPECT_GT(daemon_.counter("breaches"), 0u);
  daemon_.Step({}, 1);
  HearOther({.now_ns = 2 * kSecond, .granted_until_ns = 2 * kSecond, .agents = 4});
  EXPECT_EQ(Extension(daemon_.status(), "standby"), "ready");
  if (GetParam()) jump(3);
  EndOther();
  std::vector<v1::Input> last = Joined(honest_.ToldTo(2, 4), other_.ToldTo(2, 4));
  std::erase_if(last, [](const v1::Input& input) { return input.has_agent_states(); });
  for (v1::Input& input : last) {  // No state follows.
    input.mutable_simulator_clock()->set_states_sequence(GetParam() ? 8 : 6);
  }
  daemon_.Step(last, 0.01);
  const v1::Clearance clearance = daemon_.clearance(SimulatorId("beta"));
  EXPECT_EQ(clearance.agents(0).void_from_ns() != kNeverNs, GetParam());
}
INSTANTIATE_TEST_SUITE_P(BreachOnceReady, BreachTest, testing::Bool());

// Goal:   what one simulator tells of times that never come leaves the others their room.
TEST_F(OneBesideAnotherTest, AFloodOfOneTakesAnEighthOfWhatIsKept) {
  std::vector<v1::Input> flood;
  for (std::size_t i = 0; i < FollowedRounds::kKeptMax + 1; ++i) {
    flood.push_back(From(2, State(0, 3600 * kSecond, 3 + i), "beta"));
  }
  daemon_.Step(std::move(flood), 0.01);
  const std::uint64_t taken = daemon_.counter("states_received");
  EXPECT_GE(taken, FollowedRounds::kKeptMax - FollowedRounds::kKeptOfOneMax);
  v1::AgentState ahead = honest_.StateOf(0, 30);
  daemon_.Step({From(1, ahead, "alpha")}, 0.01);
  EXPECT_EQ(daemon_.counter("states_received"), taken) << "kept until its round";
}

// Goal:   of a simulator that is many steps ahead a standby refuses no state, also where it cannot
//         keep all of them until their round: the service in force has granted that time.
TEST_F(OneBesideAnotherTest, WhatIsAheadIsNotRefused) {
  for (int step = 1; step <= 20000; ++step) {
    daemon_.Step({From(2, other_.StateOf(0, step), "beta")});
  }
  EXPECT_EQ(daemon_.counter("rejected_future_stamp"), 0u);
  EXPECT_GT(daemon_.counter("states_received"), 0u) << "more than may wait";
}

}  // namespace
}  // namespace collision::server
