// Goal:   the pages show what has arrived, in any order, and nothing of agents that left.
// Method: a monitor on a network under the test's control feeds the view; pages and JSON are
//         compared.
#include <gtest/gtest.h>

#include "client/programs/tools/collisionctl/json/event_json.h"
#include "client/programs/tools/collisionctl/json/world_json.h"
#include "client/programs/tools/collisionctl/pages/text_pages.h"
#include "client/programs/tools/collisionctl/status/status_page.h"
#include "collision/types.h"
#include "tests/client/fake_transport.h"
#include "tests/client/programs/tools/collisionctl_fixture.h"

namespace collision::client {
namespace {

TEST_F(CollisionctlTest, AgentsPageIsTheSameInAnyOrderOfArrival) {
  Clear(7);
  Place(7, 1);
  Describe("ball", 7, 0);
  Poll(3);
  EXPECT_EQ(AgentsPage(view_),
            "ID       NAME  SHAPE  RADIUS [m]  M [m/s²]  STATE AT  POSITION [m]       CLEAR UNTIL\n"
            "sim:0.1  ball  ball   0.5         7.9       2.000 s   1.500 0.000 0.000  never\n");
}

TEST_F(CollisionctlTest, AgentsPageTellsWhatAgentsBroke) {
  Describe("ball", 7, 0);
  Describe("honest", 7, 1);
  Break(7, 0);
  Break(6, 1);  // of a former run
  Poll(4);
  const std::string broke =
      "ball (sim) broke acceleration_max_m_s2: declared 2, at least 3.5 seen "
      "between 1.200 s and 1.300 s (4 times)\n";
  const std::string page = AgentsPage(view_);
  ASSERT_GT(page.size(), broke.size());
  EXPECT_EQ(page.substr(page.size() - broke.size()), broke);
  EXPECT_EQ(page.find("honest (sim) broke"), std::string::npos);
  EXPECT_NE(AgentsJson(view_).find("\"breach\":{\"count\":4,\"field\":\"acceleration_max_m_s2\","
                                   "\"declared\":2,\"seen\":3.5,\"from_ns\":\"1200000000\""),
            std::string::npos)
      << AgentsJson(view_);
  EXPECT_NE(AgentsJson(view_).find("\"breach\":null"), std::string::npos);
  v1::AgentRemoval* removal = next_.inputs.emplace_back().mutable_agent_removal();
  removal->set_simulator_id(5);
  Poll(1);
  EXPECT_EQ(AgentsPage(view_).find("broke"), std::string::npos);
}

TEST_F(CollisionctlTest, AgentsPageListsOnlySoManyBreaches) {
  for (std::uint32_t slot = 0; slot < 25; ++slot) {
    Describe("ball", 7, slot);
    Break(7, slot);
  }
  Poll(50);
  EXPECT_NE(AgentsPage(view_).find("(4 times)\nand 5 more\n"), std::string::npos);
}

TEST_F(CollisionctlTest, ShapesPageShowsTheArrivedPartsOfEach) {
  const std::string hash = "\x01\xab\xcd\xef" + std::string(28, '\7');
  for (const std::uint32_t slot : {0, 1}) Describe("ship", 7, slot)->set_shape_hash(hash);
  Describe("ball", 7, 2);
  const auto part = [&](std::uint32_t number, std::uint32_t run) {
    v1::ShapePart* message = next_.inputs.emplace_back().mutable_shape_part();
    message->set_simulator_id(5);
    message->set_shape(9);
    message->set_content_hash(hash);
    message->set_run(run);
    message->set_part(number);
    message->set_parts(3);
    message->set_total_bytes(100'000);
    message->set_bytes(
        number > 0 ? "" : std::string("CSHAPE\0\2\x10\0\0\0\x39\x30\0\0\3\0\0\0\0\0\0\0", 24));
  };
  part(2, 7);
  part(2, 7);
  Poll(5);
  EXPECT_NE(AgentsPage(view_).find("ship  01abcdef  0.5"), std::string::npos) << AgentsPage(view_);
  constexpr const char* kHeading =
      "SHAPE     SIMULATOR  AGENTS  TRIANGLES  SOLIDS  BYTES   PARTS\n";
  EXPECT_EQ(ShapesPage(view_), kHeading + std::string("01abcdef  sim        2       -       "
                                                      "   -       100000  1 of 3\n"));
  part(0, 7);
  Poll(1);
  EXPECT_EQ(ShapesPage(view_), kHeading + std::string("01abcdef  sim        2       12345   "
                                                      "   3       100000  2 of 3\n"));
  std::string digits = "01abcdef";
  for (int i = 0; i < 28; ++i) digits += "07";
  EXPECT_EQ(ShapesJson(view_),
            "{\"schema\":\"collision/1\",\"kind\":\"shapes\",\"shapes\":[{\"hash\":\"" + digits +
                "\",\"simulator\":\"sim\",\"agents\":2,\"triangles\":12345,"
                "\"solids\":3,\"bytes\":100000,\"parts\":3,\"parts_seen\":2}]}");
  v1::ShapeRemoval* removal = next_.inputs.emplace_back().mutable_shape_removal();
  removal->set_simulator_id(5);
  removal->set_shape(9);
  Poll(1);
  EXPECT_TRUE(view_.Shapes().empty());
  part(0, 7);
  const std::string no_solids("CSHAPE\0\1\x10\0\0\0\x39\x30\0\0", 16);
  next_.inputs.back().mutable_shape_part()->set_bytes(no_solids);
  Poll(1);
  EXPECT_EQ(view_.Shapes().front().triangles, 12345u);
  EXPECT_EQ(view_.Shapes().front().solids, 0u);
}

// A simulator that restarts leaves its shapes behind, unless it publishes them again.
TEST_F(CollisionctlTest, ShapesOfAFormerRunAreNotShown) {
  for (const auto& [hash, run] : {std::pair("old", 6), {"published again", 7}}) {
    v1::ShapePart* message = next_.inputs.emplace_back().mutable_shape_part();
    message->set_simulator_id(5);
    message->set_content_hash(hash);
    message->set_run(run);
  }
  Describe("ball", 7, 0);
  Poll(3);
  ASSERT_EQ(view_.Shapes().size(), 1u);
  EXPECT_EQ(view_.Shapes()[0].hash, "published again");
}

TEST_F(CollisionctlTest, DataOfAFormerAgentOrRunIsNotShown) {
  Describe("former", 6, 0);
  Describe("former-too", 6, 1);
  Place(6, 1);
  Clear(6);
  Poll(4);
  EXPECT_EQ(view_.Agents().size(), 2u);
  Describe("ball", 7, 0);
  Poll(1);
  ASSERT_EQ(view_.Agents().size(), 1u);
  EXPECT_EQ(view_.Agents()[0].description.agent_name(), "ball");
  EXPECT_FALSE(view_.Agents()[0].state);
  EXPECT_FALSE(view_.Agents()[0].clearance);
  Place(7, 2);
  Poll(1);
  EXPECT_FALSE(view_.Agents()[0].state);
}

TEST_F(CollisionctlTest, WhatTheServiceRefusesFillsNothing) {
  Describe("last", 1, 65535);
  Describe("beyond", 1, 65536);
  Poll(2);
  const std::vector<AgentView> agents = view_.Agents();
  ASSERT_EQ(agents.size(), 1u);
  EXPECT_EQ(agents[0].description.agent_name(), "last");
}

TEST_F(CollisionctlTest, RemovedAgentsGoAndTheirNamesStay) {
  Describe("ball", 7, 0);
  next_.inputs.emplace_back().mutable_agent_removal()->set_simulator_id(5);
  Poll(2);
  EXPECT_TRUE(view_.Agents().empty());
  AgentId id{.simulator = 5, .run = 7, .generation = 1};
  EXPECT_EQ(view_.Name(id), "ball");
  EXPECT_TRUE(view_.IsNamed(id));
  id.generation = 2;
  EXPECT_FALSE(view_.IsNamed(id));
  EXPECT_EQ(view_.Name(id), "sim:0");
}

// Of an agent that was never described, the simulator at least keeps its name.
TEST_F(CollisionctlTest, ASimulatorThatHasLeftKeepsItsName) {
  v1::SimulatorStatus* simulator = Status()->add_simulators();
  simulator->set_simulator_id(6);
  simulator->set_name("six");
  v1::SimulatorReport* report = next_.outputs.emplace_back().mutable_simulator_report();
  report->set_simulator_id(7);
  report->set_name("seven");
  Poll(2);
  Describe("ball", 7, 0);
  Status();
  Poll(2);
  EXPECT_EQ(view_.Name({.simulator = 5, .run = 7, .slot = 4, .generation = 1}), "sim:4");
  EXPECT_EQ(view_.Name({.simulator = 6, .run = 1, .slot = 4, .generation = 1}), "six:4");
  EXPECT_EQ(view_.Name({.simulator = 7, .run = 1, .slot = 4, .generation = 1}), "seven:4");
  EXPECT_EQ(view_.Name({.simulator = 8, .slot = 4}), "0000000000000008:4");
}

// A restart, or a program that pretends to be one, does not take the names from earlier events.
TEST_F(CollisionctlTest, NamesStayWhenAnotherRunComes) {
  Describe("ball", 7, 0);
  Describe("impostor", 8, 0);
  Describe("renamed", 7, 0);
  Poll(3);
  AgentId id{.simulator = 5, .run = 7, .generation = 1};
  EXPECT_EQ(view_.Name(id), "ball");
}

TEST_F(CollisionctlTest, AWallClockReadsAsTheTimeOfDay) {
  Status()->set_now_ns(1'795'229'895'022'000'000);
  Poll(1);
  EXPECT_NE(StatusPage(view_).find(", now 02:58:15.022 UTC\n"), std::string::npos);
}

TEST_F(CollisionctlTest, EarliestPageNamesPairAndTime) {
  EXPECT_EQ(EarliestPage(view_), "not published yet\n");
  next_.outputs.emplace_back().mutable_earliest_intersection()->set_now_ns(1'000'000'000);
  Poll(1);
  EXPECT_EQ(EarliestPage(view_),
            "never: no two agents can touch that are not in contact already\nas of 1.000 s\n");
}

// DDS delivers samples by key: the view restores the order of publication.
TEST_F(CollisionctlTest, EventsAreInTheOrderOfPublication) {
  for (const std::uint32_t sequence : {3, 1, 2}) {
    *next_.outputs.emplace_back().mutable_collision_event() = OwnEvent(sequence, 1, sequence);
  }
  Poll(3);
  const auto events = view_.TakeEvents();
  ASSERT_EQ(events.size(), 3u);
  EXPECT_EQ(events[0].stamp().sequence(), 1u);
  EXPECT_EQ(events[2].stamp().sequence(), 3u);
  EXPECT_TRUE(view_.TakeEvents().empty());
}

TEST_F(CollisionctlTest, OfEachEventTheNewestRevisionStands) {
  for (const std::uint32_t revision : {1, 2, 4}) {
    *next_.outputs.emplace_back().mutable_collision_event() = OwnEvent(1, revision, revision);
  }
  *next_.outputs.emplace_back().mutable_collision_event() = OwnEvent(2, 1, 5);
  Poll(4);
  const auto events = view_.TakeNewestRevisions();
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[0].contact(), 1u);
  EXPECT_EQ(events[0].revision(), 4u);
  EXPECT_EQ(events[1].contact(), 2u);
}

TEST_F(CollisionctlTest, LostContactsAreToldInLinesOfTheirOwn) {
  v1::CollisionEvent contact = OwnEvent(1, 1, 1);
  contact.set_contacts_sequence(1);
  *next_.outputs.emplace_back().mutable_collision_event() = contact;
  *next_.outputs.emplace_back().mutable_collision_event() = OwnEvent(2, 1, 2);
  Poll(2);
  EXPECT_EQ(view_.contacts(), 1u);
  EXPECT_NE(GapJson(2, 5).find("\"contacts_missed\":2,\"contacts_missed_so_far\":5}"),
            std::string::npos);
  EXPECT_EQ(MissedLine(2, 5).rfind("contacts missed: 2 (5 so far)", 0), 0u);
  EXPECT_EQ(ContactsSummary(7, 5), "contacts told: 7, missed: 5");
}

TEST_F(CollisionctlTest, JsonOfAnAgentSaysWhatIsNotKnown) {
  Describe("ball", 7, 0);
  Clear(7);
  Poll(2);
  const std::string json = AgentsJson(view_);
  for (const char* part :
       {"\"agents\":[{\"name\":\"ball\",\"simulator\":\"sim\",\"simulator_id\":"
        "\"0000000000000005\",\"run\":7,",
        "\"acceleration_max_m_s2\":7.9,", "\"speed_max_m_s\":null,", "\"state\":null,",
        "\"clearance\":{\"promised\":true,\"clear_until_ns\":null,\"clear_until_s\":null,"}) {
    EXPECT_NE(json.find(part), std::string::npos) << part << json;
  }
}

// An agent of which only its id has come has no name, and says so.
TEST_F(CollisionctlTest, JsonOfAnAgentThatIsNotKnownHasNoName) {
  v1::EarliestIntersection* earliest = next_.outputs.emplace_back().mutable_earliest_intersection();
  earliest->set_found(true);
  earliest->set_earliest_ns(kNever);
  earliest->mutable_lower()->set_simulator_id(5);
  earliest->mutable_lower()->set_run(7);
  earliest->mutable_lower()->set_generation(1);
  Describe("ball", 7, 0)->set_assembly("arm");
  Poll(2);
  const std::string json = EarliestJson(view_);
  EXPECT_NE(json.find("\"lower\":{\"name\":\"ball\",\"simulator\":\"sim\","), std::string::npos)
      << json;
  EXPECT_NE(json.find("\"assembly\":\"arm\","), std::string::npos) << json;
  EXPECT_NE(json.find("\"higher\":{\"name\":null,\"simulator\":null,"), std::string::npos) << json;
}

}  // namespace
}  // namespace collision::client
