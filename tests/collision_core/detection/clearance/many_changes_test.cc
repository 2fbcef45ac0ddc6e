// Goal:   of many changes at once each costs one query that looks no farther than it must, whatever
//         else is in the scene; and clearances do not depend on how many changes came at once.
// Method: counted work in a swarm, and in one beside agents that are clear for long; the same
//         changes one by one.
#include <gtest/gtest.h>

#include <vector>

#include "tests/collision_core/detection/line.h"
#include "tests/support/random.h"

namespace collision::detection {
namespace {

// Drones as dense as 10,000 in 2 km x 2 km x 200 m; beside them some that stand far apart from all.
class Swarm {
 public:
  Swarm(std::uint32_t drones, std::uint32_t others,
        broad_phase::BroadPhaseMethod method = broad_phase::BroadPhaseMethod::kAuto)
      : drones_(drones) {
    const double side = 2000 * std::sqrt(drones / 10000.0);
    Random random(3);
    for (std::uint32_t slot = 0; slot < drones + others; ++slot) {
      const bool drone = slot < drones;
      Vector3d p{random.Uniform(0, side), random.Uniform(0, side), random.Uniform(0, 200)};
      if (!drone) p = Vector3d(10000 + 5 * p.x(), 5 * p.y(), 10 * p.z());
      states_.push_back(
          State(0, p, drone ? random.UnitVector() * random.Uniform(0, 10) : Vector3d(0, 0, 0)));
      declarations_.push_back({.limits = {.radius = 0.5, .acceleration_max = drone ? 5 : 1e-3}});
    }
    DetectorOptions options;
    options.agents_max = drones + others;
    options.broad_phase = method;
    detector.emplace(options);
  }

  void AdmitAll(bool one_by_one) {
    for (std::uint32_t slot = 0; slot < states_.size(); ++slot) {
      detector->Admit(Id(slot), declarations_[slot], states_[slot], At(0));
      if (one_by_one) detector->Advance(At(0));
    }
    detector->Advance(At(0));
  }

  /// Every `every`-th drone may accelerate harder from now on.
  std::uint32_t Widen(std::uint32_t every, bool one_by_one) {
    std::uint32_t widened = 0;
    for (std::uint32_t slot = 0; slot < drones_; slot += every, ++widened) {
      declarations_[slot].limits.acceleration_max *= 1.01;
      detector->Redeclare(Id(slot), declarations_[slot], At(0));
      if (one_by_one) detector->Advance(At(0));
    }
    detector->Advance(At(0));
    detector->Validate();
    return widened;
  }

  std::vector<Instant> Clearances() const {
    std::vector<Instant> changed;
    for (std::uint32_t slot = 0; slot < states_.size(); ++slot) {
      const AgentClearance clearance = *detector->ClearanceOf(Id(slot));
      changed.push_back(clearance.clear_until);
    }
    return changed;
  }

  std::uint64_t tests() const { return detector->counters().filter_tests; }
  std::uint64_t queries() const { return detector->counters().pair_queries; }

  std::optional<Detector> detector;

 private:
  std::uint32_t drones_;
  std::vector<motion::MotionState> states_;
  std::vector<AgentDeclaration> declarations_;
};

TEST(ManyChanges, HaveTheEffectOfOneByOne) {
  Swarm at_once(500, 300), one_by_one(500, 300);
  at_once.AdmitAll(false);
  one_by_one.AdmitAll(true);
  ASSERT_EQ(at_once.Clearances(), one_by_one.Clearances());
  for (const std::uint32_t every : {1, 2, 7}) {
    const std::vector<Instant> before = at_once.Clearances();
    at_once.Widen(every, false);
    one_by_one.Widen(every, true);
    ASSERT_NE(at_once.Clearances(), before);
    ASSERT_EQ(at_once.Clearances(), one_by_one.Clearances()) << every;
  }
  EXPECT_EQ(at_once.detector->Earliest().earliest, one_by_one.detector->Earliest().earliest);
}

// So many changes that agents with far keys are queried anew, instead of examined for each change.
TEST(ManyChanges, VeryManyHaveTheEffectOfOneByOne) {
  constexpr std::uint32_t kDrones = 4200, kOthers = 300;
  Swarm at_once(kDrones, kOthers), one_by_one(kDrones, kOthers);
  Swarm all_pairs(kDrones, kOthers, broad_phase::BroadPhaseMethod::kAllPairs);
  for (Swarm* swarm : {&at_once, &one_by_one, &all_pairs}) {
    swarm->AdmitAll(false);
    swarm->detector->TakeChangedClearances();
  }
  const std::uint64_t asked = at_once.detector->counters().queries;
  at_once.Widen(1, false);
  // One query for each agent, bystanders included, instead of a test of each for each drone.
  EXPECT_EQ(at_once.detector->counters().queries - asked, kDrones + kOthers);
  one_by_one.Widen(1, true);
  all_pairs.Widen(1, false);
  ASSERT_EQ(at_once.Clearances(), one_by_one.Clearances());
  ASSERT_EQ(at_once.Clearances(), all_pairs.Clearances());
  EXPECT_EQ(at_once.detector->Earliest().earliest, one_by_one.detector->Earliest().earliest);
  // A lowered clearance names the cause and its agent.
  std::uint32_t others = 0;
  for (const AgentClearance& changed : at_once.detector->TakeChangedClearances()) {
    EXPECT_EQ(changed.cause, ClearanceCause::kWidening) << changed.agent.slot;
    EXPECT_LT(changed.cause_agent.slot, kDrones);
    others += changed.agent.slot >= kDrones;
  }
  EXPECT_EQ(others, kOthers);
  // The next change finds nothing left of this one.
  at_once.Widen(kDrones, false);
  for (const AgentClearance& changed : at_once.detector->TakeChangedClearances()) {
    EXPECT_EQ(changed.cause_agent.slot, 0u);
  }
}

// An agent's next meeting is 0.4 s beyond announce_within in the mean, so that some ten partners
// are near enough to count. A query twice as far would find 64 times as many.
TEST(ManyChanges, AnAdmissionLooksNoFartherThanItMust) {
  constexpr std::uint32_t kDrones = 4000;
  Swarm swarm(kDrones, 0);
  swarm.AdmitAll(false);
  EXPECT_LT(swarm.queries(), 4 * kDrones);
  EXPECT_LT(swarm.tests(), 400 * kDrones);
  std::uint64_t tests = swarm.tests(), queries = swarm.queries();
  swarm.Widen(1, false);
  EXPECT_LT(swarm.queries() - queries, 4 * kDrones);
  EXPECT_LT(swarm.tests() - tests, 400 * kDrones);
}

// Agents that are clear for a minute do not make each renewal query a minute ahead, where it meets
// all others.
TEST(ManyChanges, AgentsThatAreClearForLongCostARenewalOneTestEach) {
  constexpr std::uint32_t kDrones = 3000, kOthers = 200;
  Swarm swarm(kDrones, kOthers);
  swarm.AdmitAll(false);
  swarm.Widen(1, false);
  for (const std::uint32_t every : {2, 20}) {
    const std::uint64_t tests = swarm.tests(), queries = swarm.queries();
    const std::uint32_t widened = swarm.Widen(every, false);
    // Here the broad phase has the drones in few cells; a test of each of them would come on top.
    EXPECT_LT(swarm.tests() - tests, 2 * (kDrones + kOthers) * widened) << every;
    EXPECT_LT(swarm.queries() - queries, 6 * widened) << every;
  }
}

}  // namespace
}  // namespace collision::detection
