// Goal:   a probe hears in one sentence whether the service is well, and by its exit code how bad
//         it is; trouble of others is no failure of the service.
// Method: two statuses by hand, through a monitor.
#include "client/programs/tools/collisionctl/health.h"

#include <gtest/gtest.h>

#include "tests/client/programs/tools/collisionctl_fixture.h"

namespace collision::client {
namespace {

class HealthTest : public CollisionctlTest {
 protected:
  Health Now(std::size_t required = 0) {
    monitor_.Poll(std::chrono::nanoseconds(0));
    return HealthOf(before_, view_, required);
  }

  void Expect(const Health& health, HealthLevel level, const std::string& part) {
    EXPECT_EQ(health.level, level) << health.text;
    EXPECT_NE(health.text.find(part), std::string::npos) << health.text;
    EXPECT_EQ(health.text.find('\n'), std::string::npos) << health.text;
  }

  static void AddSimulator(v1::ServiceStatus* status, bool alive, std::uint64_t rejected) {
    v1::SimulatorStatus* simulator = status->add_simulators();
    simulator->set_simulator_id(5);
    simulator->set_name("alpha");
    simulator->set_alive(alive);
    simulator->set_rejected(rejected);
  }

  v1::ServiceStatus before_;
};

TEST_F(HealthTest, AServiceThatServesIsWell) {
  Status();
  Expect(Now(), HealthLevel::kWell, "WELL");
}

TEST_F(HealthTest, SimulatorsThatAreRequiredMustBeAlive) {
  AddSimulator(Status(), true, 0);
  Expect(Now(1), HealthLevel::kWell, "WELL");
  Expect(Now(2), HealthLevel::kCritical, "1 of the 2 simulators that are required are alive");
  AddSimulator(Status(), false, 0);
  Expect(Now(1), HealthLevel::kCritical, "0 of the 1");
}

TEST_F(HealthTest, WhatIsRefusedNowIsTroubleAndWhatWasIsNot) {
  AddSimulator(&before_, true, 7);
  AddSimulator(Status(), true, 7);
  Expect(Now(), HealthLevel::kWell, "WELL");
  AddSimulator(Status(), true, 8);
  Expect(Now(), HealthLevel::kTrouble, "REFUSES alpha");
}

TEST_F(HealthTest, WaitingAndLimitsAreTrouble) {
  Extend(Status(), "waiting_for", "beta");
  Expect(Now(), HealthLevel::kTrouble, "WAITS for beta");
  Extend(Status(), "quotas", "alpha: agents 95 of 100");
  Expect(Now(), HealthLevel::kTrouble, "NEARS A LIMIT");
}

TEST_F(HealthTest, AServiceThatServesAndKeepsNothingIsInTrouble) {
  Extend(Status(), "state_failure", "no space left");
  Expect(Now(), HealthLevel::kTrouble, "FAILS to keep its journal");
}

TEST_F(HealthTest, HasADocument) {
  EXPECT_EQ(HealthJson({HealthLevel::kTrouble, "WAITS for \"beta\""}),
            R"({"schema":"collision/1","kind":"health","level":"trouble",)"
            R"("text":"WAITS for \"beta\""})");
}

}  // namespace
}  // namespace collision::client
