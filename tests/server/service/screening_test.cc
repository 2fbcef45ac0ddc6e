// Goal:   what a hypothetical agent would meet is told to its owner, in time and with the true
//         times, and to nobody else; for all others the service says bit for bit what it says
//         without that agent, and their time waits for nothing of it.
// Method: "alpha" has real agents, "beta" real and hypothetical ones, twenty states a second, at a
//         daemon whose outputs are compared.
#include <gtest/gtest.h>

#include "server/recording/recording.h"
#include "tests/server/service/level_flight.h"

namespace collision::server {
namespace {

constexpr std::uint64_t kAlpha = 1, kBeta = 2;
constexpr double kStep = 0.05;
constexpr std::int64_t kStepNs = 50'000'000;

/// An agent of one of the two in straight motion along x.
struct Flight {
  std::string simulator;
  std::uint32_t slot = 0;
  double x = 0, speed = 0, y = 0;
  bool hypothetical = false;
  std::string shape_hash = {};
};

/// Keeps batches in memory.
class Batches final : public BatchSink {
 public:
  bool Record(const v1::RecordedBatch& batch) override {
    all.push_back(batch);
    return true;
  }
  std::string error() const override { return ""; }
  std::vector<v1::RecordedBatch> all;
};

/// A world of the two.
class Skies {
 public:
  explicit Skies(v1::Config config = TwentyAStep(), BatchSink* sink = nullptr)
      : daemon_(OfBoth(std::move(config)), sink) {}

  void Add(const Flight& flight) {
    v1::AgentDescription description = Description(flight.simulator, flight.slot);
    description.set_hypothetical(flight.hypothetical);
    description.set_shape_hash(flight.shape_hash);
    Describe(description);
    flights_.push_back(flight);
  }

  /// With the next sequence of its simulator.
  void Describe(v1::AgentDescription description) {
    Simulator& simulator = simulators_[description.simulator_name()];
    description.set_sequence(++simulator.descriptions);
    inputs_.push_back(From(SenderOf(description.simulator_name()), description));
  }

  void Remove(const std::string& simulator, std::uint32_t slot) {
    v1::Input removal = Removal(SenderOf(simulator), simulator, slot);
    removal.mutable_agent_removal()->set_sequence(++simulators_[simulator].descriptions);
    inputs_.push_back(removal);
    std::erase_if(flights_, [&](const Flight& flight) {
      return flight.simulator == simulator && flight.slot == slot;
    });
  }

  void RunTo(double seconds) {
    for (; now() <= seconds + 1e-9; ++step_) {
      for (const std::string name : {"alpha", "beta"}) Tell(name);
      daemon_.Step(std::exchange(inputs_, {}), kStep);
    }
  }

  ScriptedDaemon& daemon() { return daemon_; }

  std::vector<v1::ScreeningEvent> Screened() {
    std::vector<v1::ScreeningEvent> screened;
    for (const v1::Output& output : daemon_.bus().outputs) {
      if (output.has_screening_event()) screened.push_back(output.screening_event());
    }
    return screened;
  }

  std::vector<v1::CollisionEvent> Screened(v1::EventStatus status) {
    std::vector<v1::CollisionEvent> found;
    for (const v1::ScreeningEvent& one : Screened()) {
      if (one.event().status() == status) found.push_back(one.event());
    }
    return found;
  }

 private:
  double now() const { return kStep * static_cast<double>(step_); }

  struct Simulator {
    std::uint64_t states = 0, descriptions = 0;
  };

  static v1::Config OfBoth(v1::Config config) {
    config.mutable_clock()->set_simulators_awaited(2);
    return config;
  }
  static std::uint64_t SenderOf(const std::string& name) {
    return name == "alpha" ? kAlpha : kBeta;
  }

  void Tell(const std::string& name) {
    const std::int64_t stamp_ns = step_ * kStepNs;
    Simulator& simulator = simulators_[name];
    v1::AgentStates chunk = Chunk(name);
    for (const Flight& flight : flights_) {
      if (flight.simulator != name) continue;
      v1::AgentState& state = *chunk.add_states() =
          State(flight.slot, stamp_ns, ++simulator.states);
      state.mutable_position_m()->set_x(flight.x + flight.speed * now());
      state.mutable_position_m()->set_y(flight.y);
      state.mutable_velocity_m_s()->set_x(flight.speed);
    }
    inputs_.push_back(From(SenderOf(name), chunk));
    inputs_.push_back(
        From(SenderOf(name), ClockAfter(name, stamp_ns, simulator.states, simulator.descriptions)));
  }

  ScriptedDaemon daemon_;
  std::map<std::string, Simulator> simulators_;
  std::vector<Flight> flights_;
  std::vector<v1::Input> inputs_;
  std::int64_t step_ = 0;
};

/// Of alpha two that meet at 5 s, of beta one that passes by.
void AddRealOnes(Skies* skies) {
  skies->Add({.simulator = "alpha", .slot = 0});
  skies->Add({.simulator = "alpha", .slot = 1, .x = 22, .speed = -4});
  skies->Add({.simulator = "beta", .slot = 0, .x = -30, .speed = 3, .y = 6});
}

// Goal:   never late: the forecast is there before the contact begins, and does not begin later;
//         the brackets of contact and end are those of the true motion.
TEST(Screening, TellsTheOwnerInTime) {
  Skies skies;
  skies.Add({.simulator = "alpha", .slot = 0});
  skies.Add({.simulator = "beta", .slot = 1, .x = 22, .speed = -4, .hypothetical = true});
  skies.RunTo(8);
  EXPECT_TRUE(skies.daemon().rejections().empty());
  const auto screened = skies.Screened();
  ASSERT_GE(screened.size(), 3u);
  const v1::CollisionEvent& first = screened[0].event();
  EXPECT_EQ(first.status(), v1::EVENT_POSSIBLE);
  EXPECT_LT(first.now_ns(), 4'000'000'000);
  EXPECT_LE(first.begin().earliest_ns(), 5'000'000'000);
  EXPECT_EQ(first.lower_label().agent_name(),
            first.lower().simulator_id() == SimulatorId("alpha") ? "agent 0" : "agent 1");
  ASSERT_FALSE(skies.Screened(v1::EVENT_CONFIRMED).empty());
  ASSERT_EQ(skies.Screened(v1::EVENT_ENDED).size(), 1u);
  EXPECT_TRUE(Brackets(skies.Screened(v1::EVENT_CONFIRMED).back().begin(), 5, 2e-3));
  EXPECT_TRUE(Brackets(skies.Screened(v1::EVENT_ENDED)[0].end(), 6, 2e-3));
  for (const v1::ScreeningEvent& one : screened) {
    EXPECT_EQ(one.simulator_id(), SimulatorId("beta"));
    EXPECT_EQ(one.run(), 1u);
    EXPECT_EQ(one.event().contacts_sequence(), 0u);
  }
  for (const v1::Output& output : skies.daemon().bus().outputs) {
    EXPECT_FALSE(output.has_collision_event()) << output.ShortDebugString();
  }
}

// Goal:   a simulator that is granted time knows which screening events came before: its clearances
//         name the newest one, those of others none.
TEST(Screening, IsNamedByTheClearancesOfItsOwner) {
  Skies skies;
  skies.Add({.simulator = "alpha", .slot = 0});
  skies.Add({.simulator = "beta", .slot = 1, .x = 22, .speed = -4, .hypothetical = true});
  skies.RunTo(8);
  const std::uint64_t newest = skies.Screened().back().event().stamp().sequence();
  EXPECT_EQ(skies.daemon().clearance(SimulatorId("beta")).screening_sequence(), newest);
  EXPECT_EQ(skies.daemon().clearance(SimulatorId("alpha")).screening_sequence(), 0u);
}

/// What a run says to all but beta, and of beta what its time is: without the numbers of samples,
/// which count those for beta, too.
std::vector<std::string> ToldToOthers(const std::vector<v1::Output>& outputs) {
  std::vector<std::string> told;
  std::int64_t granted_to_beta = 0;
  for (v1::Output output : outputs) {
    if (output.has_service_status() || output.has_service_hello()) continue;
    if (output.has_screening_event()) continue;
    if (output.has_rejection() && output.rejection().simulator_id() == SimulatorId("beta"))
      continue;
    if (output.has_simulator_report() &&
        output.simulator_report().simulator_id() == SimulatorId("beta")) {
      continue;
    }
    if (output.has_clearance()) {
      v1::Clearance& clearance = *output.mutable_clearance();
      if (clearance.simulator_id() == SimulatorId("beta")) {
        const std::int64_t before = std::exchange(granted_to_beta, clearance.granted_until_ns());
        if (granted_to_beta != before) told.push_back("beta " + std::to_string(granted_to_beta));
        continue;
      }
      clearance.clear_stamp();
      clearance.set_forecasts_sequence(clearance.forecasts_sequence() > 0);
    }
    if (output.has_collision_event()) output.mutable_collision_event()->clear_stamp();
    if (output.has_earliest_intersection()) output.mutable_earliest_intersection()->clear_stamp();
    if (output.has_simulator_report()) output.mutable_simulator_report()->clear_stamp();
    if (output.has_rejection()) output.mutable_rejection()->clear_stamp();
    told.push_back(output.ShortDebugString());
  }
  return told;
}

// Goal:   a hypothetical agent in the way of everything, and one whose shape never comes, change
//         nothing that others are told, no grant, and no hash.
TEST(Screening, ChangesNothingForOthers) {
  v1::Config config = TwentyAStep();
  AddLevel("near", 3, &config);
  Skies without(config), with(config);
  for (Skies* skies : {&without, &with}) AddRealOnes(skies);
  with.Add({.simulator = "beta", .slot = 7, .x = 1, .speed = 0, .hypothetical = true});
  with.Add({.simulator = "beta", .slot = 8, .x = 22, .speed = -4, .y = 2, .hypothetical = true});
  with.Add({.simulator = "beta",
            .slot = 9,
            .x = 3,
            .hypothetical = true,
            .shape_hash = std::string(32, 'x')});
  for (Skies* skies : {&without, &with}) skies->RunTo(9);
  ASSERT_FALSE(with.Screened(v1::EVENT_CONFIRMED).empty());
  EXPECT_TRUE(without.Screened().empty());
  const auto expected = ToldToOthers(without.daemon().bus().outputs);
  const auto told = ToldToOthers(with.daemon().bus().outputs);
  ASSERT_GT(expected.size(), 100u);
  ASSERT_EQ(told.size(), expected.size());
  for (std::size_t k = 0; k < told.size(); ++k) ASSERT_EQ(told[k], expected[k]) << k;
  EXPECT_EQ(with.daemon().daemon().event_log().hash(),
            without.daemon().daemon().event_log().hash());
  EXPECT_GT(with.daemon().daemon().event_log().count(), 5u);
  const v1::ServiceStatus a = without.daemon().status(), b = with.daemon().status();
  EXPECT_EQ(a.pairs_tracked(), b.pairs_tracked());
  EXPECT_EQ(a.granted_until_ns(), b.granted_until_ns());
  EXPECT_EQ(a.agents() + 3, b.agents());
}

TEST(Screening, TellsItsOwnerHowLongAHypotheticalAgentIsClear) {
  Skies skies;
  skies.Add({.simulator = "alpha", .slot = 0});
  skies.Add({.simulator = "beta", .slot = 1, .x = 10, .hypothetical = true});
  skies.RunTo(1);
  const v1::Clearance of_beta = skies.daemon().clearance(SimulatorId("beta"));
  ASSERT_EQ(of_beta.agents_size(), 1);
  EXPECT_LE(of_beta.agents(0).clear_until_ns(), 3'000'000'001) << "2 t² = 8";
  EXPECT_GT(of_beta.agents(0).clear_until_ns(), 2'000'000'000);
  EXPECT_EQ(skies.daemon().clearance(SimulatorId("alpha")).agents(0).clear_until_ns(), kNeverNs);
}

TEST(Screening, EndsWithItsLastAgent) {
  Skies skies;
  AddRealOnes(&skies);
  skies.Add({.simulator = "beta", .slot = 7, .x = 1, .hypothetical = true});
  skies.RunTo(1);
  EXPECT_EQ(skies.daemon().counter("hypothetical_agents"), 1u);
  EXPECT_FALSE(skies.Screened(v1::EVENT_CONFIRMED).empty());
  skies.Remove("beta", 7);
  skies.RunTo(2);
  EXPECT_EQ(skies.Screened(v1::EVENT_ENDED).size(), 1u);
  EXPECT_THROW(skies.daemon().counter("hypothetical_agents"), std::logic_error);
}

// Goal:   a program hears nothing of what the run before its own had planned.
TEST(Screening, TellsNothingOfARunThatIsOver) {
  for (const bool next_run : {false, true}) {
    Skies skies;
    skies.Add({.simulator = "alpha", .slot = 0});
    skies.Add({.simulator = "beta", .slot = 1, .x = 4, .hypothetical = true});
    skies.RunTo(1);
    const std::size_t told = skies.Screened().size();
    ASSERT_GT(told, 0u);
    if (next_run) {
      skies.daemon().Step({Liveliness(kBeta, "beta", false)});
      skies.daemon().Step({From(12, Description("beta", 0, 2))});
      EXPECT_EQ(skies.daemon().status().agents(), 1u);
    } else {
      skies.Remove("beta", 1);
      skies.RunTo(1.5);
    }
    EXPECT_EQ(skies.Screened().size() - told, next_run ? 0 : 1);
  }
}

// Goal:   whether an agent is hypothetical never changes: a description that says otherwise is
//         refused with its field, and the one before stays in force.
TEST(Screening, RefusesToMakeAHypotheticalAgentReal) {
  Skies skies;
  AddRealOnes(&skies);
  skies.Add({.simulator = "beta", .slot = 7, .x = 1, .hypothetical = true});
  skies.RunTo(1);
  for (const std::uint32_t slot : {0u, 7u}) {
    v1::AgentDescription other = Description("beta", slot);
    other.set_revision(2);
    other.set_hypothetical(slot == 0);
    skies.Describe(other);
  }
  skies.RunTo(2);
  const auto rejections = skies.daemon().rejections();
  ASSERT_EQ(rejections.size(), 2u);
  EXPECT_EQ(rejections[0].reason(), v1::REJECTED_OUT_OF_RANGE);
  EXPECT_EQ(rejections[0].field(), "hypothetical");
  EXPECT_EQ(rejections[0].detail(),
            "true; allowed: false, as this agent was described first, or an agent of another "
            "generation");
  EXPECT_EQ(skies.daemon().counter("hypothetical_agents"), 1u);
  EXPECT_EQ(skies.daemon().status().agents(), 4u);
}

TEST(Screening, CountsForTheLimitOfAgents) {
  v1::Config config = TwentyAStep();
  config.set_agents_max(2);
  Skies skies(config);
  skies.Add({.simulator = "alpha", .slot = 0});
  skies.Add({.simulator = "beta", .slot = 1, .x = 10, .hypothetical = true});
  skies.RunTo(0.5);
  skies.Add({.simulator = "alpha", .slot = 1, .x = 50});
  skies.RunTo(1);
  ASSERT_EQ(skies.daemon().rejections().size(), 1u);
  EXPECT_EQ(skies.daemon().rejections()[0].reason(), v1::REJECTED_TOO_MANY_AGENTS);
}

// Goal:   time does not wait for a simulator that is gone and has left only hypothetical agents.
TEST(Screening, LeavesNoTimeToItsAgentsWhenTheOwnerIsGone) {
  Skies skies;
  skies.Add({.simulator = "alpha", .slot = 0});
  skies.Add({.simulator = "beta", .slot = 1, .x = 10, .hypothetical = true});
  skies.RunTo(1);
  skies.daemon().Step({Liveliness(kBeta, "beta", false)});
  skies.daemon().Step({From(kAlpha, ClockAfter("alpha", 1'050'000'000, 21, 1))});
  EXPECT_EQ(skies.daemon().status().now_ns(), 1'050'000'000);
}

// Goal:   time waits for a shape as long as a real agent refers to it.
TEST(Screening, WaitsForNoShapeOfAHypotheticalAgent) {
  Skies skies;
  const std::string hash(32, 'x');
  const auto awaited = [&] { return Extension(skies.daemon().status(), "waiting_for"); };
  skies.Add({.simulator = "alpha", .slot = 0});
  skies.Add({.simulator = "beta", .slot = 1, .x = 9, .hypothetical = true, .shape_hash = hash});
  skies.RunTo(0.5);
  EXPECT_EQ(awaited(), "");
  skies.Add({.simulator = "beta", .slot = 2, .x = 99, .shape_hash = hash});
  skies.RunTo(1);
  EXPECT_NE(awaited().find("shape 78787878"), std::string::npos);
  skies.Remove("beta", 2);
  skies.RunTo(1.5);
  EXPECT_EQ(awaited(), "");
}

// Goal:   the recorded batches determine what is told of hypothetical agents.
TEST(Screening, IsReplayedBitForBit) {
  Batches batches;
  v1::Config config = TwentyAStep();
  config.mutable_clock()->set_simulators_awaited(2);
  Skies skies(config, &batches);
  AddRealOnes(&skies);
  skies.Add({.simulator = "beta", .slot = 7, .x = 1, .speed = 1, .hypothetical = true});
  skies.RunTo(6);
  ScriptedDaemon replayed(config);
  for (const v1::RecordedBatch& batch : batches.all) {
    v1::RecordedBatch read;
    ASSERT_TRUE(read.ParseFromString(batch.SerializeAsString()));
    replayed.bus().monotonic_ns = read.monotonic_ns();
    replayed.bus().wall_ns = read.wall_ns();
    replayed.Step({read.inputs().begin(), read.inputs().end()});
  }
  const std::string hash = Extension(skies.daemon().status(), "screening_log_hash");
  EXPECT_FALSE(hash.empty());
  EXPECT_EQ(Extension(replayed.status(), "screening_log_hash"), hash);
}

}  // namespace
}  // namespace collision::server
