// Goal:   a simulator whose meshes all overlap costs the others next to nothing: their events are
//         those that they have without it, in the same steps; of its own pairs none is forgotten,
//         late or silent.
// Method: two ships of one owner that meet at a known time, alone and beside a crowd of another
//         owner under a budget that is far too small for the crowd. Work is counted in units.
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "collision_core/detection/detector.h"
#include "collision_core/detection/pairs/tracked_pairs.h"
#include "collision_core/shape/shape.h"
#include "tests/collision_core/detection/line.h"
#include "tests/support/meshes.h"

namespace collision::detection {
namespace {

constexpr std::uint32_t kCrowd = 24;
constexpr std::uint64_t kPerStep = 20'000;
constexpr std::uint64_t kOverrunOfTurn = 1000;
constexpr std::uint64_t kTurnMin = 1000;
constexpr OwnerId kHonest{1, 1}, kGreedy{2, 1};

struct Seen {
  std::vector<CollisionEvent> honest;
  std::set<std::pair<AgentId, AgentId>> announced, decided;  // of the crowd
  std::map<AgentId, Instant> clear_until;
  std::uint64_t most = 0;        // units in one step
  std::uint64_t most_later = 0;  // in one but the first
  std::size_t progress = 0;
  OwnerWork greedy;
};

AgentId IdOf(const OwnerId& owner, std::uint32_t slot) {
  return {owner.simulator, slot, owner.run, 1};
}

/// `returns`: when the crowd leaves and comes back in another run [s].
Seen Fly(std::uint32_t crowd, double seconds, std::uint64_t slice = 0, double returns = -1) {
  DetectorOptions options;
  options.temporal_resolution = 1.0 / 16;
  options.work_units_per_step = kPerStep;
  options.work_units_per_slice = slice;
  Detector detector(options);
  AgentDeclaration ship{.limits = {2, 1}};
  ship.limits.angular_acceleration_max = 0.5;
  ship.shape = shape::Shape::Build(LShape());
  AgentDeclaration mesh = ship;
  mesh.shape = shape::Shape::Build(Sphere(3));
  struct Mover {
    AgentId id;
    Vector3d p, v;
  };
  std::vector<Mover> movers;
  const auto put = [&](const OwnerId& owner, const AgentDeclaration& declaration, const Vector3d& p,
                       const Vector3d& v) {
    const AgentId id = IdOf(owner, static_cast<std::uint32_t>(movers.size()));
    detector.Admit(id, declaration, State(0, p, v), At(0));
    movers.push_back({id, p, v});
  };
  // Arms of 1 m; they touch from 3 s to 5 s.
  put(kHonest, ship, {0, 0, 0}, {0, 0, 0});
  put(kHonest, ship, {8, 0, 0.1}, {-2, 0, 0});
  for (std::uint32_t k = 0; k < crowd; ++k) {
    put(kGreedy, mesh, {1000 + 0.01 * k, 0.02 * (k % 5), 0.03 * (k % 7)}, {0, 0, 0});
  }
  Seen seen;
  for (double now = 0; now < seconds; now += 1.0 / 16) {
    const std::uint64_t before = detector.counters().work_units;
    for (const Mover& mover : movers) {
      if (now > 0) detector.Update(mover.id, State(now, mover.p + now * mover.v, mover.v), At(now));
    }
    for (Mover& mover : movers) {
      if (now != returns || OwnerOf(mover.id) != kGreedy) continue;
      detector.Remove(mover.id);
      ++mover.id.run;
      detector.Admit(mover.id, mesh, State(now, mover.p, mover.v), At(now));
    }
    detector.SetHeardUntil(kHonest, At(now));
    detector.SetHeardUntil(kGreedy, At(now));
    detector.Advance(At(now), [&] { ++seen.progress; });
    detector.Validate();
    const std::uint64_t units = detector.counters().work_units - before;
    seen.most = std::max(seen.most, units);
    if (now > 0) seen.most_later = std::max(seen.most_later, units);
    for (const CollisionEvent& event : detector.events()) {
      if (OwnerOf(event.lower) == kHonest) {
        seen.honest.push_back(event);
      } else {
        seen.announced.insert({event.lower, event.higher});
        if (event.status != EventStatus::kPossible)
          seen.decided.insert({event.lower, event.higher});
      }
    }
    for (const AgentClearance& clearance : detector.TakeChangedClearances()) {
      seen.clear_until[clearance.agent] = clearance.clear_until;
    }
  }
  for (const OwnerWork& work : detector.owner_work()) {
    if (work.owner == kGreedy) seen.greedy = work;
  }
  return seen;
}

void ExpectSameHonestEvents(const Seen& alone, const Seen& beside) {
  ASSERT_GE(alone.honest.size(), 3u);
  ASSERT_EQ(alone.honest.size(), beside.honest.size());
  for (std::size_t i = 0; i < alone.honest.size(); ++i) {
    EXPECT_EQ(alone.honest[i].now, beside.honest[i].now) << i;
    EXPECT_EQ(alone.honest[i].status, beside.honest[i].status) << i;
    EXPECT_EQ(alone.honest[i].begin.earliest, beside.honest[i].begin.earliest) << i;
    EXPECT_EQ(alone.honest[i].begin.latest, beside.honest[i].begin.latest) << i;
  }
}

TEST(GreedyOwner, LeavesTheEventsOfOthersAsTheyAre) {
  ExpectSameHonestEvents(Fly(0, 7), Fly(kCrowd, 7));
}

TEST(GreedyOwner, HoldsAStepUpForNoMoreThanASlice) {
  constexpr std::uint64_t kSlice = kPerStep / 8;
  const Seen alone = Fly(0, 7, kSlice), beside = Fly(kCrowd, 7, kSlice);
  ExpectSameHonestEvents(alone, beside);
  EXPECT_LE(beside.most_later, alone.most + kSlice + (1 + kSlice / kTurnMin) * kOverrunOfTurn);
  EXPECT_GT(beside.greedy.evaluated, 100u);
}

TEST(GreedyOwner, IsHeldToTheStepsWork) {
  const Seen beside = Fly(kCrowd, 7);
  EXPECT_LE(beside.most, kPerStep + (1 + kPerStep / kTurnMin) * kOverrunOfTurn);
  EXPECT_GT(beside.most, kPerStep / 2) << "and gets it";
  EXPECT_FALSE(beside.greedy.held_since.is_never());
  EXPECT_LE(beside.greedy.held_since, At(1));
  EXPECT_GT(beside.greedy.waiting, 100u);
  EXPECT_GT(beside.progress, beside.greedy.evaluated);
}

TEST(GreedyOwner, PaysForItsReturnOutOfOneCredit) {
  const Seen beside = Fly(kCrowd, 4, 0, 2);
  EXPECT_LE(beside.most, kPerStep + (1 + kPerStep / kTurnMin) * kOverrunOfTurn);
}

TEST(GreedyOwner, HasItsPairsAnnouncedAndEvaluatedInTurn) {
  constexpr std::size_t kPairs = kCrowd * (kCrowd - 1) / 2;
  constexpr std::size_t kAtOnce = TrackedPairs::kAnnouncedUnseen;
  const Seen first = Fly(kCrowd, 1.0 / 16);
  EXPECT_GE(first.announced.size(), kAtOnce);
  EXPECT_LE(first.announced.size(), kAtOnce + first.greedy.evaluated);
  EXPECT_EQ(Fly(kCrowd, static_cast<double>(kPairs / kAtOnce + 1) / 16).announced.size(), kPairs);
  for (const auto& [agent, clear_until] : first.clear_until) {
    EXPECT_TRUE(OwnerOf(agent) == kHonest || clear_until <= At(0)) << agent.slot;
  }
  const Seen last = Fly(kCrowd, 10);
  EXPECT_GT(last.greedy.evaluated, 2u * kCrowd * (kCrowd - 1) / 2) << "each more than once";
  EXPECT_EQ(last.decided.size(), kCrowd * (kCrowd - 1) / 2) << "each pair has an outcome";
}

}  // namespace
}  // namespace collision::detection
