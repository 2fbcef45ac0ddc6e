// Goal:   an operator reads first what is wrong, of whom, and what to do; of a world that is well
//         that it is, and of nothing that is over.
// Method: statuses and reports by hand, through a monitor.
#include "client/programs/tools/collisionctl/status/verdict.h"

#include <gtest/gtest.h>

#include "tests/client/programs/tools/collisionctl_fixture.h"

namespace collision::client {
namespace {

using Lines = std::vector<std::string>;

class VerdictTest : public CollisionctlTest {
 protected:
  /// A refusal of an agent of a simulator, by the service in force.
  v1::SimulatorReport* Refuse(std::uint64_t simulator, const std::string& name) {
    v1::SimulatorReport* report = next_.outputs.emplace_back().mutable_simulator_report();
    report->mutable_stamp()->set_service_id(1);
    report->set_simulator_id(simulator);
    report->set_name(name);
    report->set_run(7);
    report->set_alive(true);
    report->set_refused(1);
    v1::StandingRefusal* refusal = report->add_refusals();
    refusal->set_reason(v1::REJECTED_OUT_OF_RANGE);
    refusal->set_generation(1);
    refusal->set_field("radius_m");
    refusal->set_detail("-1, allowed: 0 to 1e+12");
    return report;
  }

  Lines Now() {
    monitor_.Poll(std::chrono::nanoseconds(0));
    return Verdict(view_);
  }
};

TEST_F(VerdictTest, AWorldWithoutTroubleIsWell) {
  Status();
  EXPECT_EQ(Now(), Lines{"WELL: it serves, and no simulator is here"});
  Status()->add_simulators();
  EXPECT_EQ(Now(), Lines{"WELL: time is not held up, nothing has failed, nothing is refused"});
}

TEST_F(VerdictTest, ThatDeclarationsWereBrokenIsToldWithTheWord) {
  v1::ServiceStatus* status = Status();
  status->add_simulators();
  v1::Counter* breaches = status->add_counters();
  breaches->set_name("breaches");
  breaches->set_value(40);
  EXPECT_EQ(Now(), Lines{"WELL: time is not held up, nothing has failed, nothing is refused; but "
                         "agents broke what they declare, 40 times: collisionctl agents"});
}

TEST_F(VerdictTest, SaysForWhomTimeWaitsWhyAndWhatEndsIt) {
  v1::ServiceStatus* status = Status();
  Extend(status, "waiting_for", "beta");
  Extend(status, "waiting_why", "beta: not heard for more than 12 s");
  EXPECT_EQ(Now(), Lines{"WAITS for beta: not heard for more than 12 s; let it go on, start it "
                         "again, or give it up: collisionctl evict beta"});
}

TEST_F(VerdictTest, NamesAllForWhomTimeWaitsBeforeTheReasonOfEach) {
  v1::ServiceStatus* status = Status();
  Extend(status, "waiting_for", "one, one-b, simulators to come: 2, shape ab12, +7 more");
  Extend(status, "waiting_why",
         "one-b: not back, one: was granted time and has not made its next step, "
         "simulators to come: 2 before time begins (clock.simulators_awaited), "
         "shape ab12: not there yet or still being built, +7 more");
  const std::string advice = "; let it go on, start it again, or give it up: collisionctl evict ";
  EXPECT_EQ(Now(),
            (Lines{"WAITS for one, one-b, simulators to come: 2, shape ab12, +7 more: the world's "
                   "time stands",
                   "  one: was granted time and has not made its next step" + advice + "one",
                   "  one-b: not back" + advice + "one-b",
                   "  simulators to come: 2: before time begins (clock.simulators_awaited); start "
                   "them",
                   "  shape ab12: not there yet or still being built; it ends by itself",
                   "  +7 more: collisionctl status --all lists the simulators"}));
}

TEST_F(VerdictTest, SaysWhatIsRefusedAndHowToCorrectIt) {
  Status();
  Describe("ball", 7, 0);
  Refuse(5, "sim");
  EXPECT_EQ(Now(), Lines{"REFUSES sim: agent ball: radius_m: -1, allowed: 0 to 1e+12 "
                         "(out-of-range); correct the value that it sends"});
  Refuse(5, "sim")->set_refused(3);
  v1::SimulatorReport* other = Refuse(6, "other");
  other->mutable_refusals(0)->set_topic(v1::TOPIC_SIMULATOR_CLOCK);
  other->mutable_refusals(0)->set_reason(v1::REJECTED_CLOCK_SKEW);
  const Lines lines = Now();
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[0], "REFUSES sim, other: what they send does not count");
  EXPECT_NE(lines[1].find("(out-of-range; 2 more); correct"), std::string::npos) << lines[1];
  EXPECT_EQ(lines[2],
            "  other: radius_m: -1, allowed: 0 to 1e+12 (clock-skew); synchronise its clock, or "
            "raise clock.skew_max_s");
}

TEST_F(VerdictTest, ARefusalThatIsOverIsNotTold) {
  Status()->add_simulators();
  Refuse(1, "left")->set_alive(false);
  Refuse(2, "evicted")->set_ended(v1::RUN_EVICTED);
  Refuse(3, "of a former service")->mutable_stamp()->set_service_id(99);
  Refuse(4, "corrected");
  Refuse(4, "corrected")->clear_refusals();
  const Lines lines = Now();
  ASSERT_EQ(lines.size(), 1u) << lines[0];
  EXPECT_TRUE(lines[0].starts_with("WELL: ")) << lines[0];
}

TEST_F(VerdictTest, ASimulatorThatDoesNotFitIsRefused) {
  Extend(Status(), "unfit", "drones: clock_kind lock-step, the service: real time, +2 more");
  EXPECT_EQ(Now(), Lines{"REFUSES drones: clock_kind lock-step, the service: real time, +2 more; "
                         "start it with what the service expects"});
}

TEST_F(VerdictTest, TellsTheGravestFirst) {
  v1::ServiceStatus* status = Status();
  Extend(status, "narrow_phase_held", "bad (held to its share of 1/2 for 3 s; 9 pairs wait)");
  Extend(status, "quotas", "guest: agents 20 of 20");
  Extend(status, "flooding", "simulator \"bad\": 7 messages dropped; 3 wait; ignored for 9 s");
  Extend(status, "recording_failure", "/r: cannot be written, at byte 7");
  Extend(status, "waiting_for", "beta");
  Refuse(5, "sim");
  v1::ServiceStatus* standby = Status();
  standby->set_service_id(0xab);
  standby->set_phase(v1::PHASE_STANDBY);
  Extend(standby, "state_failure", "/k: full");
  const Lines lines = Now();
  ASSERT_EQ(lines.size(), 8u);
  const char* starts[] = {"WAITS for beta: let it go on",
                          "FAILS to record, to keep its journal (standby 00000000000000ab): ",
                          "  to record: /r: cannot be written, at byte 7; free space",
                          "  to keep its journal (standby 00000000000000ab): /k: full; see to",
                          "REFUSES sim: ",
                          "HOLDS BACK: bad (held to its share of 1/2 for 3 s; 9 pairs wait)",
                          "NEARS A LIMIT: guest: agents 20 of 20",
                          "FLOODED: simulator \"bad\": 7 messages dropped"};
  for (std::size_t i = 0; i < 8; ++i) EXPECT_TRUE(lines[i].starts_with(starts[i])) << lines[i];
}

TEST(Shortened, SaysHowManyAreMissing) {
  EXPECT_EQ(Shortened({}, 9), "");
  EXPECT_EQ(Shortened({"alpha", "b", "c"}, 9), "alpha, b and 1 more");
  EXPECT_EQ(Shortened({"alpha", "b"}, 9, 5), "alpha, b and 5 more");
  EXPECT_EQ(Shortened({"longer than this"}, 9), "longer than this");
}

}  // namespace
}  // namespace collision::client
