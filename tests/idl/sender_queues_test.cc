// Goal:   every sender gets its share, in the order of its writing, whatever the others write; what
//         waits is bounded; a sender within its rates loses nothing but replaced samples.
// Method: queues of numbers, and a clock that the test sets.
#include "idl/dds/inbox/sender_queues.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <numeric>

namespace collision::dds {
namespace {

using Queues = SenderQueues<int>;
using Outcome = Queues::Outcome;

constexpr std::size_t kNoLimit = 1'000'000'000;
constexpr std::int64_t kSecond = 1'000'000'000;

SampleFacts Of(std::uint64_t sender, std::uint64_t key, std::size_t bytes = 100,
               std::size_t depth = 1) {
  SampleFacts facts;
  facts.sender = facts.key.writer = sender;
  facts.depth = depth;
  facts.bytes = bytes;
  for (std::size_t i = 0; i < 8; ++i) {
    facts.key.key[i] = static_cast<unsigned char>(key >> (8 * i));
  }
  return facts;
}

std::vector<int> Taken(Queues* queues, std::size_t samples = kNoLimit, std::int64_t now_ns = 0,
                       std::size_t bytes = kNoLimit) {
  std::vector<int> items;
  queues->Take(samples, bytes, now_ns, &items);
  return items;
}

TEST(SenderQueues, KeepTheOrderOfASenderAndTheNewestOfAKey) {
  Queues queues({});
  for (int i = 0; i < 9; ++i) queues.Put(Of(1, static_cast<std::uint64_t>(i % 3), 100, 2), i, 0);
  EXPECT_EQ(Taken(&queues), (std::vector<int>{3, 4, 5, 6, 7, 8}));
  EXPECT_TRUE(Taken(&queues).empty());
  EXPECT_EQ(queues.waiting_bytes(), 0u);
}

// Goal:   a clock that is written anew all the time comes to its turn behind many states, and then
//         the newest one does.
TEST(SenderQueues, TheOldestOfAKeyMayKeepItsPlace) {
  for (const bool behind : {false, true}) {
    Queues queues({});
    const int before = behind ? static_cast<int>(kBehind) : 10;
    SampleFacts clock = Of(1, 0, 100, 3);
    clock.keeps_place = true;
    for (int i = 1; i <= before; ++i) queues.Put(Of(1, static_cast<std::uint64_t>(i)), i, 0);
    for (int i = 1; i <= 9; ++i) {
      queues.Put(clock, -i, 0);
      queues.Put(Of(1, static_cast<std::uint64_t>(before + i)), before + i, 0);
    }
    const std::vector<int> taken = Taken(&queues);
    std::vector<int> clocks;
    std::copy_if(taken.begin(), taken.end(), std::back_inserter(clocks),
                 [](int i) { return i < 0; });
    EXPECT_EQ(clocks, behind ? (std::vector<int>{-1, -9}) : (std::vector<int>{-1, -8, -9}));
    EXPECT_EQ(taken[static_cast<std::size_t>(before)], -1) << "behind those before it";
    EXPECT_EQ(queues.waiting_bytes(), 0u);
  }
}

TEST(SenderQueues, ADisposalReplacesNoSampleAndIsReplacedByNone) {
  Queues queues({});
  SampleFacts disposal = Of(1, 0);
  disposal.key.disposal = true;
  queues.Put(Of(1, 0), 1, 0);
  queues.Put(disposal, 2, 0);
  queues.Put(Of(1, 0), 3, 0);
  EXPECT_EQ(Taken(&queues), (std::vector<int>{2, 3}));
}

TEST(SenderQueues, AtOnceIsAPartOfWhatWaits) {
  constexpr int kSamples = 1000;
  Queues queues({});
  EXPECT_EQ(queues.AtOnce(), kAtOnceMin);
  for (int i = 0; i < kSamples; ++i) queues.Put(Of(1, static_cast<std::uint64_t>(i)), i, 0);
  EXPECT_EQ(queues.AtOnce(), kSamples * (100 + kSampleOverhead) / kAtOnceShare);
  EXPECT_LE(Taken(&queues, kNoLimit, 0, queues.AtOnce()).size(), kSamples / kAtOnceShare + 1);
  queues.Put(Of(2, 0), kSamples, 0);
  const std::vector<int> next = Taken(&queues, kNoLimit, 0, queues.AtOnce());
  EXPECT_EQ(std::count(next.begin(), next.end(), kSamples), 1) << "it waits for one part only";
}

TEST(SenderQueues, ALargeSampleLeavesTheStepToASmallOneAndComesFirstInTheNext) {
  Queues queues({});
  queues.Put(Of(2, 0, 2 * kAtOnceMin), 20, 0);
  queues.Put(Of(2, 1, 2 * kAtOnceMin), 21, 0);
  EXPECT_EQ(Taken(&queues, kNoLimit, 0, kAtOnceMin), std::vector<int>{20}) << "one in any case";
  queues.Put(Of(1, 0), 10, 0);
  queues.Put(Of(3, 0), 30, 0);
  EXPECT_EQ(Taken(&queues, kNoLimit, 0, kAtOnceMin), (std::vector<int>{30, 10}));
  queues.Put(Of(1, 0), 11, 0);
  queues.Put(Of(3, 0), 31, 0);
  EXPECT_EQ(Taken(&queues, kNoLimit, 0, kAtOnceMin), std::vector<int>{21});
  EXPECT_EQ(Taken(&queues, kNoLimit, 0, kAtOnceMin), (std::vector<int>{31, 11}));
}

TEST(SenderQueues, AFloodTakesNoMoreThanItsShareOfABatch) {
  constexpr int kFlood = 20'000;
  Queues queues({});
  for (int i = 0; i < kFlood; ++i) queues.Put(Of(1, static_cast<std::uint64_t>(i)), i, 0);
  for (std::uint64_t sender = 2; sender <= 4; ++sender) {
    for (std::uint64_t key = 0; key < 50; ++key) queues.Put(Of(sender, key), -1, 0);
  }
  const std::vector<int> batch = Taken(&queues, 1000);
  EXPECT_EQ(batch.size(), 1000u);
  EXPECT_EQ(std::count(batch.begin(), batch.end(), -1), 150);
}

TEST(SenderQueues, ABatchIsBoundedInBytes) {
  constexpr std::size_t kLarge = 49'000, kBatch = 1'000'000;
  Queues queues({});
  for (int i = 0; i < 100; ++i) {
    queues.Put(Of(1 + static_cast<std::uint64_t>(i % 2), static_cast<std::uint64_t>(i), kLarge), i,
               0);
  }
  const std::vector<int> batch = Taken(&queues, kNoLimit, 0, kBatch);
  EXPECT_EQ(batch.size(), kBatch / (kLarge + kSampleOverhead));
  EXPECT_EQ(Taken(&queues).size(), 100 - batch.size());
}

TEST(SenderQueues, WhatExceedsTheRateWaitsAndComesInTime) {
  SenderLimits limits;
  limits.samples_per_second = 1000;
  Queues queues(limits);
  for (int i = 0; i < 2000; ++i) queues.Put(Of(1, static_cast<std::uint64_t>(i)), i, 0);
  queues.Put(Of(2, 0), -1, 0);
  EXPECT_EQ(Taken(&queues).size(), 501u);  // half a second at once, and the other sender
  EXPECT_TRUE(Taken(&queues).empty());
  // Only the first one that waits is worth waking anybody.
  EXPECT_EQ(queues.Put(Of(1, 5000), 0, 0), Outcome::kOverRate);
  const auto wait = queues.UntilReady(0);
  ASSERT_TRUE(wait.has_value());
  EXPECT_GT(*wait, 0);
  EXPECT_FALSE(Taken(&queues, kNoLimit, *wait).empty());
  std::size_t more = 0;
  for (std::int64_t now = kSecond / 10; now <= kSecond; now += kSecond / 10) {
    more += Taken(&queues, kNoLimit, now).size();
  }
  EXPECT_NEAR(static_cast<double>(more), 1000, 2);
  for (std::int64_t now = kSecond; now <= 2 * kSecond; now += kSecond / 10) {
    more += Taken(&queues, kNoLimit, now).size();
  }
  EXPECT_NEAR(static_cast<double>(more), 1500, 2);
  EXPECT_FALSE(queues.UntilReady(3 * kSecond).has_value());
}

TEST(SenderQueues, ASenderFarBehindKeepsTheNewestOfEachKey) {
  constexpr std::uint64_t kKeys = 1000;
  Queues queues({});
  int number = 0;
  for (int round = 0; round < 100; ++round) {
    for (std::uint64_t key = 0; key < kKeys; ++key) queues.Put(Of(1, key, 100, 32), number++, 0);
  }
  const std::vector<int> items = Taken(&queues);
  EXPECT_LE(items.size(), kBehind);
  EXPECT_GE(items.size(), kKeys);
  std::vector<int> newest(kKeys);
  std::iota(newest.begin(), newest.end(), number - static_cast<int>(kKeys));
  EXPECT_TRUE(std::equal(newest.rbegin(), newest.rend(), items.rbegin()));
}

// 65536 agents with descriptions, states in chunks of one, and their removals.
TEST(SenderQueues, TheLargestHonestProgramIsNotRefused) {
  Queues queues({});
  for (std::uint64_t key = 0; key < 65536; ++key) {
    SampleFacts removal = Of(1, key, 20);
    removal.key.disposal = true;
    ASSERT_EQ(queues.Put(Of(1, key, 300), 0, 0), Outcome::kWaits);
    ASSERT_EQ(queues.Put(Of(1, key + 65536, 220, 32), 0, 0), Outcome::kWaits);
    if (key % 4 == 0) {
      ASSERT_EQ(queues.Put(removal, 0, 0), Outcome::kWaits);
    }
  }
}

TEST(SenderQueues, EverNewKeysAreBoundedThenIgnoredForLongerEachTime) {
  SenderLimits limits;
  limits.waiting_bytes_max = 1'000'000;
  Queues queues(limits);
  std::int64_t now = 0;
  std::uint64_t key = 0;
  for (std::int64_t expected = kIgnoredFor; expected <= 4 * kIgnoredFor; expected *= 2) {
    std::size_t refused = 0;
    for (Outcome outcome = Outcome::kWaits; outcome != Outcome::kIgnoredFromNow; ++key) {
      outcome = queues.Put(Of(1, key), 0, now);
      ASSERT_LE(queues.waiting_bytes(), limits.waiting_bytes_max);
      ASSERT_NE(outcome, Outcome::kIgnored);
      refused += outcome == Outcome::kRefused ? 1u : 0u;
    }
    EXPECT_EQ(refused, kRefusedMax);
    EXPECT_EQ(queues.waiting_bytes(), 0u);
    EXPECT_EQ(queues.IgnoredFor(1, now), expected);
    EXPECT_EQ(queues.Put(Of(1, key), 0, now + expected - 1), Outcome::kIgnored);
    EXPECT_EQ(queues.Put(Of(2, 0), 7, now), Outcome::kWaits);
    EXPECT_EQ(Taken(&queues, kNoLimit, now), std::vector<int>{7});
    now += expected;
  }
  EXPECT_EQ(queues.Put(Of(1, key), 0, now), Outcome::kWaits);
}

TEST(SenderQueues, WhereOneFillsTheMemoryAnotherHasItsShare) {
  SenderLimits limits;
  limits.waiting_bytes_max = 1'000'000;
  Queues queues(limits);
  std::uint64_t key = 0;
  while (queues.Put(Of(1, key++), 0, 0) == Outcome::kWaits) {
  }
  std::size_t kept = 0;
  while (queues.Put(Of(2, key++), 0, 0) == Outcome::kWaits) ++kept;
  EXPECT_GE((kept + 1) * (100 + kSampleOverhead), limits.waiting_bytes_max / 2);
  EXPECT_LE(queues.waiting_bytes(), limits.waiting_bytes_max);
}

// One after the other, which is the worst: each finds the memory full.
TEST(SenderQueues, ManySendersTogetherFillNoMoreThanOne) {
  constexpr std::uint64_t kSenders = 20, kSamples = 1000;
  SenderLimits limits;
  limits.waiting_bytes_max = 600'000;
  Queues queues(limits);
  for (std::uint64_t sender = 0; sender < kSenders; ++sender) {
    for (std::uint64_t key = 0; key < kSamples; ++key) {
      queues.Put(Of(sender, key), static_cast<int>(sender), 0);
      ASSERT_LE(queues.waiting_bytes(), limits.waiting_bytes_max);
    }
  }
  const std::vector<int> items = Taken(&queues);
  EXPECT_EQ(items.size() + queues.refused(), kSenders * kSamples);
  const auto share = static_cast<double>(items.size()) / kSenders;
  for (std::uint64_t sender = 0; sender < kSenders; ++sender) {
    const auto kept = std::count(items.begin(), items.end(), static_cast<int>(sender));
    EXPECT_NEAR(static_cast<double>(kept), share, 2);
  }
}

// What a sender writes of one key again and again wakes nobody again.
TEST(SenderQueues, OfOneKeyTooOnlyTheFirstThatWaitsIsWorthWakingAnybody) {
  SenderLimits limits;
  limits.samples_per_second = 100;
  Queues queues(limits);
  for (std::uint64_t key = 0; key < 50; ++key) queues.Put(Of(1, key), 0, 0);
  EXPECT_EQ(Taken(&queues).size(), 50u);
  EXPECT_EQ(queues.Put(Of(1, 7), 1, 0), Outcome::kWaits);
  EXPECT_EQ(queues.Put(Of(1, 7), 2, 0), Outcome::kOverRate);
  EXPECT_EQ(Taken(&queues, kNoLimit, kSecond), std::vector<int>{2});
}

// Goal:   what a flood loses is told by sender, of nobody else, and for a minute after it is over.
TEST(SenderQueues, TellWhatASenderLosesAndForHowLongItIsIgnored) {
  Queues queues({.waiting_bytes_max = 100 * (100 + kSampleOverhead)});
  std::int64_t now_ns = 0;
  queues.Put(Of(2, 0), -1, now_ns);
  std::uint64_t key = 0;
  while (queues.Put(Of(1, key++), 0, now_ns) != Outcome::kIgnoredFromNow) {
  }
  std::vector<SenderLoss> losses = queues.Losses(now_ns);
  ASSERT_EQ(losses.size(), 1u);
  EXPECT_EQ(losses[0].sender, 1u);
  EXPECT_EQ(losses[0].dropped, key) << "all that it wrote";
  EXPECT_EQ(losses[0].waiting, 0u);
  EXPECT_EQ(losses[0].ignored_for_ns, kIgnoredFor);
  now_ns += kSecond;
  queues.Put(Of(1, key), 0, now_ns);
  losses = queues.Losses(now_ns);
  EXPECT_EQ(losses[0].dropped, key + 1);
  EXPECT_EQ(losses[0].ignored_for_ns, kIgnoredFor - kSecond);
  now_ns += kLossToldFor;
  Taken(&queues, kNoLimit, now_ns);
  EXPECT_EQ(queues.Losses(now_ns).size(), 1u);
  EXPECT_TRUE(queues.Losses(now_ns + 1).empty());
}

// Goal:   the one that gives way for others has lost something, too; one of which much waits is
//         told before it loses anything; what is counted begins anew after a minute.
TEST(SenderQueues, TellOfThoseThatGiveWayAndOfThoseThatAreBehind) {
  Queues queues({.waiting_bytes_max = 100 * (100 + kSampleOverhead)});
  for (std::uint64_t key = 0; key < 100; ++key) queues.Put(Of(1, key), 0, 0);
  ASSERT_EQ(queues.Losses(0).size(), 1u) << "a quarter of all waits";
  EXPECT_EQ(queues.Losses(0)[0].dropped, 0u);
  EXPECT_EQ(queues.Losses(0)[0].waiting, 100u);
  queues.Put(Of(2, 0), 0, 0);
  EXPECT_EQ(queues.Losses(0)[0].dropped, 1u);
  const std::int64_t later_ns = kLossToldFor + 1;
  for (std::uint64_t key = 0; key < 3; ++key) queues.Put(Of(3, key), 0, later_ns);
  EXPECT_EQ(queues.Losses(later_ns)[0].dropped, 3u);
}

}  // namespace
}  // namespace collision::dds
