// Goal:   one of the services in a world stays, whatever they hear of each other and when.
// Method: single rules by hand; any number of services in service_claims_test.cc.
#include "server/claim/service_claim.h"

#include <gtest/gtest.h>

#include <limits>

namespace collision::server {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::uint32_t kTermMax = std::numeric_limits<std::uint32_t>::max();

ClaimOptions Options(std::uint64_t instance, std::uint32_t term_before = 0) {
  return {.instance = instance,
          .term_before = term_before,
          .wait_ns = kSecond,
          .heard_for_ns = 2 * kSecond};
}

ServiceClaim Serving(std::uint64_t instance, std::uint32_t term_before = 0) {
  ServiceClaim claim(Options(instance, term_before));
  claim.Update(0);
  claim.Update(kSecond);
  claim.SetFollowed(true);
  EXPECT_EQ(claim.phase(), ClaimPhase::kServing);
  return claim;
}

TEST(ServiceClaim, AloneItServesAfterTheWaitInTheTermAfterTheJournals) {
  ServiceClaim claim(Options(5, 7));
  claim.Update(3 * kSecond);
  EXPECT_EQ(claim.phase(), ClaimPhase::kClaiming);
  EXPECT_EQ(claim.NextDue(), 4 * kSecond);
  claim.Update(4 * kSecond - 1);
  EXPECT_EQ(claim.phase(), ClaimPhase::kClaiming);
  EXPECT_EQ(claim.term(), 0u);
  claim.Update(4 * kSecond);
  EXPECT_EQ(claim.phase(), ClaimPhase::kServing);
  EXPECT_EQ(claim.term(), 8u);
  EXPECT_EQ(claim.NextDue(), std::nullopt);
}

TEST(ServiceClaim, BesideALiveServiceItEndsAndNamesIt) {
  ServiceClaim claim(Options(5));
  claim.Update(0);
  claim.Hear({.instance = 0xab, .term = 3, .phase = OtherPhase::kServing, .sequence = 9},
             kSecond / 2);
  claim.Update(kSecond / 2);
  EXPECT_EQ(claim.phase(), ClaimPhase::kYielded);
  EXPECT_EQ(claim.why(), "service 00000000000000ab, term 3 serves this world");
}

TEST(ServiceClaim, OfTwoThatStartTogetherTheLowerInstanceGoesOn) {
  ServiceClaim low(Options(5)), high(Options(6));
  for (ServiceClaim* claim : {&low, &high}) claim->Update(0);
  low.Hear({.instance = 6, .sequence = 1}, 1);
  high.Hear({.instance = 5, .sequence = 1}, 1);
  for (ServiceClaim* claim : {&low, &high}) claim->Update(kSecond);
  EXPECT_EQ(low.phase(), ClaimPhase::kServing);
  EXPECT_EQ(high.phase(), ClaimPhase::kYielded);
}

ClaimOptions Standby(std::uint64_t instance) {
  ClaimOptions options = Options(instance);
  options.stands_by = true;
  options.waking_ns = kSecond / 10;
  return options;
}

HeardService Heard(std::uint64_t instance, OtherPhase phase, std::uint32_t term,
                   std::uint64_t sequence) {
  return {.instance = instance, .term = term, .phase = phase, .sequence = sequence};
}

/// Stands by for service 1, which serves in term 3.
ServiceClaim StandingBy(std::uint64_t instance) {
  ServiceClaim claim(Standby(instance));
  claim.Update(0);
  claim.Hear(Heard(1, OtherPhase::kServing, 3, 1), 1);
  claim.Update(1);
  EXPECT_EQ(claim.phase(), ClaimPhase::kStandby);
  return claim;
}

TEST(ServiceClaim, AStandbyTakesOverOnceTheServiceIsGone) {
  ServiceClaim claim = StandingBy(5);
  // However long no status of it comes: the network says when it is gone.
  claim.Update(100 * kSecond);
  EXPECT_EQ(claim.phase(), ClaimPhase::kStandby);
  EXPECT_TRUE(claim.works());
  claim.HearEnd(1);
  claim.Update(100 * kSecond);
  EXPECT_EQ(claim.phase(), ClaimPhase::kServing);
  EXPECT_EQ(claim.term(), 4u);
  EXPECT_TRUE(claim.IsContended(101 * kSecond));
  EXPECT_FALSE(claim.IsContended(161 * kSecond));
}

TEST(ServiceClaim, OfTwoStandbysTheOneThatCameInTheLowerTermTakesOver) {
  ServiceClaim junior = StandingBy(2), senior = StandingBy(9);
  junior.Hear(Heard(9, OtherPhase::kStandby, 2, 1), 2);
  senior.Hear(Heard(2, OtherPhase::kStandby, 4, 1), 2);
  for (ServiceClaim* claim : {&junior, &senior}) {
    claim->HearEnd(1);
    claim->Update(3);
  }
  EXPECT_EQ(senior.phase(), ClaimPhase::kServing);
  EXPECT_EQ(junior.phase(), ClaimPhase::kStandby);
  // It does if the other one has not.
  EXPECT_EQ(junior.NextDue(), 3 + 2 * kSecond);
  junior.Update(3 + 2 * kSecond);
  EXPECT_EQ(junior.phase(), ClaimPhase::kServing);
}

TEST(ServiceClaim, OneThatStoodStillWhileItClaimedListensAnew) {
  ServiceClaim claim(Options(5));
  claim.Update(0);
  claim.WakeUp(2 * kSecond, 2 * kSecond);
  ServiceClaim late = claim;
  late.Update(2 * kSecond);
  EXPECT_EQ(late.phase(), ClaimPhase::kServing) << "a step that waits may end late";
  claim.WakeUp(2 * kSecond + 1, 3 * kSecond);
  claim.Update(3 * kSecond);
  EXPECT_EQ(claim.phase(), ClaimPhase::kClaiming);
  claim.Hear(Heard(7, OtherPhase::kServing, 1, 1), 3 * kSecond + 1);
  claim.Update(3 * kSecond + 1);
  EXPECT_EQ(claim.phase(), ClaimPhase::kYielded);
}

TEST(ServiceClaim, OneThatIsAlwaysSlowServesAllTheSame) {
  ServiceClaim claim(Options(5));
  claim.Update(0);
  int steps = 0;
  for (; claim.phase() == ClaimPhase::kClaiming && steps < 100; ++steps) {
    claim.WakeUp(9 * kSecond, (steps + 1) * 9 * kSecond);
    claim.Update((steps + 1) * 9 * kSecond);
  }
  EXPECT_EQ(steps, kListensAnewMax + 1);
}

TEST(ServiceClaim, OneThatStoodStillListensFirstAndYieldsToOneSample) {
  ServiceClaim claim = Serving(5);
  claim.WakeUp(9 * kSecond, 10 * kSecond);
  EXPECT_EQ(claim.phase(), ClaimPhase::kServing) << "without a standby nobody takes over";
  claim.Hear(Heard(7, OtherPhase::kStandby, 1, 1), kSecond);
  claim.WakeUp(kSecond / 2, 10 * kSecond);
  EXPECT_EQ(claim.phase(), ClaimPhase::kWaking);
  ServiceClaim beside(Standby(5));
  beside.Update(0);
  beside.Update(kSecond);
  beside.WakeUp(kSecond / 20, 5 * kSecond);
  EXPECT_EQ(beside.phase(), ClaimPhase::kServing);
  beside.WakeUp(kSecond / 20 + 1, 5 * kSecond);
  beside.Update(5 * kSecond);
  EXPECT_EQ(beside.phase(), ClaimPhase::kWaking);
  EXPECT_FALSE(beside.works());
  ServiceClaim alone = beside;
  alone.Update(5 * kSecond + kSecond / 10);
  EXPECT_EQ(alone.phase(), ClaimPhase::kServing);
  EXPECT_EQ(alone.term(), 1u) << "nobody has taken over, so its promises hold";
  beside.Hear(Heard(7, OtherPhase::kServing, 2, 9), 5 * kSecond + 1);
  beside.Update(5 * kSecond + 1);
  EXPECT_EQ(beside.phase(), ClaimPhase::kYielded) << "what it knows of the world is old";
}

TEST(ServiceClaim, OfTwoThatServeTheOneThatSimulatorsFollowStays) {
  ServiceClaim followed = Serving(5, 3), lonely = Serving(6, 4);
  lonely.SetFollowed(false);
  for (const std::uint64_t sequence : {1, 2}) {
    HeardService heard = Heard(6, OtherPhase::kServing, lonely.term(), sequence);
    heard.followed = false;
    followed.Hear(heard, 2 * kSecond);
    lonely.Hear(Heard(5, OtherPhase::kServing, followed.term(), sequence), 2 * kSecond);
  }
  for (ServiceClaim* claim : {&followed, &lonely}) claim->Update(2 * kSecond);
  EXPECT_LT(followed.term(), lonely.term());
  EXPECT_EQ(followed.phase(), ClaimPhase::kServing);
  EXPECT_EQ(lonely.phase(), ClaimPhase::kYielded);
}

TEST(ServiceClaim, AStandbyThatHasHeardNothingForLongStartsAfresh) {
  ServiceClaim claim = StandingBy(5);
  ServiceClaim stale = claim;
  claim.WakeUp(kStaleAfterNs, 20 * kSecond);
  EXPECT_EQ(claim.phase(), ClaimPhase::kStandby);
  stale.WakeUp(kStaleAfterNs + 1, 20 * kSecond);
  EXPECT_EQ(stale.phase(), ClaimPhase::kYielded);
  EXPECT_EQ(stale.why(), "stood still for 10.0 s while it stood by");
}

TEST(ServiceClaim, AStandbyThatStoodStillListensBeforeItTakesOver) {
  ServiceClaim claim = StandingBy(5);
  EXPECT_EQ(claim.standstill_ns(), kSecond / 20);
  // While it heard nothing, the lease of the other one seems to have ended.
  claim.WakeUp(2 * kSecond, 9 * kSecond);
  claim.HearEnd(1);
  claim.Update(9 * kSecond);
  EXPECT_EQ(claim.phase(), ClaimPhase::kStandby);
  constexpr std::int64_t kListens = 3 * kSecond / 20;
  EXPECT_EQ(claim.NextDue(), 9 * kSecond + kListens);
  ServiceClaim alone = claim;
  alone.Update(9 * kSecond + kListens - 1);
  EXPECT_EQ(alone.phase(), ClaimPhase::kStandby) << "the other one may have stood still, too";
  alone.Update(9 * kSecond + kListens);
  EXPECT_EQ(alone.phase(), ClaimPhase::kServing) << "the other one has really ended";
  claim.Hear(Heard(1, OtherPhase::kServing, 3, 1), 9 * kSecond + 1);
  claim.Update(20 * kSecond);
  EXPECT_EQ(claim.phase(), ClaimPhase::kStandby) << "the other one is back, with its last status";
  claim.HearEnd(1);
  claim.Update(20 * kSecond + 1);
  EXPECT_EQ(claim.phase(), ClaimPhase::kServing) << "it has listened long ago";
}

// Goal:   a machine that is too slow for its lease makes a service late, not silent: neither one
//         that stands by, nor then as it serves, nor one that has served.
TEST(ServiceClaim, OneWhoseEveryStepTakesLongTakesOverAndServes) {
  constexpr std::int64_t kLong = kSecond / 10;
  ServiceClaim standby = StandingBy(5), serving(Standby(6));
  for (const std::int64_t now_ns : {std::int64_t{0}, kSecond}) serving.Update(now_ns);
  std::int64_t now_ns = 9 * kSecond;
  standby.HearEnd(1);
  std::vector<std::int64_t> not_served_ns{0, 0};
  for (; now_ns < 19 * kSecond; now_ns += kLong) {
    for (ServiceClaim* claim : {&standby, &serving}) {
      claim->WakeUp(kLong, now_ns);
      claim->Update(now_ns);
      if (claim->phase() != ClaimPhase::kServing) not_served_ns[claim == &serving] += kLong;
    }
  }
  for (const std::int64_t ns : not_served_ns) {
    EXPECT_GE(ns, kSecond) << "it listens first";
    EXPECT_LE(ns, 3 * kSecond);
  }
  serving.WakeUp(2 * kSecond, now_ns - kLong + 2 * kSecond);
  EXPECT_EQ(serving.phase(), ClaimPhase::kWaking) << "that was no step";
}

TEST(ServiceClaim, AStandbyThatDoesNotFitNeverTakesOver) {
  ServiceClaim claim = StandingBy(5);
  claim.SetFits(false);
  claim.HearEnd(1);
  claim.Update(9 * kSecond);
  claim.Update(99 * kSecond);
  EXPECT_EQ(claim.phase(), ClaimPhase::kStandby);
  EXPECT_EQ(claim.NextDue(), std::nullopt);
}

TEST(ServiceClaim, AStandbyWaitsForOneThatIsStartingOnlyIfItStandsByForThatOne) {
  ServiceClaim claim = StandingBy(5);
  claim.Hear({.instance = 2, .sequence = 1}, 9 * kSecond);
  claim.HearEnd(1);
  claim.Update(9 * kSecond);
  EXPECT_EQ(claim.phase(), ClaimPhase::kServing);
  ServiceClaim starting(Standby(5));
  starting.Update(0);
  starting.Hear({.instance = 2, .sequence = 1}, 1);
  for (const std::int64_t now_ns : {kSecond / 2, kSecond}) {
    starting.Update(now_ns);
    EXPECT_EQ(starting.phase(), ClaimPhase::kStandby) << "that one is about to serve";
  }
}

TEST(ServiceClaim, AServiceThatListensDoesNotBeginToSpeak) {
  ServiceClaim claim = StandingBy(5);
  claim.HearEnd(1);
  claim.Update(9 * kSecond);
  ASSERT_EQ(claim.phase(), ClaimPhase::kServing);
  claim.HearClock(5, claim.term());
  claim.WakeUp(kSecond, 10 * kSecond);
  ASSERT_EQ(claim.phase(), ClaimPhase::kWaking);
  EXPECT_FALSE(claim.BeginsToSpeak());
  claim.Update(11 * kSecond);
  EXPECT_TRUE(claim.BeginsToSpeak());
}

TEST(ServiceClaim, ItsOwnStatusIsNoOtherService) {
  ServiceClaim claim(Options(5));
  claim.Update(0);
  claim.Hear({.instance = 5, .term = 9, .phase = OtherPhase::kServing, .sequence = 1}, 1);
  claim.Update(kSecond);
  EXPECT_EQ(claim.phase(), ClaimPhase::kServing);
  EXPECT_EQ(claim.term(), 1u);
}

TEST(ServiceClaim, ATermHeardOfOneThatHasDiedCounts) {
  ServiceClaim claim({.instance = 5, .wait_ns = 5 * kSecond, .heard_for_ns = kSecond});
  claim.Hear({.instance = 1, .term = 41, .phase = OtherPhase::kServing, .sequence = 1}, 0);
  claim.Update(2 * kSecond);
  claim.Update(7 * kSecond);
  EXPECT_EQ(claim.phase(), ClaimPhase::kServing);
  EXPECT_EQ(claim.term(), 42u);
}

// Of one that stands still nothing is heard. Its clients are, and when it is back it ends.
TEST(ServiceClaim, ATermThatSimulatorsFollowCountsUnlessItIsTheGreatest) {
  ServiceClaim former = Serving(1);
  ServiceClaim claim(Options(5));
  claim.Update(0);
  claim.HearClock(1, former.term());
  claim.HearClock(1, kTermMax);
  claim.Update(kSecond);
  EXPECT_EQ(claim.phase(), ClaimPhase::kServing);
  EXPECT_EQ(claim.term(), former.term() + 1);
  for (const std::uint64_t sequence : {1u, 2u}) {
    former.Hear(
        {.instance = 5, .term = claim.term(), .phase = OtherPhase::kServing, .sequence = sequence},
        2 * kSecond);
  }
  former.Update(2 * kSecond);
  EXPECT_EQ(former.phase(), ClaimPhase::kYielded);
}

// Its status may come more rarely than others fall silent; the network tells when it has ended.
TEST(ServiceClaim, AStandbyForgetsNoServiceThatServesWhenAnotherOneStarts) {
  ClaimOptions options = Options(5);
  options.stands_by = true;
  ServiceClaim claim(options);
  claim.Update(0);
  claim.Hear({.instance = 1, .term = 3, .phase = OtherPhase::kServing, .sequence = 1}, 0);
  claim.Update(0);
  ASSERT_EQ(claim.phase(), ClaimPhase::kStandby);
  claim.Hear({.instance = 9, .term = 3, .phase = OtherPhase::kStandby, .sequence = 1},
             10 * kSecond);
  claim.Update(10 * kSecond);
  EXPECT_EQ(claim.phase(), ClaimPhase::kStandby);
  claim.HearEnd(1);
  claim.Update(10 * kSecond);
  EXPECT_EQ(claim.phase(), ClaimPhase::kServing);
}

TEST(ServiceClaim, AnImplausibleTermOfASimulatorDoesNotCount) {
  ServiceClaim claim(Options(5, 7));
  claim.HearClock(1, 7 + kTermLeapMax + 1);
  claim.Update(0);
  claim.Update(kSecond);
  EXPECT_EQ(claim.term(), 8u);
  ServiceClaim other(Options(5, 7));
  other.HearClock(1, 7 + kTermLeapMax);
  other.Update(0);
  other.Update(kSecond);
  EXPECT_EQ(other.term(), 8 + kTermLeapMax);
}

// What the other one has written last may still be on its way.
TEST(ServiceClaim, TheWorldIsContendedThoughTheOtherServiceHasEnded) {
  ServiceClaim claim = Serving(5);
  EXPECT_FALSE(claim.IsContended(kSecond));
  claim.Hear({.instance = 9, .term = 1, .phase = OtherPhase::kServing, .sequence = 1}, 2 * kSecond);
  claim.HearEnd(9);
  EXPECT_TRUE(claim.IsContended(2 * kSecond + kContendedForNs));
  EXPECT_FALSE(claim.IsContended(2 * kSecond + kContendedForNs + 1));
}

TEST(ServiceClaim, TheWorldIsContendedForAWhileAfterAnotherServiceWasHeard) {
  ServiceClaim claim = Serving(1);
  EXPECT_FALSE(claim.IsContended(kSecond));
  claim.Hear({.instance = 5, .term = 1, .phase = OtherPhase::kClaiming, .sequence = 1}, kSecond);
  EXPECT_FALSE(claim.IsContended(kSecond)) << "it publishes nothing but its claim";
  claim.Hear({.instance = 5, .term = 1, .phase = OtherPhase::kServing, .sequence = 2}, kSecond);
  EXPECT_TRUE(claim.IsContended(kSecond + kContendedForNs));
  EXPECT_FALSE(claim.IsContended(kSecond + kContendedForNs + 1));
}

TEST(ServiceClaim, TheGreatestTermIsNotExceeded) {
  EXPECT_EQ(Serving(5, kTermMax).term(), kTermMax);
  EXPECT_EQ(Serving(5, kTermMax - 1).term(), kTermMax);
}

TEST(ServiceClaim, WhoServesYieldsToAHigherTermOnlyWhenItIsHeardTwice) {
  ServiceClaim claim = Serving(5);
  claim.Hear({.instance = 6, .term = kTermMax, .phase = OtherPhase::kServing, .sequence = 1},
             2 * kSecond);
  claim.Hear({.instance = 6, .term = kTermMax, .phase = OtherPhase::kServing, .sequence = 1},
             2 * kSecond);
  claim.Update(2 * kSecond);
  EXPECT_EQ(claim.phase(), ClaimPhase::kServing) << "one sample, although it came twice";
  EXPECT_EQ(claim.Conflicts(2 * kSecond).size(), 1u);
  claim.Hear({.instance = 6, .term = kTermMax, .phase = OtherPhase::kServing, .sequence = 2},
             3 * kSecond);
  claim.Update(3 * kSecond);
  EXPECT_EQ(claim.phase(), ClaimPhase::kYielded);
}

TEST(ServiceClaim, WhoServesStaysBesideALowerTermAndANewcomer) {
  ServiceClaim claim = Serving(5, 3);
  for (std::uint64_t sequence : {1, 2, 3}) {
    claim.Hear({.instance = 1, .term = 3, .phase = OtherPhase::kServing, .sequence = sequence},
               2 * kSecond);
    claim.Hear({.instance = 2, .term = 0, .phase = OtherPhase::kClaiming, .sequence = sequence},
               2 * kSecond);
  }
  claim.Update(2 * kSecond);
  EXPECT_EQ(claim.phase(), ClaimPhase::kServing);
  const std::vector<std::string> conflicts = claim.Conflicts(2 * kSecond);
  ASSERT_EQ(conflicts.size(), 1u);
  EXPECT_EQ(conflicts[0], "service 0000000000000001, term 3 publishes in this world beside term 4");
  EXPECT_TRUE(claim.Conflicts(5 * kSecond).empty()) << "not heard of for longer than its lease";
}

TEST(ServiceClaim, EverNewInstancesFillNothing) {
  ServiceClaim claim = Serving(5, 100);
  for (std::uint64_t instance = 1000; instance < 11'000; ++instance) {
    claim.Hear({.instance = instance, .term = 1, .phase = OtherPhase::kServing, .sequence = 1},
               2 * kSecond);
  }
  EXPECT_EQ(claim.Conflicts(2 * kSecond).size(), kOthersMax);
  claim.Hear({.instance = 1, .term = 200, .phase = OtherPhase::kServing, .sequence = 1},
             5 * kSecond);
  claim.Hear({.instance = 1, .term = 200, .phase = OtherPhase::kServing, .sequence = 2},
             5 * kSecond);
  claim.Update(5 * kSecond);
  EXPECT_EQ(claim.phase(), ClaimPhase::kYielded) << "the flood is forgotten after its lease";
}

}  // namespace
}  // namespace collision::server
