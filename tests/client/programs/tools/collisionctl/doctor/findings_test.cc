// Goal:   from what is seen of a network follows what is wrong, the cause before its consequences,
//         and of what is well nothing is said.
// Method: what was seen is made by hand; tests/system/doctor_test.cc causes each trouble for real.
#include "client/programs/tools/collisionctl/doctor/findings.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/client/programs/tools/collisionctl/json/schema_check.h"
#include "tests/client/programs/tools/collisionctl_fixture.h"

namespace collision::client {
namespace {

class FindingsTest : public CollisionctlTest {
 protected:
  FindingsTest() {
    seen_.world = "lab";
    seen_.interfaces = {
        {.name = "lo",
         .address = AddressOf("127.0.0.1"),
         .mask = AddressOf("255.0.0.0"),
         .is_loopback = true},
        {.name = "eth0", .address = AddressOf("10.0.0.7"), .mask = AddressOf("255.255.255.0")}};
    seen_.neighbours.programs[1] = {
        .process = "collisionctl", .pid = "7", .host = "here", .is_own = true};
    seen_.own_address = "10.0.0.7";
    seen_.has_credentials = true;
  }

  ~FindingsTest() override { EXPECT_EQ(ComplaintsAbout(documents_), "") << "of the schema"; }

  void AddService(std::uint64_t program, const std::string& addresses,
                  const std::string& world = "lab") {
    seen_.neighbours.programs[program] = {
        .process = "collisiond", .pid = "9", .host = "there", .addresses = addresses};
    seen_.neighbours.peers.push_back({.program = program,
                                      .writes = true,
                                      .topic = "collision/v1/service_status",
                                      .partitions = {world}});
  }

  std::vector<std::string> Matters() {
    monitor_.Poll(std::chrono::nanoseconds(0));
    std::vector<std::string> matters;
    const std::vector<Finding> findings = Findings(seen_, view_);
    for (const Finding& finding : findings) matters.push_back(finding.matter);
    documents_.push_back(DoctorJson(findings));
    return matters;
  }

  std::string Page() { return DoctorPage(seen_, view_, Findings(seen_, view_)); }

  using Words = std::vector<std::string>;
  DoctorSeen seen_;

 private:
  std::vector<std::string> documents_;
};

TEST_F(FindingsTest, OfAServiceThatIsHeardNothingIsFound) {
  AddService(2, "10.0.0.9:7410");
  Status();
  EXPECT_EQ(Matters(), Words{});
  EXPECT_TRUE(Page().starts_with("WELL: ")) << Page();
  EXPECT_NE(Page().find("; 1 programs on the network"), std::string::npos) << "but this one";
}

TEST_F(FindingsTest, WhereNobodyServesTheNearestOtherIsNamed) {
  EXPECT_EQ(Matters(), Words{"nobody"});
  seen_.neighbours.programs[3] = {.process = "drone-swarm", .pid = "8", .host = "there"};
  EXPECT_EQ(Matters(), Words{"no-service"});
  seen_.elsewhere = {7};
  EXPECT_EQ(Matters(), Words{"other-domain"});
  AddService(2, "10.0.0.9", "lab2");
  EXPECT_EQ(Matters(), Words{"other-world"});
  seen_.host = "10.0.0.9";
  seen_.host_answers = true;
  EXPECT_EQ(Matters(), Words{"multicast"});
}

TEST_F(FindingsTest, AServiceThatShowsNothingIsASecuredOne) {
  seen_.has_credentials = false;
  seen_.neighbours.programs[2] = {.process = "collisiond", .pid = "9", .host = "there"};
  EXPECT_EQ(Matters(), Words{"secured"});
  EXPECT_NE(Page().find("to this one: collisiond (pid 9 on there)"), std::string::npos) << Page();
}

// Goal:   where the credentials of this program are the cause, they are named and not the network.
TEST_F(FindingsTest, CredentialsThatDoNotFitAreNamed) {
  seen_.without_credentials.programs[2] = {.process = "collisiond", .pid = "9", .host = "there"};
  EXPECT_EQ(Matters(), Words{"authority"});
  EXPECT_NE(Page().find("to this one: collisiond (pid 9 on there)"), std::string::npos) << Page();
  seen_.without_credentials.peers.push_back({.program = 2,
                                             .writes = true,
                                             .topic = "collision/v1/service_status",
                                             .partitions = {"lab"}});
  EXPECT_EQ(Matters(), Words{"open-world"});
  // Its writers are seen; it is not, before the handshake.
  AddService(3, "10.0.0.9");
  seen_.neighbours.programs.erase(3);
  EXPECT_EQ(Matters(), Words{"authority"});
}

// Goal:   where DDS does not start, the one thing that is wrong is named.
TEST_F(FindingsTest, WhatKeepsDdsFromStartingIsNamed) {
  seen_.has_credentials = false;
  seen_.failure = "DDS participant in domain 0: Error";
  EXPECT_EQ(Matters(), Words{"dds"});
  EXPECT_NE(Page().find(seen_.failure), std::string::npos) << Page();
  seen_.profile = "file:///nowhere.xml";
  seen_.failure_lines = "can't open configuration file file:///nowhere.xml";
  EXPECT_EQ(Matters(), Words{"profile"});
  EXPECT_NE(Page().find("unset it"), std::string::npos) << Page();
  seen_.failure_lines = "eth9: does not match an available interface.";
  EXPECT_NE(Page().find("lo 127.0.0.1, eth0 10.0.0.7"), std::string::npos) << Page();
  seen_.failure_lines = "config: //CycloneDDS/Domain: Foo: unknown element";
  EXPECT_NE(Page().find("correct that place"), std::string::npos) << Page();
  seen_.failure_lines = "credentials: /nowhere: there is no such folder";
  EXPECT_EQ(Matters(), Words{"credentials"});
  seen_.has_credentials = true;
  seen_.failure_lines = "Could not find domain 4 in governance(code: 141)";
  EXPECT_EQ(Matters(), Words{"credentials"});
}

TEST_F(FindingsTest, AServiceThatIsFoundAndNotHeard) {
  AddService(2, "10.0.0.9:7410");
  EXPECT_EQ(Matters(), Words{"unheard"});
  seen_.neighbours.programs[2].addresses = "192.168.1.9:7410";
  EXPECT_EQ(Matters(), Words{"other-network"});
  EXPECT_NE(Page().find("found at 192.168.1.9"), std::string::npos) << Page();
  seen_.neighbours.peers[0].misfit = "its type has no key";
  EXPECT_EQ(Matters(), Words{"misfit"});
}

TEST_F(FindingsTest, InterfacesMatterWhereNothingIsHeard) {
  seen_.interfaces.push_back(
      {.name = "eth1", .address = AddressOf("192.168.1.7"), .mask = AddressOf("255.255.255.0")});
  EXPECT_EQ(Matters(), (Words{"nobody", "interface"}));
  EXPECT_NE(Page().find("speaks on eth0 10.0.0.7 alone, and there is also eth1 192.168.1.7"),
            std::string::npos)
      << Page();
  AddService(2, "10.0.0.9");
  Status();
  EXPECT_EQ(Matters(), Words{});
}

TEST_F(FindingsTest, WhoSpeaksOnLoopbackAloneHearsNoOtherHost) {
  seen_.own_address = "127.0.0.1";
  EXPECT_EQ(Matters(), (Words{"nobody", "loopback"}));
}

TEST_F(FindingsTest, SeveralServicesAreTroubleUnlessTheyStandBy) {
  AddService(2, "10.0.0.9");
  AddService(3, "10.0.0.10");
  Status();
  EXPECT_EQ(Matters(), Words{"two-services"});
  v1::ServiceStatus* standby = Status();
  standby->set_service_id(9);
  standby->set_phase(v1::PHASE_STANDBY);
  EXPECT_EQ(Matters(), Words{});
}

TEST_F(FindingsTest, WhatTheStatusComplainsOfIsPassedOn) {
  AddService(2, "10.0.0.9");
  v1::ServiceStatus* status = Status();
  Extend(status, "recording_failure", "run.rec: no space left");
  v1::SimulatorStatus* simulator = status->add_simulators();
  simulator->set_name("alpha");
  EXPECT_EQ(Matters(), (Words{"service", "silent"}));
  EXPECT_NE(Page().find("1. FAILS to record: run.rec: no space left"), std::string::npos) << Page();
}

TEST_F(FindingsTest, PeersOfOtherWorldsAreNobodysTrouble) {
  AddService(2, "10.0.0.9");
  Status();
  seen_.neighbours.peers.push_back({.program = 4,
                                    .writes = true,
                                    .topic = "collision/v1/agent_states",
                                    .partitions = {"lab2.x"},
                                    .misfit = "its type has no key"});
  EXPECT_EQ(Matters(), Words{});
  for (const char* partition : {"lab.x", "lab"}) {
    seen_.neighbours.peers.back().partitions = {partition};
    EXPECT_EQ(Matters(), Words{"misfit"}) << partition;
  }
}

TEST_F(FindingsTest, AnOpenNetworkIsNoted) {
  AddService(2, "10.0.0.9");
  Status();
  seen_.has_credentials = false;
  EXPECT_EQ(Matters(), Words{"open"});
  EXPECT_TRUE(Page().starts_with("WELL: ")) << "it is a note";
  EXPECT_NE(Page().find("\nnote: the world is on the network of 10.0.0.7"), std::string::npos);
  seen_.own_address = "127.0.0.1";
  EXPECT_EQ(Matters(), Words{});
}

TEST_F(FindingsTest, HasADocument) {
  EXPECT_EQ(DoctorJson({{.matter = "no-service", .what = "none \"here\"", .advice = "start one"}}),
            R"({"schema":"collision/1","kind":"doctor","findings":[{"matter":"no-service",)"
            R"("what":"none \"here\"","advice":"start one","is_note":false}]})");
}

}  // namespace
}  // namespace collision::client
