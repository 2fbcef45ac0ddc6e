// Goal:   owners take turns by the work that they have had, their pairs in the order in which they
//         began to wait; no pair starves, and what one owner does not want is there for the others.
// Method: queues filled by hand, with costs that make each turn known.
#include "collision_core/detection/pairs/owner_queues.h"

#include <gtest/gtest.h>

#include <map>

#include "tests/collision_core/detection/line.h"

namespace collision::detection {
namespace {

constexpr OwnerId kMany{7, 1}, kOne{3, 1};
constexpr double kStep = 0.125;  // and Δt [s]

class OwnerQueuesTest : public testing::Test {
 protected:
  explicit OwnerQueuesTest(std::uint64_t slice = 0) : queues_(kStep, slice) {}

  void Add(std::uint32_t slot, const OwnerId& a, const OwnerId& b) {
    queues_.AddPair(PairSlot(slot), a, b);
    queues_.Wait(PairSlot(slot));
  }

  /// The slots whose turn it is, `steps` Δt after the last.
  std::vector<std::uint32_t> Take(std::uint64_t units, double steps = 1, bool news = false) {
    now_ += steps * kStep;
    std::vector<std::uint32_t> slots;
    for (const PairTurn& turn : queues_.Take(
             units, [](PairSlot) { return std::uint64_t{10}; }, At(now_), news)) {
      slots.push_back(turn.slot.value());
      queues_.RecordEvaluation(turn, 10);
    }
    queues_.Validate();
    return slots;
  }

  OwnerWork WorkOf(const OwnerId& owner) const {
    for (const OwnerWork& work : queues_.work()) {
      if (work.owner == owner) return work;
    }
    return {};
  }

  OwnerQueues queues_;
  double now_ = 0;
};

/// A slice is two turns.
class SlicedOwnerQueuesTest : public OwnerQueuesTest {
 protected:
  SlicedOwnerQueuesTest() : OwnerQueuesTest(20) {}
};

using Slots = std::vector<std::uint32_t>;

TEST_F(OwnerQueuesTest, OwnersTakeTurnsWhateverTheirPairs) {
  for (std::uint32_t slot = 0; slot < 8; ++slot) Add(slot, kMany, kMany);
  for (std::uint32_t slot = 8; slot < 10; ++slot) Add(slot, kOne, kOne);
  EXPECT_EQ(Take(40), (Slots{0, 1, 8, 9}));
  EXPECT_EQ(Take(40), (Slots{2, 3, 4, 5})) << "the share of the other is free";
  EXPECT_EQ(queues_.waiting(), 2u);
}

TEST_F(OwnerQueuesTest, NoPairComesAgainBeforeAllThatWaited) {
  constexpr std::uint32_t kPairs = 5;
  constexpr int kSteps = 30;
  std::map<std::uint32_t, int> since, turns;  // the step in which each began to wait
  for (std::uint32_t slot = 0; slot < kPairs; ++slot) Add(slot, kMany, kMany), since[slot] = 0;
  for (int step = 1; step <= kSteps; ++step) {
    const Slots taken = Take(20);
    ASSERT_EQ(taken.size(), 2u) << step;
    int latest = 0;
    for (const std::uint32_t slot : taken) {
      latest = std::max(latest, since[slot]);
      EXPECT_LE(step - since[slot], 3) << "two of five each step: pair " << slot;
      ++turns[slot];
      since[slot] = step;
      queues_.Wait(PairSlot(slot));
    }
    for (const auto& [slot, at] : since) EXPECT_GE(at, latest) << step << ": pair " << slot;
  }
  // Within a step pairs begin to wait in the order of their slots.
  for (std::uint32_t slot = 0; slot < kPairs; ++slot) {
    EXPECT_GE(turns[slot], kSteps / 3) << slot;
  }
}

TEST_F(OwnerQueuesTest, TheOwnerWithMorePairsPaysForThoseOfBoth) {
  Add(0, kMany, kMany);
  Add(1, kOne, kMany);
  EXPECT_EQ(queues_.PayerOf(PairSlot(1u)), kMany);
  queues_.RemovePair(PairSlot(0u));
  EXPECT_EQ(queues_.PayerOf(PairSlot(1u)), kOne) << "of equal ones the lower id";
  EXPECT_EQ(queues_.waiting(), 1u) << "the pair waits where it was";
}

TEST_F(OwnerQueuesTest, StepsThatFollowFastGiveNoMoreThanTheShare) {
  for (std::uint32_t slot = 0; slot < 64; ++slot) Add(slot, kMany, kMany);
  std::size_t taken = 0;
  for (int step = 0; step < 64; ++step) taken += Take(40, 1.0 / 16).size();
  EXPECT_GE(taken, 4u * 4) << "four Δt";
  EXPECT_LE(taken, 4u * (4 + 1) + 1) << "and the credit at first";
  Add(100, kOne, kOne);
  const Slots next = Take(40, 0);
  EXPECT_TRUE(std::find(next.begin(), next.end(), 100u) != next.end())
      << "one that wants little has its turn at once";
}

TEST_F(OwnerQueuesTest, SaysSinceWhenAnOwnerIsHeldToItsShare) {
  for (std::uint32_t slot = 0; slot < 4; ++slot) Add(slot, kMany, kMany);
  Add(4, kOne, kOne);
  Take(20);
  EXPECT_EQ(WorkOf(kMany).held_since, At(kStep));
  EXPECT_EQ(WorkOf(kMany).sharing, 2u);
  EXPECT_EQ(WorkOf(kMany).waiting, 3u);
  EXPECT_TRUE(WorkOf(kOne).held_since.is_never());
  Take(20);
  EXPECT_EQ(WorkOf(kMany).held_since, At(kStep));
  Take(20);
  EXPECT_TRUE(WorkOf(kMany).held_since.is_never());
  EXPECT_EQ(WorkOf(kMany).wanted, 4u);
  EXPECT_EQ(WorkOf(kMany).evaluated, 4u);
  EXPECT_EQ(WorkOf(kMany).work_units, 40u);
}

TEST_F(SlicedOwnerQueuesTest, AnOwnerWhosePairsHaveWaitedSpendsASliceInOneStep) {
  for (std::uint32_t slot = 0; slot < 20; ++slot) Add(slot, kMany, kMany);
  EXPECT_EQ(Take(40).size(), 4u) << "nothing has waited yet";
  EXPECT_EQ(Take(40).size(), 2u);
  for (std::uint32_t slot = 20; slot < 24; ++slot) Add(slot, kOne, kOne);
  EXPECT_EQ(Take(60, 4), (Slots{6, 7, 20, 21, 22, 23})) << "the other one has waited for nothing";
}

// Goal:   a pair that needs more than a slice is not cut short: it has a step of its owner's.
TEST_F(SlicedOwnerQueuesTest, APairThatCostsMoreThanASliceHasAStepOfItsOwn) {
  for (std::uint32_t slot = 0; slot < 20; ++slot) Add(slot, kMany, kMany);
  Take(40);
  const auto cost = [](PairSlot slot) { return slot.value() == 5 ? std::uint64_t{35} : 10; };
  const auto take = [&] { return queues_.Take(400, cost, At(now_ += kStep)); };
  const std::vector<PairTurn> before = take(), it = take(), after = take();
  ASSERT_EQ(before.size(), 1u);
  EXPECT_EQ(before[0].slot.value(), 4u);
  ASSERT_EQ(it.size(), 1u);
  EXPECT_EQ(it[0].slot.value(), 5u);
  EXPECT_EQ(it[0].payer_units, 35u);
  ASSERT_EQ(after.size(), 2u);
  EXPECT_EQ(after[0].payer_units, 20u);
  queues_.Validate();
}

// A slice of 20 of 40 in each Δt: one is due each half of it, and gives way for eight of them.
TEST_F(SlicedOwnerQueuesTest, AnOwnerThatIsHeldGivesWayToTheOthers) {
  for (std::uint32_t slot = 0; slot < 20; ++slot) Add(slot, kMany, kMany);
  Take(40), Take(40);
  Add(20, kOne, kOne);
  EXPECT_EQ(Take(40, 0.5), (Slots{20}));
  EXPECT_EQ(Take(40, 0).size(), 2u) << "alone it need not wait";
  for (int step = 1; step <= 16; ++step) {
    queues_.Wait(PairSlot(20u));
    EXPECT_EQ(Take(40, 0.5).size(), step % 8 == 0 ? 3u : 1u) << step;
  }
}

TEST_F(SlicedOwnerQueuesTest, AnOwnerThatIsHeldGivesWayToNews) {
  for (std::uint32_t slot = 0; slot < 20; ++slot) Add(slot, kMany, kMany);
  Take(40), Take(40);
  for (int step = 1; step <= 16; ++step) {
    EXPECT_EQ(Take(40, 0.5, true).size(), step % 8 == 0 ? 2u : 0u) << step;
  }
}

TEST_F(SlicedOwnerQueuesTest, AnOwnerThatIsHeldSavesUpTwoSlices) {
  for (std::uint32_t slot = 0; slot < 60; ++slot) Add(slot, kMany, kMany);
  EXPECT_EQ(Take(400).size(), 40u) << "nothing has waited yet";
  EXPECT_EQ(Take(400, 100).size(), 2u);
  EXPECT_EQ(Take(400, 0).size(), 2u);
  EXPECT_EQ(Take(400, 0).size(), 1u) << "the turn that ends in debt";
  EXPECT_EQ(Take(400, 0).size(), 0u);
}

TEST_F(OwnerQueuesTest, ADebtOutlivesThePairsAndTheRun) {
  constexpr OwnerId kNextRun{kMany.simulator, kMany.run + 1};
  Add(0, kMany, kMany);
  Take(40);
  EXPECT_EQ(queues_.CreditOf(kMany, 40, At(now_)), 30u);
  queues_.Charge(kMany, 60);
  queues_.RemovePair(PairSlot(0u));
  Add(1, kNextRun, kNextRun);
  EXPECT_TRUE(Take(40, 0).empty()) << "no fresh credit in the same step";
  queues_.RemovePair(PairSlot(1u));
  EXPECT_TRUE(Take(40, 0.25).empty()) << "nothing waits, and the debt stays";
  Add(2, kNextRun, kNextRun);
  EXPECT_TRUE(Take(40, 0.25).empty());
  EXPECT_EQ(Take(40, 0.5), (Slots{2})) << "paid off";
}

TEST_F(OwnerQueuesTest, DebtsAreForgottenOnceTheyArePaidOff) {
  Add(0, kMany, kMany);
  Take(40);
  queues_.Charge(kMany, 60);
  queues_.RemovePair(PairSlot(0u));
  EXPECT_EQ(queues_.debtors(), 1u);
  Take(40, 1);
  EXPECT_EQ(queues_.debtors(), 1u) << "it has no full credit yet";
  Take(40, 1);
  EXPECT_EQ(queues_.debtors(), 0u);
}

TEST_F(OwnerQueuesTest, TheOldestDebtsGiveWay) {
  constexpr auto kMax = static_cast<std::uint32_t>(OwnerQueues::kDebtorsMax);
  for (std::uint32_t k = 0; k <= kMax; ++k) {
    const OwnerId owner{100 + k, 1};
    queues_.AddPair(PairSlot(0u), owner, owner);
    queues_.CreditOf(owner, 40, At(now_));
    queues_.Charge(owner, 60);
    queues_.RemovePair(PairSlot(0u));
  }
  Take(40, 0);
  EXPECT_EQ(queues_.debtors(), kMax);
  Add(0, {100, 1}, {100, 1});
  Add(1, {101, 1}, {101, 1});
  EXPECT_EQ(Take(40, 0), (Slots{0})) << "of the two the first one's is forgotten";
}

TEST_F(SlicedOwnerQueuesTest, TheSlicesOfAResolutionAreTheOwnersShare) {
  for (std::uint32_t slot = 0; slot < 60; ++slot) Add(slot, kMany, kMany);
  std::size_t turns = 0;
  for (int step = 0; step < 32; ++step) turns += Take(40, 0.25).size();
  EXPECT_GE(turns, 8 * 4u) << "8 resolutions of four turns each";
  EXPECT_LE(turns, (8 + 1) * 4u + 1) << "and the credit at first";
}

}  // namespace
}  // namespace collision::detection
