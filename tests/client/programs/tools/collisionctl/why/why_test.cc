// Goal:   of two agents it is told what the service's mathematics makes of their declarations and
//         states: when they can meet, which term of which agent reaches how far, what keeps them
//         apart, and what would narrow the answer most. Nothing is computed of what the service
//         would refuse.
// Method: two agents by hand, head-on, with one term at a time; the terms against the core's bound.
#include <gtest/gtest.h>

#include "client/programs/tools/collisionctl/why/advice.h"
#include "client/programs/tools/collisionctl/why/agent_lookup.h"
#include "client/programs/tools/collisionctl/why/why_page.h"
#include "collision_core/motion/space_time_bound.h"
#include "idl/limits.h"
#include "tests/client/fake_transport.h"
#include "tests/client/programs/tools/collisionctl/json/schema_check.h"
#include "tests/client/programs/tools/collisionctl_fixture.h"

namespace collision::client {
namespace {

constexpr std::int64_t kNow = 12'345'678'901;  // of Status()
constexpr std::int64_t kSecond = 1'000'000'000;

class WhyTest : public CollisionctlTest {
 protected:
  void SetUp() override {
    v1::SimulatorStatus* simulator = Status()->add_simulators();
    simulator->set_simulator_id(5);
    simulator->set_name("sim");
    simulator->set_run(7);
    simulator->set_alive(true);
    for (const std::uint32_t slot : {0, 1}) {
      v1::AgentDescription* description = Describe(slot == 0 ? "ada" : "bob", 7, slot);
      description->set_acceleration_max_m_s2(0);
      description->set_angular_acceleration_max_rad_s2(-1);
      v1::AgentStates* states = next_.inputs.emplace_back().mutable_agent_states();
      states->set_simulator_id(5);
      states->set_run(7);
      states->set_chunk(slot);
      v1::AgentState* state = states->add_states();
      state->set_slot(slot);
      state->set_generation(1);
      state->set_stamp_ns(kNow);
      state->mutable_position_m()->set_x(slot == 0 ? 0 : 11);
      state->mutable_velocity_m_s()->set_x(slot == 0 ? 1 : 0);
      state->mutable_orientation()->set_w(1);
      state->set_direction_until_ns(kNever);
      state->set_expiry_ns(kNever);
    }
  }

  v1::AgentDescription* Of(std::uint32_t slot) {
    return next_.inputs[2 * slot].mutable_agent_description();
  }
  v1::AgentState* StateOf(std::uint32_t slot) {
    return next_.inputs[2 * slot + 1].mutable_agent_states()->mutable_states(0);
  }

  PairReport Report() {
    monitor_.Poll(std::chrono::nanoseconds(0));
    const AgentView a = FindAgent(view_, "ada"), b = FindAgent(view_, "bob");
    return ReportOn(a, b, NewestOf(IdOf(a), IdOf(b), &view_), view_);
  }
};

TEST_F(WhyTest, ExactMotionMeetsWhenItMust) {
  const PairReport report = Report();
  ASSERT_TRUE(report.earliest_ns);
  EXPECT_NEAR(static_cast<double>(*report.earliest_ns - kNow), 10e9, 100);
  EXPECT_LE(*report.earliest_ns, kNow + 10 * kSecond);
  EXPECT_EQ(report.distance, 11);
  EXPECT_EQ(report.gap, 10);
  EXPECT_EQ(AdviceOn(report),
            "nothing: their motion itself brings them together, all that is not "
            "known of it is 0 m");
  EXPECT_TRUE(report.apart.empty());
}

TEST_F(WhyTest, AHalfSpaceIsMetWhereItsPlaneIs) {
  Of(1)->set_radius_m(0);
  Of(1)->mutable_half_space()->mutable_normal()->set_x(-1);
  Of(1)->mutable_half_space()->set_offset_m(-20);
  const double radius = Of(0)->radius_m();
  const PairReport report = Report();
  ASSERT_TRUE(report.earliest_ns);
  EXPECT_EQ(report.distance, 20);
  EXPECT_EQ(report.gap, 20 - radius);
  EXPECT_NEAR(static_cast<double>(*report.earliest_ns - kNow), (20 - radius) * 1e9, 100);
  const std::string page = WhyPage(report, view_);
  EXPECT_NE(page.find("all x with (-1, 0, 0) · x <= -20 m"), std::string::npos) << page;
}

// Bob is told of 15 s ahead, when Ada has passed the place.
TEST_F(WhyTest, WhereAStateLiesAheadItIsSaidFromWhenOnTheAnswerHolds) {
  StateOf(1)->set_stamp_ns(kNow + 15 * kSecond);
  const PairReport report = Report();
  EXPECT_EQ(report.from_ns, kNow + 15 * kSecond);
  EXPECT_NEAR(report.distance, 4, 1e-9);
  EXPECT_EQ(report.earliest_ns, kNever);
  const std::string page = WhyPage(report, view_);
  EXPECT_NE(page.find("m between the reference points at 27.345 s"), std::string::npos) << page;
  EXPECT_NE(page.find("never, from these bounds; a state lies ahead of now: what was told of the "
                      "time before 27.345 s is not looked at"),
            std::string::npos)
      << page;
}

TEST_F(WhyTest, MarginsCount) {
  Of(0)->set_margin_m(2);
  Of(1)->set_margin_m(3);
  const PairReport report = Report();
  EXPECT_EQ(report.gap, 5);
  EXPECT_NEAR(static_cast<double>(*report.earliest_ns - kNow), 5e9, 100);
}

// The formula on the page is that of the bound with which the service computes.
TEST(Reach, IsThatOfTheCoresBound) {
  v1::AgentDescription description;
  description.set_acceleration_max_m_s2(1.5);
  description.set_jerk_max_m_s3(0.25);
  description.set_time_step_s(0.125);
  v1::AgentState state;
  state.mutable_velocity_m_s()->set_y(2);
  state.mutable_acceleration_m_s2()->set_z(-9);
  state.set_position_error_m(0.5);
  state.set_velocity_error_m_s(0.0625);
  motion::SpaceTimeBound bound;
  bound.skew = 0.01;
  bound.limits = {.acceleration_max = 1.5, .jerk_max = 0.25, .time_step = 0.125};
  bound.state.v_WA = {0, 2, 0};
  bound.state.a_WA = {0, 0, -9};
  bound.state.position_error = 0.5;
  bound.state.velocity_error = 0.0625;
  const Instant base = Instant::FromNanoseconds(3 * kSecond);
  const Reach reach = ReachAfter(3, 0.01, description, state);
  EXPECT_NEAR(reach.acceleration + reach.jerk, ForwardDeviation(bound, base).c0.upper, 1e-9);
  EXPECT_NEAR(reach.position_error + reach.velocity_error + reach.skew,
              ForwardErrors(bound, base).c0.upper, 1e-9);
  EXPECT_GT(reach.jerk, 0);
  EXPECT_GT(reach.skew, 0);
}

TEST_F(WhyTest, AnOldStateIsWhatWouldHelpMost) {
  Of(1)->set_acceleration_max_m_s2(2);
  StateOf(1)->set_stamp_ns(kNow - 3 * kSecond);
  const PairReport report = Report();
  EXPECT_EQ(report.b.first.acceleration, 9);
  EXPECT_EQ(report.b.age, 3);
  EXPECT_TRUE(AdviceOn(report).starts_with(
      "a newer state of bob (sim): its last is 3 s old; that makes up "))
      << AdviceOn(report);
  EXPECT_LT(*report.earliest_ns, kNow + 2 * kSecond);
}

TEST_F(WhyTest, ABoundIsNamedWhereItReachesFarthest) {
  Of(0)->set_acceleration_max_m_s2(5);
  const std::string advice = AdviceOn(Report());
  EXPECT_TRUE(advice.starts_with("a smaller acceleration_max_m_s2 of ada (sim), ")) << advice;
}

TEST_F(WhyTest, ErrorsAreNamedWhereTheyReachFarthest) {
  StateOf(1)->set_position_error_m(3);
  StateOf(0)->set_velocity_error_m_s(0.1);
  const PairReport report = Report();
  EXPECT_TRUE(AdviceOn(report).starts_with("a smaller position_error_m in the states of bob (sim)"))
      << AdviceOn(report);
}

TEST_F(WhyTest, WhatLimitsTheEventComesFirst) {
  Of(0)->set_acceleration_max_m_s2(5);
  v1::CollisionEvent* event = next_.outputs.emplace_back().mutable_collision_event();
  *event = OwnEvent(1, 1, 1);
  for (v1::AgentId* id : {event->mutable_lower(), event->mutable_higher()}) {
    id->set_simulator_id(5);
    id->set_run(7);
    id->set_generation(1);
  }
  event->mutable_lower()->set_slot(1);
  event->mutable_higher()->set_slot(0);
  event->set_limited_by(v1::LIMIT_BUDGET);
  const PairReport report = Report();
  ASSERT_TRUE(report.event);
  EXPECT_EQ(AdviceOn(report), "more working time: its event is limited by budget (time_budget_us)");
}

TEST_F(WhyTest, TellsWhichFilterKeepsThemApart) {
  Of(0)->set_assembly("arm");
  Of(1)->set_assembly("arm");
  EXPECT_EQ(Report().apart,
            std::vector<std::string>{"both are of assembly arm, and neither lists the other in "
                                     "meets_in_assembly"});
}

TEST_F(WhyTest, OneOfAPairIsEnoughToListTheOther) {
  Of(0)->set_assembly("arm");
  Of(1)->set_assembly("arm");
  Of(1)->add_meets_in_assembly("ada");
  EXPECT_TRUE(Report().apart.empty());
}

TEST_F(WhyTest, NeverMeetsWins) {
  Of(1)->add_never_meets("ada");
  Of(0)->set_class_name("robot");
  Of(1)->set_class_name("person");
  const PairReport report = Report();
  EXPECT_EQ(report.apart, std::vector<std::string>{"one lists the other in never_meets"});
  EXPECT_EQ(report.not_told,
            (std::vector<std::string>{"whether class robot meets class person",
                                      "whether the configuration excludes the pair"}))
      << "no hello has come";
  EXPECT_TRUE(AdviceOn(report).starts_with("nothing: the pair is not looked at, since one lists"));
}

// Goal:   what the hello of the service says of classes and excluded pairs is said.
TEST_F(WhyTest, TellsWhichClassesOfTheConfigurationMeet) {
  const auto report = [this](const std::string& a, const std::string& b,
                             const std::string& excluded) {
    v1::ServiceHello* hello = next_.outputs.emplace_back().mutable_service_hello();
    hello->set_service_id(1);
    hello->set_wire_revision(wire::kWireRevision);
    for (const auto& [key, value] : {std::pair("excluded", excluded),
                                     {"class.robot", "forklift robots"},
                                     {"class.forklift", ""},
                                     {"class.robots", ""}}) {
      v1::KeyValue* extension = hello->add_extensions();
      extension->set_key(key);
      extension->set_value(value);
    }
    Describe("ada", 7, 0)->set_class_name(a);
    Describe("bob", 7, 1)->set_class_name(b);
    return Report();
  };
  for (const char* met : {"forklift", "robots"}) {
    EXPECT_TRUE(report(met, "robot", "0").apart.empty()) << "one of them lists the other";
    EXPECT_TRUE(report("robot", met, "0").apart.empty()) << met;
    EXPECT_TRUE(report("robot", met, "0").not_told.empty()) << met;
  }
  EXPECT_EQ(report("robots", "forklift", "0").apart,
            std::vector<std::string>{"class robots does not meet class forklift"});
  EXPECT_EQ(report("robot", "unknown", "3").not_told,
            (std::vector<std::string>{"whether class robot meets class unknown",
                                      "whether the configuration excludes the pair, one of 3"}));
}

TEST_F(WhyTest, TwoThatCannotMoveAreNotLookedAt) {
  StateOf(0)->mutable_velocity_m_s()->set_x(0);
  const PairReport report = Report();
  EXPECT_EQ(*report.earliest_ns, kNever);
  EXPECT_EQ(report.apart, std::vector<std::string>{"neither can move"});
}

TEST_F(WhyTest, NothingIsComputedOfWhatTheServiceWouldRefuse) {
  StateOf(1)->mutable_position_m()->set_x(std::numeric_limits<double>::quiet_NaN());
  const PairReport report = Report();
  EXPECT_FALSE(report.earliest_ns);
  EXPECT_NE(report.b.unusable.find("position_m"), std::string::npos) << report.b.unusable;
  EXPECT_TRUE(AdviceOn(report).starts_with("what is missing of bob (sim): ")) << AdviceOn(report);
  EXPECT_EQ(ComplaintsAbout({WhyJson(report, view_)}).find("nan"), std::string::npos);
  EXPECT_NE(WhyPage(report, view_), "");
}

TEST_F(WhyTest, ThePageAndItsJsonSayAll) {
  Of(1)->set_acceleration_max_m_s2(2);
  StateOf(1)->set_stamp_ns(kNow - 3 * kSecond);
  const PairReport report = Report();
  const std::string page = WhyPage(report, view_);
  for (const char* part :
       {"ada (sim)", "ball of 0.5 m", "D 2 m/s², J 0 m/s³", "3.000 s old, at 9.345 s", "reach now ",
        "9 m: acceleration 9", "reach at the earliest",
        "distance     11 m between the reference points now, 1 m between all that they can reach\n",
        "earliest     not before 12.", "apart        nothing that they declare\n",
        "event        none\n", "narrower by  a newer state of bob (sim)"}) {
    EXPECT_NE(page.find(part), std::string::npos) << part << "\n" << page;
  }
  EXPECT_EQ(ComplaintsAbout({WhyJson(report, view_)}), "");
}

TEST_F(WhyTest, ANameThatFitsNoneOrSeveralIsRefusedWithWhatThereIs) {
  monitor_.Poll(std::chrono::nanoseconds(0));
  const auto complaint = [this](const std::string& name) -> std::string {
    try {
      return view_.Name(IdOf(FindAgent(view_, name)));
    } catch (const NoSuchAgent& error) {
      return error.what();
    }
  };
  EXPECT_EQ(complaint("sim:bob"), "bob");
  EXPECT_EQ(complaint("carl"), "no agent \"carl\" in this world; known: sim:ada, sim:bob");
  Describe("bob", 7, 2);
  Poll(1);
  EXPECT_EQ(complaint("bob"), "\"bob\" names 2 agents: sim:bob, sim:bob");
}

}  // namespace
}  // namespace collision::client
