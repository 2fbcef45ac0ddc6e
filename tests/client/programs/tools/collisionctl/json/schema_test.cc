// Goal:   what collisionctl prints as JSON is what schema.json says, of every kind, with everything
//         known and with nothing known; and the schema refuses what it does not say.
// Method: documents of a world that is filled by hand are validated by Debian's python3-jsonschema.
#include <gtest/gtest.h>

#include "client/programs/tools/collisionctl/doctor/findings.h"
#include "client/programs/tools/collisionctl/json/event_json.h"
#include "client/programs/tools/collisionctl/json/status_json.h"
#include "client/programs/tools/collisionctl/json/world_json.h"
#include "client/programs/tools/collisionctl/operator_request.h"
#include "idl/limits.h"
#include "tests/client/fake_transport.h"
#include "tests/client/programs/tools/collisionctl/json/schema_check.h"
#include "tests/client/programs/tools/collisionctl_fixture.h"

namespace collision::client {
namespace {

class SchemaTest : public CollisionctlTest {
 protected:
  void FillWorld() {
    FillStatus();
    FillAgent();
    v1::ShapePart* part = next_.inputs.emplace_back().mutable_shape_part();
    part->set_simulator_id(5);
    part->set_content_hash(std::string(32, '\xab'));
    v1::EarliestIntersection* earliest =
        next_.outputs.emplace_back().mutable_earliest_intersection();
    earliest->set_found(true);
    earliest->set_earliest_ns(1'795'229'895'022'000'001);
    earliest->mutable_lower()->set_simulator_id(5);
    earliest->mutable_lower()->set_run(7);
    earliest->mutable_lower()->set_generation(1);
    earliest->mutable_higher()->set_simulator_id(77);
    monitor_.Poll(std::chrono::nanoseconds(0));
  }

  void FillStatus() {
    v1::ServiceStatus* status = Status();
    status->set_configuration(~std::uint64_t{0});
    status->set_frame("ENU \"home\" \\ 1\n");
    Extend(status, "process", "pid 7 on host");
    Extend(status, "waiting_for", "beta");
    status->add_left_out("rotation");
    v1::Counter* counter = status->add_counters();
    counter->set_name("queries");
    counter->set_value(3);
    v1::SimulatorStatus* simulator = status->add_simulators();
    simulator->set_simulator_id(5);
    simulator->set_name("sim");
    simulator->set_granted_until_ns(std::numeric_limits<std::int64_t>::min());
    simulator->mutable_clock_offset()->set_earliest_ns(-215'000);
    simulator->mutable_clock_offset()->set_latest_ns(kNever);
    v1::QuotaUse* use = simulator->add_quotas();
    use->set_resource("agents");
    use->set_used(3);
    simulator->set_refused_now(1);
    simulator->set_refused_why("OUT_OF_RANGE: radius_m");
    status->set_build("GCC");
    v1::Histogram* steps = status->add_histograms();
    steps->set_name("step_us");
    for (int i = 0; i < wire::kHistogramCountsMax; ++i) steps->add_counts(1);
    v1::ServiceStatus* standby = Status();
    standby->set_service_id(2);
    standby->set_phase(v1::PHASE_STANDBY);
  }

  void FillAgent() {
    v1::AgentDescription* full = Describe("ball", 7, 0);
    full->set_assembly("arm");
    full->set_class_name("robot");
    full->set_shape_hash(std::string(32, '\xab'));
    full->set_speed_max_m_s(3);
    full->set_time_step_s(0.01);
    full->set_angular_acceleration_max_rad_s2(0);
    full->add_never_meets("table");
    v1::Tag* tag = full->add_tags();
    tag->set_key("kind");
    tag->set_value("fork\tlift");
    Describe("bare", 7, 1)->set_angular_acceleration_max_rad_s2(-1);
    Place(7, 1);
    v1::AgentState* state = next_.inputs.back().mutable_agent_states()->mutable_states(0);
    state->mutable_thrust_direction()->set_x(1);
    state->set_expiry_ns(kNever);
    Clear(7);
    v1::AgentClearance* clearance = next_.outputs.back().mutable_clearance()->mutable_agents(0);
    clearance->set_cause(v1::CAUSE_BREACH);
    clearance->mutable_cause_agent()->set_simulator_id(5);
    Break(7, 0)->set_seen(std::numeric_limits<double>::infinity());
    Break(7, 1);
  }

  std::vector<std::string> Documents() const {
    return {StatusJson(view_), AgentsJson(view_), ShapesJson(view_), EarliestJson(view_)};
  }
};

void FillEncounter(v1::CollisionEvent* event) {
  v1::PairProximity* proximity = event->mutable_proximity();
  proximity->mutable_normal()->mutable_direction()->set_z(1);
  proximity->set_lower_part(3);
  proximity->mutable_relative_velocity()->set_error_m_s(0.5);
  event->mutable_lower_state()->set_stamp_ns(3);
  event->mutable_higher_state()->mutable_velocity_m_s()->set_x(1);
  event->mutable_closest()->mutable_at()->set_latest_ns(9);
  event->mutable_closest()->mutable_distance_m()->set_upper(
      std::numeric_limits<double>::infinity());
  event->mutable_expected()->set_outcome(v1::EXPECTED_PASS);
  event->mutable_expected()->mutable_closest()->set_until_ns(11);
}

TEST_F(SchemaTest, TakesAnEmptyWorld) {
  Status();
  Poll(1);
  EXPECT_EQ(ComplaintsAbout(Documents()), "") << "or python3-jsonschema is missing: "
                                                 "docker/packages.txt";
}

TEST_F(SchemaTest, TakesAWorldOfWhichEverythingIsKnown) {
  FillWorld();
  EXPECT_EQ(ComplaintsAbout(Documents()), "");
}

TEST_F(SchemaTest, TakesEventsOfEveryStatusEvaluatedOrNot) {
  std::vector<std::string> documents;
  for (int status = 0; status < v1::EventStatus_ARRAYSIZE; ++status) {
    v1::CollisionEvent event = OwnEvent(1, 1, 1);
    event.set_status(static_cast<v1::EventStatus>(status));
    event.mutable_begin()->set_earliest_ns(status * std::int64_t{1'000'000'000});
    event.mutable_begin()->set_latest_ns(kNever);
    documents.push_back(EventJson(event, view_, ""));
    event.mutable_proximity()->set_at_ns(5);
    event.mutable_proximity()->mutable_separation_m()->set_upper(status - 3);
    event.set_limited_by(static_cast<v1::EventLimit>(status % 4));
    event.set_contacts_sequence(7);
    FillEncounter(&event);
    event.set_level("near");
    event.mutable_lower_label()->set_simulator_name("people");
    event.mutable_lower_label()->add_tags()->set_key("kind");
    documents.push_back(EventJson(event, view_, "A sentence."));
  }
  documents.push_back(GapJson(2, 5));
  EXPECT_EQ(ComplaintsAbout(documents), "");
}

TEST_F(SchemaTest, TakesTheAnswersToOperators) {
  EXPECT_EQ(ComplaintsAbout({ResultJson({RequestOutcome::kDone, "done: it is removed"}),
                             ResultJson({RequestOutcome::kNoAnswer, ""})}),
            "");
}

TEST_F(SchemaTest, TakesWhatTheDoctorFinds) {
  EXPECT_EQ(
      ComplaintsAbout({DoctorJson({}),
                       DoctorJson({{.matter = "nobody", .what = "none", .advice = "start one"}})}),
      "");
}

// Did the schema take anything, the tests above would say nothing.
TEST_F(SchemaTest, RefusesWhatItDoesNotSay) {
  FillWorld();
  const std::string good = AgentsJson(view_);
  for (const auto& [from, to] : {std::pair("\"kind\":\"agents\"", "\"kind\":\"agent\""),
                                 {"\"schema\":\"collision/1\"", "\"schema\":\"collision/2\""},
                                 {"\"presence\":\"held\"", "\"presence\":\"HELD\""},
                                 {"\"simulator_id\":\"0000000000000005\"", "\"simulator_id\":5"},
                                 {"\"stamp_ns\":\"2000000000\"", "\"stamp_ns\":2000000000"},
                                 {"\"slot\":0,", ""},
                                 {"\"slot\":0,", "\"slot\":0,\"slot\":0,"},
                                 {"\"slot\":0,", "\"slot\":0,\"more\":0,"},
                                 {"[1.5,0,0]", "[1.5,0]"},
                                 {"\"radius_m\":0.5", "\"radius_m\":NaN"}}) {
    std::string bad = good;
    const std::size_t at = bad.find(from);
    ASSERT_NE(at, std::string::npos) << from << good;
    bad.replace(at, std::string(from).size(), to);
    EXPECT_NE(ComplaintsAbout({bad}), "") << to;
  }
}

}  // namespace
}  // namespace collision::client
