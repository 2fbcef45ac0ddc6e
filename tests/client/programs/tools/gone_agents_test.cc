// Goal:   agents that the service still holds although their simulator is not heard are shown as
//         such, with the name where it is known; those that it does not hold say why; what has been
//         removed, or belongs to an earlier service or epoch, is not shown.
// Method: clearances and statuses by hand, as a monitor that came late, or early, receives them.
#include <gtest/gtest.h>

#include <utility>

#include "client/programs/tools/collisionctl/json/world_json.h"
#include "client/programs/tools/collisionctl/pages/text_pages.h"
#include "tests/client/fake_receiver.h"

namespace collision::client {
namespace {

class GoneAgentsTest : public testing::Test {
 protected:
  void Stamp(v1::ServiceStamp* stamp) {
    stamp->set_service_id(9);
    stamp->set_term(1);
    stamp->set_epoch(epoch_);
  }

  /// `runs`: of simulator 5; none: it is not listed.
  void Status(std::optional<std::uint32_t> run, bool alive, std::uint32_t agents) {
    v1::ServiceStatus* status = next_.outputs.emplace_back().mutable_service_status();
    status->set_service_id(9);
    status->set_phase(v1::PHASE_SERVING);
    Stamp(status->mutable_stamp());
    status->set_agents(agents);
    if (!run) return;
    v1::SimulatorStatus* simulator = status->add_simulators();
    simulator->set_simulator_id(5);
    simulator->set_run(*run);
    simulator->set_name("beta");
    simulator->set_alive(alive);
  }

  /// Of the status that was handed over last, or of a new one like it.
  void Extend(const char* key, const char* value) {
    if (next_.outputs.empty())
      *next_.outputs.emplace_back().mutable_service_status() = *view_.status();
    v1::KeyValue* extension = next_.outputs.back().mutable_service_status()->add_extensions();
    extension->set_key(key);
    extension->set_value(value);
  }

  void Clear(std::uint32_t chunk, const std::vector<std::uint32_t>& slots, std::uint32_t run = 7) {
    v1::Clearance* clearance = next_.outputs.emplace_back().mutable_clearance();
    clearance->set_simulator_id(5);
    clearance->set_run(run);
    clearance->set_chunk(chunk);
    Stamp(clearance->mutable_stamp());
    for (const std::uint32_t slot : slots) {
      v1::AgentClearance* agent = clearance->add_agents();
      agent->set_slot(slot);
      agent->set_generation(1);
      agent->set_clear_until_ns(2'000'000'000);
      agent->set_not_clear(true);
    }
  }

  void Describe(std::uint32_t slot) {
    v1::AgentDescription* description = next_.inputs.emplace_back().mutable_agent_description();
    description->set_simulator_id(5);
    description->set_simulator_name("beta");
    description->set_agent_name("buoy");
    description->set_run(7);
    description->set_slot(slot);
    description->set_generation(1);
    description->set_radius_m(0.5);
  }

  std::vector<AgentView> Agents() {
    monitor_.Poll(std::chrono::nanoseconds(0));
    return view_.Agents();
  }

  std::uint32_t epoch_ = 1;
  Arrivals next_;
  WorldView view_;
  MessageMonitor monitor_{std::make_unique<FakeReceiver>(&next_), view_.Callbacks()};
};

TEST_F(GoneAgentsTest, OneThatWasNeverDescribedHereIsShownBySimulatorAndSlot) {
  Clear(0, {3});
  Clear(1, {64});
  EXPECT_TRUE(Agents().empty()) << "the service has not said whose they are";
  Status(7, false, 2);
  ASSERT_EQ(Agents().size(), 2u);
  EXPECT_TRUE(view_.knows_all_agents());
  EXPECT_EQ(AgentsPage(view_),
            "ID         NAME  SHAPE  RADIUS [m]  M [m/s²]  STATE AT  POSITION [m]  CLEAR UNTIL\n"
            "beta:3.1   -     -      -           -         -         -             2.000 s not "
            "clear, held: its simulator is not heard\n"
            "beta:64.1  -     -      -           -         -         -             2.000 s not "
            "clear, held: its simulator is not heard\n");
  EXPECT_NE(AgentsJson(view_).find("\"presence\":\"silent\""), std::string::npos);
}

TEST_F(GoneAgentsTest, OneThatWasSeenAliveKeepsItsName) {
  Describe(0);
  Clear(0, {0});
  Status(7, true, 1);
  ASSERT_EQ(Agents().size(), 1u);
  EXPECT_EQ(view_.Agents()[0].presence, AgentPresence::kHeld);
  EXPECT_EQ(AgentsPage(view_).find("held"), std::string::npos);
  EXPECT_NE(AgentsJson(view_).find("\"presence\":\"held\""), std::string::npos);
  Status(7, false, 1);
  ASSERT_EQ(Agents().size(), 1u);
  EXPECT_EQ(view_.Agents()[0].presence, AgentPresence::kSilent);
  Extend("waiting_for", "alphabeta, beta");
  ASSERT_EQ(Agents().size(), 1u);
  EXPECT_EQ(view_.Agents()[0].presence, AgentPresence::kWaitedFor);
  EXPECT_EQ(view_.Agents()[0].description.agent_name(), "buoy");
}

// Its writer may live, so that the description stands.
TEST_F(GoneAgentsTest, OneThatIsDescribedAndNotHeldSaysWhy) {
  Describe(0);
  Clear(0, {0});
  Status({}, false, 1);
  ASSERT_EQ(Agents().size(), 1u);
  EXPECT_EQ(view_.Agents()[0].presence, AgentPresence::kNotHeld);
  EXPECT_FALSE(view_.knows_all_agents()) << "it is not the one that the service has";
  for (const auto& [key, expected] : {std::pair("evicted", AgentPresence::kEvicted),
                                      {"removed_silent", AgentPresence::kRemovedSilent}}) {
    Status({}, false, 0);
    Extend(key, "be, beta, eta");
    ASSERT_EQ(Agents().size(), 1u);
    EXPECT_EQ(view_.Agents()[0].presence, expected) << key;
    Status({}, false, 0);
    Extend(key, "be, eta");
    ASSERT_EQ(Agents().size(), 1u);
    EXPECT_EQ(view_.Agents()[0].presence, AgentPresence::kNotHeld) << key;
  }
  EXPECT_NE(AgentsPage(view_).find(" -, not held by the service\n"), std::string::npos);
  Status(8, true, 1);
  ASSERT_EQ(Agents().size(), 1u);
  EXPECT_EQ(view_.Agents()[0].presence, AgentPresence::kNotHeld) << "of an older run";
  Status(6, true, 1);
  ASSERT_EQ(Agents().size(), 1u);
  EXPECT_EQ(view_.Agents()[0].presence, AgentPresence::kHeld) << "a newer run is on its way";
  // The status does not name all simulators: it may be held.
  Status({}, false, 1);
  v1::Counter* unlisted = next_.outputs.back().mutable_service_status()->add_counters();
  unlisted->set_name("simulators_unlisted");
  unlisted->set_value(1);
  ASSERT_EQ(Agents().size(), 1u);
  EXPECT_EQ(view_.Agents()[0].presence, AgentPresence::kHeld);
}

// A simulator that was never granted time has no clearances.
TEST_F(GoneAgentsTest, HeldAgentsOfWhichNothingHasComeAreCounted) {
  Status(7, true, 3);
  next_.outputs.back().mutable_service_status()->mutable_simulators(0)->set_agents(3);
  Describe(0);
  Agents();
  EXPECT_TRUE(view_.Unknown().empty()) << "the living will tell";
  Status(7, false, 3);
  next_.outputs.back().mutable_service_status()->mutable_simulators(0)->set_agents(3);
  Agents();
  EXPECT_NE(AgentsPage(view_).find("\nand 2 held of beta, which is not heard"), std::string::npos);
  EXPECT_NE(AgentsJson(view_).find("],\"unknown\":[{\"simulator\":\"beta\",\"agents\":2}]}"),
            std::string::npos)
      << AgentsJson(view_);
  for (const std::uint32_t slot : {1, 2}) Describe(slot);
  Agents();
  EXPECT_TRUE(view_.Unknown().empty());
}

TEST_F(GoneAgentsTest, WhatTheServiceHoldsNoMoreIsNotShown) {
  Clear(0, {3, 4});
  Status(7, false, 2);
  EXPECT_EQ(Agents().size(), 2u);
  Clear(0, {4});
  EXPECT_EQ(Agents().size(), 1u) << "one was removed";
  Clear(1, {64});
  EXPECT_EQ(Agents().size(), 2u) << "another chunk says nothing of the first";
  Status({}, false, 0);
  EXPECT_TRUE(Agents().empty()) << "the simulator has left";
}

TEST_F(GoneAgentsTest, SamplesOfAnotherRunEpochOrServiceTellNothing) {
  Clear(0, {3}, 6);
  Status(7, false, 0);
  EXPECT_TRUE(Agents().empty());
  Clear(0, {3});
  EXPECT_EQ(Agents().size(), 1u);
  epoch_ = 2;
  Status(7, false, 0);
  EXPECT_TRUE(Agents().empty());
  Clear(0xffffffff, {3});
  EXPECT_TRUE(Agents().empty()) << "no service has such a chunk";
}

TEST_F(GoneAgentsTest, TheLivingThatAreNotDescribedYetAreNotGone) {
  Clear(0, {3});
  Status(7, true, 1);
  EXPECT_TRUE(Agents().empty());
}

}  // namespace
}  // namespace collision::client
