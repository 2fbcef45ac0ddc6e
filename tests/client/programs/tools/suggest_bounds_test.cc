#include <google/protobuf/util/delimited_message_util.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <sstream>

#include "client/programs/shared/exit_code.h"
#include "client/programs/simulators/player/known_acceleration.h"
#include "client/programs/tools/suggest_bounds/bounds_page.h"
#include "client/programs/tools/suggest_bounds/command.h"
#include "client/programs/tools/suggest_bounds/motion_file.h"
#include "idl/recording_format.h"
#include "tests/client/programs/tools/collisionctl/json/schema_check.h"
#include "tests/support/random.h"

namespace collision::client {
namespace {

constexpr std::int64_t kStepNs = 100'000'000;

/// x(t) = sin t, 10 states a second.
SampledAgent Swinging(int states) {
  SampledAgent agent{.simulator = "sim", .name = "swing"};
  for (int i = 0; i < states; ++i) {
    MotionSample sample;
    sample.stamp_ns = i * kStepNs;
    sample.position_m = {std::sin(0.1 * i), 0, 0};
    sample.velocity_m_s = {std::cos(0.1 * i), 0, 0};
    agent.samples.push_back(sample);
  }
  return agent;
}

v1::AgentState StateOf(std::uint32_t slot, std::int64_t stamp_ns, double x) {
  v1::AgentState state;
  state.set_slot(slot);
  state.set_generation(1);
  state.set_stamp_ns(stamp_ns);
  state.mutable_position_m()->set_x(x);
  state.mutable_velocity_m_s()->set_x(1);
  state.mutable_orientation()->set_w(1);
  return state;
}

v1::AgentDescription DescriptionOf(std::uint32_t slot, const std::string& name) {
  v1::AgentDescription description;
  description.set_simulator_id(5);
  description.set_simulator_name("sim");
  description.set_agent_name(name);
  description.set_run(1);
  description.set_slot(slot);
  description.set_generation(1);
  description.set_acceleration_max_m_s2(7);
  return description;
}

v1::AgentStates StatesOf(const std::vector<v1::AgentState>& states) {
  v1::AgentStates message;
  message.set_simulator_id(5);
  message.set_run(1);
  message.mutable_states()->Assign(states.begin(), states.end());
  return message;
}

/// A file that is removed again.
class MotionFileTest : public testing::Test {
 protected:
  ~MotionFileTest() override { std::remove(path_.c_str()); }

  void Write(const std::string& text) const { std::ofstream(path_, std::ios::binary) << text; }

  static std::string Recording() {
    std::ostringstream text;
    v1::RecordingEntry header, batch;
    header.mutable_header()->set_format(wire::kRecordingFormat);
    header.mutable_header()->set_version("test");
    auto* inputs = batch.mutable_batch();
    *inputs->add_inputs()->mutable_agent_description() = DescriptionOf(0, "ada");
    *inputs->add_inputs()->mutable_agent_states() = StatesOf({StateOf(0, 0, 0)});
    *inputs->add_inputs()->mutable_agent_states() = StatesOf({StateOf(0, kStepNs, 0.1)});
    for (const v1::RecordingEntry& entry : {header, batch, batch}) {
      google::protobuf::util::SerializeDelimitedToOstream(entry, &text);
    }
    return text.str();
  }

  std::string ErrorOf(const std::string& text) const {
    Write(text);
    try {
      ReadMotionFile(path_);
    } catch (const BadInput& error) {
      return std::string(error.what()).substr(path_.size());
    }
    return "no error";
  }

  const std::string path_ = testing::TempDir() + "motion." + std::to_string(getpid()) + ".file";
};

// Goal:   a sample that comes again is taken once, and a value out of range is left out and told.
TEST(MotionSamples, TakesEachStateOnce) {
  MotionSamples samples;
  samples.Take(StatesOf({StateOf(3, 5, 1)}));
  samples.Take(DescriptionOf(3, "ada"));
  samples.Take(StatesOf({StateOf(3, 5, 1), StateOf(3, 7, 1)}));
  samples.Take(StatesOf({StateOf(3, 9, std::numeric_limits<double>::quiet_NaN())}));
  ASSERT_EQ(samples.Agents().size(), 1u);
  const SampledAgent agent = samples.Agents()[0];
  EXPECT_EQ(agent.name, "ada");
  EXPECT_EQ(agent.simulator, "sim");
  ASSERT_EQ(agent.samples.size(), 2u);
  EXPECT_EQ(agent.samples[1].stamp_ns, 7);
  EXPECT_EQ(agent.declared->acceleration_max_m_s2, 7);
  EXPECT_EQ(samples.refused(), 1u);
  EXPECT_EQ(samples.first_refusal().substr(0, 26), "agent ada: position_m.x: n");
}

TEST_F(MotionFileTest, ReadsRowsAndRecordings) {
  Write("time_s,agent_id,x_m,y_m\n0,a,0,0\n1,a,1,0\n1,b,2,0\n");
  const MotionFile rows = ReadMotionFile(path_);
  EXPECT_FALSE(rows.is_recording);
  ASSERT_EQ(rows.agents.size(), 2u);
  EXPECT_EQ(rows.agents[0].samples.size(), 2u);
  EXPECT_FALSE(rows.agents[0].has_velocities);
  Write(Recording());
  const MotionFile recording = ReadMotionFile(path_);
  EXPECT_TRUE(recording.is_recording);
  ASSERT_EQ(recording.agents.size(), 1u);
  EXPECT_EQ(recording.agents[0].name, "ada");
  EXPECT_EQ(recording.agents[0].samples.size(), 2u);
  EXPECT_EQ(recording.warning, "");
}

// Goal:   a message names file, row or entry, and field; of a recording that is cut off the rest
// counts.
TEST_F(MotionFileTest, ErrorsNameTheirPlace) {
  EXPECT_EQ(ErrorOf("time_s,agent_id,x_m,y_m\n0,a,0,zero\n"),
            ":2: y_m \"zero\" is not a finite number");
  EXPECT_EQ(ErrorOf(std::string("\x05\x01\x02\x03", 4)),
            ": entry 1: neither a CSV file nor a recording of collisiond");
  const std::string whole = Recording();
  Write(whole.substr(0, whole.size() - 3));
  const MotionFile cut = ReadMotionFile(path_);
  EXPECT_EQ(cut.agents.size(), 1u);
  EXPECT_EQ(cut.warning.substr(path_.size()),
            ": entry 2: cut off or damaged after it; what precedes counts");
  EXPECT_THROW(ReadMotionFile(testing::TempDir()), std::runtime_error);
}

// Goal:   of rows the bounds are those that the player declares, and called a proof.
TEST(SuggestBounds, OfRowsAreThePlayersOwn) {
  Random random(1);
  SampledAgent agent{.name = "walk", .has_velocities = false};
  std::vector<CsvRow> rows;
  for (int i = 0; i < 50; ++i) {
    MotionSample sample;
    sample.stamp_ns = i * kStepNs;
    sample.position_m = {random.Uniform(-1, 1), random.Uniform(-1, 1), 0};
    agent.samples.push_back(sample);
    rows.push_back({sample.stamp_ns, sample.position_m, {}, 0});
  }
  const Trajectory curve(rows, false, 0);
  const KnownAcceleration known(curve);
  const SuggestedBounds bounds = SuggestBounds(agent, {.is_curve = true});
  EXPECT_TRUE(bounds.is_proof);
  EXPECT_EQ(bounds.acceleration_max_m_s2, curve.AccelerationMax());
  EXPECT_NEAR(bounds.deviation_max_m_s2 / known.deviation_max_m_s2(), 1, 1e-7);
  EXPECT_EQ(bounds.jerk_max_m_s3, known.jerk_max_m_s3());
  EXPECT_FALSE(bounds.known_is_narrower);
  double fastest = 0;
  for (std::int64_t t = 0; t <= curve.end_ns(); t += 1'000'000) {
    const Vector3 v = curve.At(t).velocity_m_s;
    fastest = std::max(fastest, std::hypot(v[0], v[1], v[2]));
  }
  EXPECT_GE(bounds.speed_max_m_s, fastest);
  EXPECT_LE(bounds.speed_max_m_s, 1.5 * fastest);
}

// Goal:   of states they are what the motion needs and a tenth more; a known acceleration is
// advised
//         where the motion is smooth.
TEST(SuggestBounds, OfStatesHaveAMargin) {
  const SuggestedBounds bounds = SuggestBounds(Swinging(200), {});
  EXPECT_FALSE(bounds.is_proof);
  EXPECT_NEAR(bounds.acceleration_max_m_s2, 1.1, 1e-2);
  EXPECT_NEAR(bounds.jerk_max_m_s3, 1.1, 1e-2);
  EXPECT_NEAR(bounds.speed_max_m_s, 1.1, 1e-2);
  EXPECT_LT(bounds.deviation_max_m_s2, 1e-3);
  EXPECT_TRUE(bounds.known_is_narrower);
  EXPECT_FALSE(bounds.angular_acceleration_max_rad_s2);
}

// Goal:   a teleport with a discontinuity needs nothing, one without needs much, unless the
// quantile
//         leaves it out.
TEST(SuggestBounds, LeaveOutJumpsAndWhatTheQuantileSays) {
  SampledAgent agent = Swinging(200);
  for (std::size_t i = 100; i < agent.samples.size(); ++i) agent.samples[i].position_m[0] += 50;
  EXPECT_GT(SuggestBounds(agent, {}).acceleration_max_m_s2, 1e4);
  EXPECT_LT(SuggestBounds(agent, {.quantile = 0.98}).acceleration_max_m_s2, 1.2);
  EXPECT_LT(SuggestBounds(agent, {.quantile = 0.98}).jerk_max_m_s3, 1.2);
  EXPECT_FALSE(SuggestBounds(agent, {.quantile = 0.98, .is_curve = true}).is_proof);
  agent.samples[100].discontinuity = true;
  EXPECT_LT(SuggestBounds(agent, {}).acceleration_max_m_s2, 1.2);
}

// Goal:   of states that have no motion between them no bound is told, neither to people nor to
//         programs, and what all need is that of the others.
TEST(SuggestBounds, OfOneStateTellNothing) {
  SampledAgent bare = Swinging(2);
  bare.name = "bare";
  bare.samples[1].discontinuity = true;
  const SuggestedBounds one = SuggestBounds(Swinging(1), {}), two = SuggestBounds(bare, {}),
                        swing = SuggestBounds(Swinging(20), {});
  EXPECT_EQ(one.pieces, 0u);
  EXPECT_EQ(two.pieces, 0u);
  EXPECT_EQ(swing.pieces, 19u);
  const std::string page = BoundsPage({"run.rec", "recording"}, {two}, {});
  EXPECT_NE(page.find("sim/bare                            2          -          -          -  -  "
                      "            -          -  -\n"),
            std::string::npos)
      << page;
  EXPECT_NE(page.find("one state alone tells nothing about acceleration"), std::string::npos);
  const std::string json = BoundsJson({"run.rec", "recording"}, {one}, {});
  EXPECT_EQ(ComplaintsAbout({json.substr(0, json.size() - 1)}), "");
  EXPECT_NE(json.find("\"acceleration_max_m_s2\":null,\"known\":{\"acceleration_max_m_s2\":null,"
                      "\"jerk_max_m_s3\":null"),
            std::string::npos)
      << json;
  EXPECT_EQ(GreatestOf({one, swing}, 2).acceleration_max_m_s2, swing.acceleration_max_m_s2);
  EXPECT_EQ(GreatestOf({one, swing}, 2).pieces, 19u);
  EXPECT_EQ(BoundsPage({"a.csv", "csv"}, {swing}, {}).find("one state alone"), std::string::npos);
}

// Goal:   an agent that turns ever faster about one axis needs its angular acceleration.
TEST(SuggestBounds, FindTheAngularAcceleration) {
  SampledAgent agent = Swinging(50);
  for (int i = 0; i < 50; ++i) {
    const double t = 0.1 * i, angle = 0.5 * 0.4 * t * t;
    agent.samples[i].orientation = {std::cos(angle / 2), 0, 0, std::sin(angle / 2)};
    agent.samples[i].angular_velocity_rad_s = {0, 0, 0.4 * t};
  }
  const SuggestedBounds bounds = SuggestBounds(agent, {.margin = 0});
  ASSERT_TRUE(bounds.angular_acceleration_max_rad_s2);
  EXPECT_NEAR(*bounds.angular_acceleration_max_rad_s2, 0.4, 1e-6);
}

TEST(RoundedUpText, IsNeverLess) {
  EXPECT_EQ(RoundedUpText(0), "0");
  EXPECT_EQ(RoundedUpText(2), "2");
  EXPECT_EQ(RoundedUpText(1.23401), "1.235");
  EXPECT_EQ(RoundedUpText(99991), "1e+05");
  Random random(2);
  for (int i = 0; i < 10000; ++i) {
    const double value = std::exp(random.Uniform(-20, 20));
    const double text = std::stod(RoundedUpText(value));
    ASSERT_GE(text, value);
    ASSERT_LE(text, 1.0021 * value);
  }
}

// Goal:   both pages tell each agent, and what holds for all.
TEST(BoundsPage, TellsEachAgentAndAll) {
  SampledAgent fast = Swinging(20);
  fast.name = "the \"fast\" one";
  for (MotionSample& sample : fast.samples) sample.velocity_m_s[1] = 30;
  for (std::size_t i = 0; i < fast.samples.size(); ++i) {
    fast.samples[i].position_m[1] = 3 * static_cast<double>(i);
  }
  const std::vector<SuggestedBounds> all = {SuggestBounds(Swinging(20), {}),
                                            SuggestBounds(fast, {})};
  const std::string page = BoundsPage({"run.rec", "recording"}, all, {});
  EXPECT_EQ(page.find("run.rec (recording): bounds of 2 agents, an estimate: all that was seen, "
                      "and 10 % more\n"),
            0u);
  EXPECT_NE(page.find("\nsim/swing "), std::string::npos);
  EXPECT_NE(page.find("\nall "), std::string::npos);
  const std::string json = BoundsJson({"run.rec", "recording"}, all, {});
  EXPECT_EQ(json.back(), '\n');
  EXPECT_NE(json.find("\"name\":\"the \\\"fast\\\" one\",\"states\":20,\"basis\":\"estimate\""),
            std::string::npos);
  EXPECT_NE(json.find("\"all\":{\"simulator\":null,\"name\":null,\"states\":40"),
            std::string::npos);
  EXPECT_EQ(ComplaintsAbout({json.substr(0, json.size() - 1)}), "");
  EXPECT_GT(GreatestOf(all, 2).speed_max_m_s, 33);
}

}  // namespace
}  // namespace collision::client
