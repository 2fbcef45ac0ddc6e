// Goal:   an owner whose agents crowd saturates these, and leaves the others what they are
//         guaranteed; alone it may have everything.
// Method: a crowd beside two agents that meet far from it.
#include <gtest/gtest.h>

#include "tests/collision_core/detection/line.h"

namespace collision::detection {
namespace {

constexpr OwnerId kCrowd{.simulator = 1, .run = 1}, kOther{.simulator = 2, .run = 1};

AgentId IdOf(const OwnerId& owner, std::uint32_t slot) {
  return {.simulator = owner.simulator, .slot = slot, .run = owner.run, .generation = 1};
}

/// Steps, of 63 in which a crowd at one place fills the table, in which the two others, which touch
/// far away, are not saturated.
int ClearSteps(const Share& of_crowd) {
  constexpr std::uint32_t kAgents = 40, kPairsMax = 200;
  DetectorOptions options;
  options.pairs_max = kPairsMax;
  Detector detector(options);
  const AgentDeclaration ball{.limits = {.radius = 1, .acceleration_max = 1}};
  for (std::uint32_t slot = 0; slot < kAgents; ++slot) {
    detector.Admit(IdOf(kCrowd, slot), ball, State(0, {0, 0, 0}, {0, 0, 0}), At(0));
  }
  detector.SetPairShare(kCrowd, of_crowd);
  detector.Advance(At(0));
  int clear = 0;
  for (int step = 1; step <= 64; ++step) {
    const double now = step / 64.0;
    if (step == 2) {
      for (const std::uint32_t slot : {0u, 1u}) {
        const Eigen::Vector3d place(1000.0 + slot, 0, 0);
        detector.Admit(IdOf(kOther, slot), ball, State(now, place, {0, 0, 0}), At(now));
      }
      detector.SetPairShare(kOther, {.guaranteed = 20});
    }
    // One of the crowd is renewed in each step: it takes whatever is free.
    const auto renewed = static_cast<std::uint32_t>(step) % kAgents;
    detector.Update(IdOf(kCrowd, renewed), State(now, {0, 0, 0}, {0, 0, 0}), At(now));
    detector.SetHeardUntil(kCrowd, At(now));
    detector.SetHeardUntil(kOther, At(now));
    detector.Advance(At(now));
    detector.Validate();
    EXPECT_LE(detector.pairs_tracked(), kPairsMax);
    if (step < 2) continue;
    const auto clearance = detector.ClearanceOf(IdOf(kOther, 0));
    clear += clearance && !clearance->saturated;
  }
  return clear;
}

TEST(PairShares, ACrowdSaturatesItsOwnAgents) {
  EXPECT_EQ(ClearSteps({}), 0) << "without a share the first comer has it all";
  EXPECT_EQ(ClearSteps({.max = 180}), 63);
}

}  // namespace
}  // namespace collision::detection
