#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/simulation/contact_checker.h"
#include "tests/simulation/scenario.h"

namespace collision::server {
namespace {

constexpr std::int64_t kEnd = 15 * kSecond;

std::vector<SimulatedAgent> Wanderers(int count, double jumps_per_piece, Random* random) {
  std::vector<SimulatedAgent> agents;
  for (int i = 0; i < count; ++i) {
    const WanderOptions options{
        .half_side = 5, .speed = 8, .acceleration_max = 5, .jumps_per_piece = jumps_per_piece};
    agents.push_back({.radius = random->Uniform(0.3, 1.5),
                      .acceleration_max = options.acceleration_max,
                      .motion = Wander(options, kEnd, random)});
  }
  return agents;
}

/// Three simulators with ten agents each, with states at different rates, some in small chunks.
void AddThree(double jumps_per_piece, Scenario* scenario) {
  Random random(7);
  scenario->Add({.name = "alpha", .sender = 11, .period_ns = 100'000'000, .end_ns = kEnd},
                Wanderers(10, jumps_per_piece, &random));
  scenario->Add(
      {.name = "beta", .sender = 12, .period_ns = 250'000'000, .end_ns = kEnd, .chunk_size = 4},
      Wanderers(10, jumps_per_piece, &random));
  scenario->Add(
      {.name = "gamma", .sender = 13, .period_ns = 40'000'000, .end_ns = kEnd, .chunk_size = 1},
      Wanderers(10, jumps_per_piece, &random));
  scenario->StartService();
  scenario->StartSimulators();
}

// Goal:   no contact comes unannounced, every bracket holds its truth, nothing is confirmed that
//         is not true, on a good network and on bad ones; and the answers are of use: most
//         contacts are confirmed, narrowly.
// Method: three simulators in lock-step with exact motion; the truth from polynomials.
TEST(Simulation, IsNeverLateOnAnyNetwork) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    NetworkOptions network{.seed = seed};
    if (seed > 1) {
      network.loss = 0.1;
      network.duplicate = 0.1;
      network.delay_max_ns = 5'000'000;
    }
    Scenario scenario(ConfigFor(3), network);
    AddThree(0, &scenario);
    scenario.Run();
    for (const SimulatedSimulator* simulator : scenario.simulators()) {
      EXPECT_TRUE(simulator->finished()) << simulator->clock_ns();
      EXPECT_FALSE(simulator->grant_withdrawn());
    }
    const CheckerResult result = CheckContacts(scenario.simulators(), scenario.published(), kEnd);
    EXPECT_TRUE(result.violations.empty()) << "seed " << seed << ":\n" << ViolationsOf(result);
    EXPECT_GE(result.contacts, 40u);
    EXPECT_GE(result.confirmed, result.contacts * 8 / 10);
    EXPECT_GE(result.promises, 100u);
    EXPECT_LE(result.begin_width_greatest, 0.2);
    EXPECT_EQ(scenario.counter("breaches"), 0u);
  }
}

}  // namespace
}  // namespace collision::server
