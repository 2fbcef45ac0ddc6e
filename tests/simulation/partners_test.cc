// Goal:   over networks that lose and reorder, pairs that assemblies, lists, classes or the
//         configuration keep apart have no event, and of all others no contact comes unannounced;
//         margins count as much of the radius.
// Method: a crowd of balls in which every rule occurs; the truth from polynomials, and the rules
//         from their definition by names.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/simulation/contact_checker.h"
#include "tests/simulation/scenario.h"

namespace collision::server {
namespace {

constexpr std::int64_t kEnd = 8 * kSecond;
constexpr int kAgents = 16;  // of each simulator

/// Classes that meet, in the configuration below.
bool ClassesMeet(const std::string& a, const std::string& b) {
  const auto either = [&](const char* x, const char* y) {
    return (a == x && b == y) || (a == y && b == x);
  };
  return a.empty() || b.empty() || either("robot", "robot") || either("robot", "person");
}

v1::Config ConfigWithClasses() {
  v1::Config config = ConfigFor(2);
  v1::AgentClass* robot = config.add_classes();
  robot->set_name("robot");
  robot->add_meets("robot");
  robot->add_meets("person");
  config.add_classes()->set_name("person");
  v1::ExcludedPair* pair = config.add_excluded();
  pair->set_first("beta/beta-1");
  pair->set_second("alpha/alpha-1");
  return config;
}

/// What the agent in a slot declares of its partners.
void Declare(const std::string& simulator, int slot, v1::AgentDescription* wire) {
  const auto name = [&](int of) { return simulator + "-" + std::to_string(of); };
  if (slot % 4 != 3) wire->set_assembly("arm-" + std::to_string(slot % 4));
  if (slot % 5 == 0) wire->set_class_name("person");
  if (slot % 5 == 1 || slot % 5 == 2) wire->set_class_name("robot");
  if (slot % 3 == 0) wire->add_meets_in_assembly(name((slot + 4) % kAgents));
  if (slot % 3 == 1) wire->add_never_meets(name((slot + 1) % kAgents));
}

v1::AgentDescription DescriptionIn(const std::string& simulator, std::uint32_t slot) {
  v1::AgentDescription wire;
  wire.set_simulator_name(simulator);
  wire.set_agent_name(simulator + "-" + std::to_string(slot));
  Declare(simulator, static_cast<int>(slot), &wire);
  return wire;
}

bool Names(const google::protobuf::RepeatedPtrField<std::string>& names,
           const v1::AgentDescription& agent) {
  return std::ranges::count(names, agent.agent_name()) > 0;
}

bool CanMeet(const v1::AgentDescription& a, const v1::AgentDescription& b) {
  if (!ClassesMeet(a.class_name(), b.class_name())) return false;
  const bool same_simulator = a.simulator_name() == b.simulator_name();
  if (!same_simulator)
    return !(a.agent_name() == "alpha-1" && b.agent_name() == "beta-1") &&
           !(b.agent_name() == "alpha-1" && a.agent_name() == "beta-1");
  if (Names(a.never_meets(), b) || Names(b.never_meets(), a)) return false;
  if (a.assembly().empty() || a.assembly() != b.assembly()) return true;
  return Names(a.meets_in_assembly(), b) || Names(b.meets_in_assembly(), a);
}

std::vector<SimulatedAgent> Members(const std::string& simulator, Random* random) {
  const WanderOptions options{.half_side = 2, .speed = 6, .acceleration_max = 4};
  std::vector<SimulatedAgent> agents;
  for (int slot = 0; slot < kAgents; ++slot) {
    agents.push_back({.radius = random->Uniform(0.2, 0.6),
                      .margin = random->Chance(0.5) ? 0 : random->Uniform(0.1, 0.5),
                      .acceleration_max = options.acceleration_max,
                      .motion = Wander(options, kEnd, random),
                      .declare = [simulator, slot](v1::AgentDescription* wire) {
                        Declare(simulator, slot, wire);
                      }});
  }
  return agents;
}

class PartnersTest : public testing::TestWithParam<std::uint64_t> {
 protected:
  void Start(Scenario* scenario) {
    Random random(31);
    scenario->Add({.name = "alpha", .sender = 1, .period_ns = 50'000'000, .end_ns = kEnd},
                  Members("alpha", &random));
    scenario->Add(
        {.name = "beta", .sender = 2, .period_ns = 125'000'000, .end_ns = kEnd, .chunk_size = 4},
        Members("beta", &random));
    scenario->StartService();
    scenario->StartSimulators();
  }

  static CheckerResult Check(const Scenario& scenario) {
    const auto of = [&](const detection::AgentId& id) {
      const bool first = id.simulator == scenario.simulators()[0]->id();
      return DescriptionIn(first ? "alpha" : "beta", id.slot);
    };
    CheckerOptions options;
    options.can_meet = [of](const detection::AgentId& a, const detection::AgentId& b) {
      return CanMeet(of(a), of(b));
    };
    return CheckContacts(scenario.simulators(), scenario.published(), kEnd, options);
  }
};

TEST_P(PartnersTest, WhatIsKeptApartHasNoEventAndNothingElseIsLate) {
  Scenario scenario(ConfigWithClasses(),
                    GetParam() == 0 ? NetworkOptions{.seed = 1} : Lossy(GetParam()));
  Start(&scenario);
  scenario.Run();
  for (const SimulatedSimulator* simulator : scenario.simulators()) {
    EXPECT_TRUE(simulator->finished());
    EXPECT_TRUE(GetParam() != 0 || simulator->rejections().empty());
  }
  const CheckerResult result = Check(scenario);
  EXPECT_TRUE(result.violations.empty()) << ViolationsOf(result);
  EXPECT_GE(result.contacts, 60u);
  EXPECT_GE(result.confirmed, 40u);
}

INSTANTIATE_TEST_SUITE_P(Networks, PartnersTest, testing::Values(0, 1, 2));

// Goal: the truth above is about something: without the rules, their pairs would be told.
TEST(Partners, WithoutTheRulesThePairsMeet) {
  Random random(31);
  std::vector<SimulatedAgent> agents = Members("alpha", &random);
  for (SimulatedAgent& agent : agents) agent.declare = {};
  Scenario scenario(ConfigFor(1), NetworkOptions{.seed = 1});
  scenario.Add({.name = "alpha", .sender = 1, .period_ns = 50'000'000, .end_ns = kEnd}, agents);
  scenario.StartService();
  scenario.StartSimulators();
  scenario.Run();
  std::size_t excluded = 0;
  for (const v1::CollisionEvent& event : scenario.events()) {
    excluded += event.status() == v1::EVENT_CONFIRMED &&
                !CanMeet(DescriptionIn("alpha", event.lower().slot()),
                         DescriptionIn("alpha", event.higher().slot()));
  }
  EXPECT_GT(excluded, 10u);
}

}  // namespace
}  // namespace collision::server
