// Goal:   a simulator's user is told what stands in the way: once for each cause, again rarely, and
//         when it is over; of another cause that follows from the first nothing.
// Method: situations and times made by hand; then a World on a network under the test's control.
#include "client/library/notices/notices.h"

#include <gtest/gtest.h>

#include "tests/client/fake_transport.h"

namespace collision::client {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using Situation = Notices::Situation;

class NoticesTest : public testing::Test {
 protected:
  std::vector<Notice> Look(const Situation& situation, std::chrono::nanoseconds at) {
    notices_.Look(situation, Notices::Time() + at);
    return TakeAll();
  }

  std::vector<Notice> TakeAll() {
    std::vector<Notice> all;
    while (const auto notice = notices_.Take()) all.push_back(*notice);
    return all;
  }

  Notices notices_{{.simulator = "me", .world = "lab", .domain = 3, .lock_step = true}};
};

bool Has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST_F(NoticesTest, NoServiceIsToldAfterThreeSecondsThenRarelyAndWhenItIsOver) {
  EXPECT_TRUE(Look({}, seconds(5)).empty());
  EXPECT_TRUE(Look({}, milliseconds(7999)).empty());
  const auto told = Look({}, seconds(8));
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].kind, NoticeKind::kNoService);
  EXPECT_FALSE(told[0].over);
  EXPECT_TRUE(Has(told[0].text, "world \"lab\" on DDS domain 3")) << told[0].text;
  EXPECT_TRUE(Has(told[0].text, "CYCLONEDDS_URI")) << told[0].text;
  EXPECT_TRUE(Look({}, seconds(67)).empty());
  EXPECT_EQ(Look({}, seconds(68)).size(), 1u);
  const auto over = Look({.service_heard = true}, seconds(69));
  ASSERT_EQ(over.size(), 1u);
  EXPECT_TRUE(over[0].over);
  EXPECT_TRUE(Look({}, seconds(70)).empty()) << "it begins anew";
}

TEST_F(NoticesTest, AShortSilenceIsNotWorthAWord) {
  EXPECT_TRUE(Look({}, seconds(0)).empty());
  EXPECT_TRUE(Look({.service_heard = true}, milliseconds(2900)).empty());
  EXPECT_TRUE(Look({}, seconds(4)).empty());
  EXPECT_TRUE(Look({.service_heard = true}, seconds(5)).empty());
}

TEST_F(NoticesTest, TheWrongClockIsToldAtOnceWithWhatToChange) {
  const Situation wrong{.service_heard = true, .world_lock_step = false, .waits = true};
  const auto told = Look(wrong, seconds(0));
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].kind, NoticeKind::kWrongClock);
  EXPECT_TRUE(Has(told[0].text, "lock-step, but")) << told[0].text;
  EXPECT_TRUE(Has(told[0].text, "--real-time (WorldOptions::lock_step = false)")) << told[0].text;
  EXPECT_TRUE(Look(wrong, seconds(10)).empty()) << "that no time is granted follows from it";
  const auto over = Look({.service_heard = true, .world_lock_step = true}, seconds(11));
  ASSERT_EQ(over.size(), 1u);
  EXPECT_TRUE(over[0].over);
}

// Goal:   a clock of the other kind is told once, in the words of its own notice: what the hellos
//         and the service say of it besides is no further news.
TEST_F(NoticesTest, TheWrongClockIsToldOnceOnly) {
  for (const char* field : {"clock_kind", "lock_step"}) {
    Rejection rejection;
    rejection.reason = "REJECTED_MISMATCH";
    rejection.field = field;
    notices_.Refuse(rejection, "");
    EXPECT_FALSE(notices_.Take()) << field;
  }
}

// Goal:   a step that is far ahead is told after 3 s, and again after a minute, while time goes on;
//         one of many short ones is not.
TEST_F(NoticesTest, AStepFarAheadIsToldWhileTimeGoesOn) {
  Situation waits{.service_heard = true, .world_lock_step = true, .waits = true};
  waits.next_ns = 2'000'000'000'000;
  waits.laggard = Laggard{"drones", 4'000'000'000};
  std::vector<Notice> all;
  for (int s = 0; s <= 64; ++s) {
    waits.granted_until_ns = s * 1'000'000'000LL;
    for (Notice& notice : Look(waits, seconds(s))) all.push_back(notice);
    if (s == 2) {
      EXPECT_TRUE(all.empty());
    }
    if (s == 3) {
      EXPECT_EQ(all.size(), 1u);
    }
  }
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].kind, NoticeKind::kWaiting);
  EXPECT_EQ(all[0].text,
            "the next step of this simulator is at 2000.000 s, and the world's time, which goes "
            "on, has come to 3.000 s; furthest behind is drones, at 4.000 s");
  for (int s = 65; s < 90; ++s) {
    waits.granted_until_ns = s * 1'000'000'000LL;
    waits.next_ns = waits.granted_until_ns + 5;
    EXPECT_TRUE(Look(waits, seconds(s)).empty()) << s;
  }
}

TEST_F(NoticesTest, AWaitNamesThoseWhomTheServiceNames) {
  Situation waits{.service_heard = true, .world_lock_step = true, .waits = true};
  waits.granted_until_ns = 2'500'000'000;
  waits.waiting_for = {"me", "ada"};
  EXPECT_TRUE(Look(waits, seconds(0)).empty());
  const auto told = Look(waits, seconds(3));
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].kind, NoticeKind::kWaiting);
  EXPECT_EQ(told[0].text, "the world's time stands at 2.500 s for 3 s: it waits for ada");
  EXPECT_TRUE(Look(waits, seconds(7)).empty());
  waits.waiting_for = {"ada", "bob"};
  const auto changed = Look(waits, seconds(8));
  ASSERT_EQ(changed.size(), 1u);
  EXPECT_TRUE(Has(changed[0].text, "for 8 s: it waits for ada, bob")) << changed[0].text;
  waits.granted_until_ns += 1;
  const auto over = Look(waits, seconds(9));
  ASSERT_EQ(over.size(), 1u);
  EXPECT_TRUE(over[0].over);
  EXPECT_TRUE(Look(waits, seconds(11)).empty()) << "it begins anew";
}

TEST_F(NoticesTest, AWaitForNobodyByNameTellsWhoIsFurthestBehind) {
  Situation waits{.service_heard = true, .waits = true};
  waits.granted_until_ns = 5;
  waits.laggard = {"bob", 1'000'000'000};
  Look(waits, seconds(0));
  const auto told = Look(waits, seconds(3));
  ASSERT_EQ(told.size(), 1u);
  EXPECT_TRUE(Has(told[0].text, "furthest behind is bob, at 1.000 s")) << told[0].text;
}

TEST_F(NoticesTest, AWaitBeginsAnewWhenTheServiceIsBack) {
  const Situation waits{.service_heard = true, .waits = true}, alone{.waits = true};
  Look(waits, seconds(0));
  Look(alone, seconds(2));
  EXPECT_TRUE(Look(waits, seconds(4)).empty());
  EXPECT_TRUE(Look(waits, milliseconds(6999)).empty());
  EXPECT_EQ(Look(waits, seconds(7)).size(), 1u);
}

TEST_F(NoticesTest, TimeThatGoesOnIsNoWait) {
  Situation waits{.service_heard = true, .waits = true};
  for (int second = 0; second < 20; ++second) {
    waits.granted_until_ns = second / 2;
    EXPECT_TRUE(Look(waits, seconds(second)).empty()) << second;
  }
}

TEST_F(NoticesTest, AnotherProgramOfTheNameAndAnEndAreToldOnce) {
  Situation taken{.service_heard = true, .waits = true};
  taken.other_program = "another has it";
  ASSERT_EQ(Look(taken, seconds(0)).size(), 1u);
  EXPECT_TRUE(Look(taken, seconds(9)).empty()) << "that it waits follows from it";
  taken.other_program.clear();
  const auto free = Look(taken, seconds(10));
  ASSERT_EQ(free.size(), 1u);
  EXPECT_TRUE(free[0].over && free[0].kind == NoticeKind::kNameTaken);
  taken.ended = "evicted";
  const auto ended = Look(taken, seconds(11));
  ASSERT_EQ(ended.size(), 1u);
  EXPECT_EQ(ended[0].kind, NoticeKind::kEnded);
  EXPECT_EQ(ended[0].text, "evicted");
}

TEST_F(NoticesTest, EachReasonAndFieldOfARefusalIsToldOnceUpToALimit) {
  Rejection rejection;
  rejection.reason = "REJECTED_OUT_OF_RANGE";
  rejection.topic = "TOPIC_AGENT_STATES";
  rejection.field = "radius_m";
  rejection.detail = "-1, allowed: 0 to 1e6";
  notices_.Refuse(rejection, "ball");
  notices_.Refuse(rejection, "other ball");
  const auto told = TakeAll();
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].kind, NoticeKind::kRefused);
  EXPECT_TRUE(Has(told[0].text, "agent \"ball\": radius_m: -1, allowed: 0 to 1e6")) << told[0].text;
  for (std::size_t i = 0; i < 2 * kRefusalsToldMax; ++i) {
    rejection.field = "field " + std::to_string(i);
    notices_.Refuse(rejection, "");
  }
  EXPECT_EQ(TakeAll().size(), kRefusalsToldMax - 1);
}

TEST_F(NoticesTest, ABreachIsToldOfEachAgentAndBoundAndAgainIfItGoesOn) {
  const Notices::Time start;
  Breach breach{.agent = {},
                .field = "speed_max_m_s",
                .declared = 2,
                .seen = 3,
                .from_ns = 1'500'000'000,
                .at_ns = 1'600'000'000,
                .count = 1};
  notices_.Breach(breach, "ball", start);
  breach.count = 2;
  notices_.Breach(breach, "ball", start + kNoticeAgain - std::chrono::seconds(1));
  breach.field = "acceleration_max_m_s2";
  notices_.Breach(breach, "ball", start);
  notices_.SkewedClock(0);
  notices_.SkewedClock(1);
  auto told = TakeAll();
  ASSERT_EQ(told.size(), 3u);
  EXPECT_TRUE(Has(told[0].text,
                  "ball broke speed_max_m_s: declared 2, at least 3 seen between "
                  "1.500 s and 1.600 s (once)"))
      << told[0].text;
  EXPECT_TRUE(Has(told[1].text, "ball broke acceleration_max_m_s2")) << told[1].text;
  EXPECT_TRUE(Has(told[2].text, "clock")) << told[2].text;
  for (std::size_t i = 0; i < 2 * kBreachesToldMax; ++i) {
    notices_.Breach(breach, "ball " + std::to_string(i), start);
  }
  EXPECT_EQ(TakeAll().size(), kBreachesToldMax - 2);
  breach.field = "speed_max_m_s";
  breach.count = 40;
  notices_.Breach(breach, "ball", start + kNoticeAgain);
  told = TakeAll();
  ASSERT_EQ(told.size(), 1u);
  EXPECT_TRUE(Has(told[0].text, "(40 times)")) << told[0].text;
}

class WorldNoticesTest : public testing::Test {
 protected:
  void Arrive(const v1::ServiceStatus& status) {
    *network_->arriving.emplace_back().mutable_service_status() = status;
  }

  static v1::ServiceStatus Status(bool simulated_clock) {
    v1::ServiceStatus status;
    status.mutable_stamp()->set_service_id(1);
    status.mutable_stamp()->set_term(1);
    status.set_phase(v1::PHASE_SERVING);
    status.set_simulated_clock(simulated_clock);
    return status;
  }

  std::shared_ptr<FakeNetwork> network_ = std::make_shared<FakeNetwork>();
  World world_ = ConnectTo(network_);
  std::vector<Notice> told_;
};

TEST_F(WorldNoticesTest, WithoutAHandlerTheyGoToStandardError) {
  testing::internal::CaptureStderr();
  EXPECT_FALSE(world_.WaitForService({}));
  world_.Poll();
  network_->later = seconds(3);
  world_.Poll();
  world_.Poll();
  const std::string text = testing::internal::GetCapturedStderr();
  EXPECT_EQ(text.find("tester: no service of world \"default\""), 0u) << text;
  EXPECT_EQ(text.find('\n'), text.size() - 1) << "one line: " << text;
}

TEST_F(WorldNoticesTest, AHandlerHearsTheWrongClockInsideACallAndMayThrow) {
  network_->alive = true;
  world_.OnNotice([&](const Notice& notice) {
    told_.push_back(notice);
    EXPECT_THROW(world_.Poll(), std::logic_error);
    throw std::runtime_error(notice.text);
  });
  Arrive(Status(false));
  EXPECT_THROW(world_.AdvanceTo(0, {}), std::runtime_error);
  ASSERT_EQ(told_.size(), 1u);
  EXPECT_EQ(told_[0].kind, NoticeKind::kWrongClock);
  EXPECT_NO_THROW(world_.Poll()) << "told once";
}

TEST_F(WorldNoticesTest, AHandlerMayEndTheWorldThatWaits) {
  for (const bool joins : {false, true}) {
    std::optional<World> world = ConnectTo(network_);
    int told = 0;
    world->OnNotice([&](const Notice&) {
      ++told;
      world.reset();
    });
    network_->on_wait = [](FakeNetwork* network) { network->later += seconds(1); };
    if (joins) {
      EXPECT_FALSE(world->Join(seconds(60)));
    } else {
      EXPECT_FALSE(world->WaitForService(seconds(60)));
    }
    EXPECT_EQ(told, 1);
    EXPECT_FALSE(world);
  }
}

TEST_F(WorldNoticesTest, AStepThatIsNotGrantedNamesWhoHoldsTime) {
  network_->alive = true;
  world_.OnNotice([&](const Notice& notice) { told_.push_back(notice); });
  v1::ServiceStatus status = Status(true);
  v1::SimulatorStatus* other = status.add_simulators();
  other->set_simulator_id(5);
  other->set_name("sleepy");
  const auto step = [&](seconds later) {
    network_->later = later;
    Arrive(status);  // Else the service counts as lost.
    return world_.AdvanceTo(2, {});
  };
  EXPECT_EQ(step(seconds(0)), Advance::kTimeout);
  EXPECT_EQ(step(seconds(2)), Advance::kTimeout);
  EXPECT_TRUE(told_.empty());
  EXPECT_EQ(step(seconds(3)), Advance::kTimeout);
  ASSERT_EQ(told_.size(), 1u);
  EXPECT_EQ(told_[0].kind, NoticeKind::kWaiting);
  EXPECT_TRUE(Has(told_[0].text, "sleepy")) << told_[0].text;
  network_->Grant(10);
  EXPECT_EQ(step(seconds(4)), Advance::kReached);
  ASSERT_EQ(told_.size(), 2u);
  EXPECT_TRUE(told_[1].over);
}

TEST_F(WorldNoticesTest, ARefusalAndABreachNameTheAgent) {
  network_->alive = true;
  world_.OnNotice([&](const Notice& notice) { told_.push_back(notice); });
  const Agent ball = world_.AddAgent(Point(), {});
  v1::Rejection* rejection = network_->arriving.emplace_back().mutable_rejection();
  rejection->mutable_stamp()->set_service_id(1);
  rejection->mutable_stamp()->set_term(1);
  rejection->set_simulator_id(SimulatorId(kSimulator));
  rejection->set_run(kRun);
  rejection->set_topic(v1::TOPIC_AGENT_STATES);
  rejection->set_reason(v1::REJECTED_FUTURE_STAMP);
  rejection->set_field("stamp_ns");
  const auto breach = [&](std::uint64_t simulator, std::uint32_t run) {
    v1::AgentBreach* message = network_->arriving.emplace_back().mutable_agent_breach();
    message->mutable_stamp()->set_service_id(1);
    message->mutable_stamp()->set_term(1);
    message->set_simulator_id(simulator);
    message->set_run(run);
    message->set_generation(1);
    message->set_field("speed_max_m_s");
    message->set_count(1);
  };
  breach(SimulatorId(kSimulator), kRun - 1);
  breach(SimulatorId("another"), kRun);
  breach(SimulatorId(kSimulator), kRun);
  world_.Poll();
  ASSERT_EQ(told_.size(), 2u);
  EXPECT_TRUE(told_[0].kind == NoticeKind::kRefused && Has(told_[0].text, "\"ball\""));
  EXPECT_TRUE(told_[1].kind == NoticeKind::kBreach && Has(told_[1].text, "ball broke speed"));
}

}  // namespace
}  // namespace collision::client
