// Goal:   the offset of a sender's clock is bracketed for certain, whatever the ways there and back
//         take; a sender is refused exactly if it is certainly beyond the bound, and taken again.
// Method: round trips of a sender whose true offset the test knows, by hand and drawn from a seed.
#include "server/world/wall_clock/sender_clock.h"

#include <gtest/gtest.h>

#include "tests/support/random.h"

namespace collision::server {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::int64_t kMillisecond = 1'000'000;
constexpr std::int64_t kSkew = 2 * kMillisecond;
constexpr std::int64_t kStart = 1'700'000'000 * kSecond;

Instant At(std::int64_t ns) { return Instant::FromNanoseconds(kStart + ns); }

/// A trip of a sender with this offset that asks at `at_ns` and takes so long there, at the sender,
/// and back.
RoundTrip Trip(std::int64_t offset_ns, std::int64_t at_ns, std::int64_t there_ns,
               std::int64_t pause_ns, std::int64_t back_ns) {
  return {.asked = At(at_ns),
          .heard = At(at_ns + there_ns + offset_ns),
          .answered = At(at_ns + there_ns + pause_ns + offset_ns),
          .arrived = At(at_ns + there_ns + pause_ns + back_ns)};
}

/// The answer to such a trip by a sender that has heard nothing.
RoundTrip Unasked(RoundTrip trip) {
  trip.asked.reset();
  return trip;
}

TEST(ClockOffset, NothingIsKnownBeforeTheFirstTrip) {
  EXPECT_EQ(ClockOffset().At(kSecond), OffsetBracket());
}

TEST(ClockOffset, ATripWithoutDelaysIsExact) {
  ClockOffset offset;
  offset.Take(Trip(3 * kMillisecond, 0, 0, 0, 0), 0);
  EXPECT_EQ(offset.At(0), (OffsetBracket{3 * kMillisecond, 3 * kMillisecond}));
}

TEST(ClockOffset, EachWayWidensItsOwnEndAndThePauseOnlyByTheDrift) {
  ClockOffset offset;
  offset.Take(Trip(0, 0, 7 * kMillisecond, 92 * kMillisecond, kMillisecond), 0);
  EXPECT_EQ(offset.At(0), (OffsetBracket{-kMillisecond, 7 * kMillisecond + 100'000}));
}

TEST(ClockOffset, WithoutAnEchoOnlyTheLowerEndIsKnown) {
  ClockOffset offset;
  offset.Take(Unasked(Trip(5 * kSecond, 0, 0, 0, kMillisecond)), 0);
  EXPECT_EQ(offset.At(0).lower_ns, 5 * kSecond - kMillisecond);
  EXPECT_FALSE(offset.At(0).has_upper());
}

TEST(ClockOffset, TheBestOfEachSideIsKeptAndWidensByTheDrift) {
  ClockOffset offset;
  constexpr std::int64_t kTrip = 10'000;  // what drifts apart in 10 ms
  offset.Take(Trip(0, 0, kMillisecond, 0, 9 * kMillisecond), 0);
  offset.Take(Trip(0, 0, 9 * kMillisecond, 0, kMillisecond), kSecond);
  EXPECT_EQ(offset.At(kSecond), (OffsetBracket{-kMillisecond, 2 * kMillisecond + kTrip}));
  EXPECT_EQ(offset.At(3 * kSecond), (OffsetBracket{-3 * kMillisecond, 4 * kMillisecond + kTrip}));
}

TEST(ClockOffset, WhenTheSendersClockWasSetOnlyTheNewTripCounts) {
  ClockOffset offset;
  offset.Take(Trip(0, 0, kMillisecond, 0, kMillisecond), 0);
  offset.Take(Trip(-5 * kSecond, 0, kMillisecond, 0, 2 * kMillisecond), 0);
  EXPECT_EQ(offset.At(0),
            (OffsetBracket{-5 * kSecond - 2 * kMillisecond, -5 * kSecond + kMillisecond + 3000}));
  // Set between hearing and answering: only the answer is of the new time.
  RoundTrip torn = Trip(-5 * kSecond, 0, kMillisecond, kMillisecond, kMillisecond);
  torn.answered = At(2 * kMillisecond);
  offset.Take(torn, 0);
  EXPECT_EQ(offset.At(0).lower_ns, -kMillisecond);
  EXPECT_FALSE(offset.At(0).has_upper());
}

// Clocks that drift as fast as they may, ways of any length: the truth is always inside, and the
// bracket is not wider than the best of a few trips.
TEST(ClockOffset, HoldsTheTruthOfADriftingClock) {
  Random random(11);
  for (int run = 0; run < 100; ++run) {
    ClockOffset offset;
    const double start = random.Uniform(-5e9, 5e9);
    const double drift = random.Uniform(-1e-3, 1e-3);
    const auto truth = [&](std::int64_t at_ns) {
      return static_cast<std::int64_t>(start + drift * static_cast<double>(at_ns));
    };
    std::int64_t at_ns = 0;
    for (int trip = 0; trip < 200; ++trip) {
      at_ns += static_cast<std::int64_t>(random.Uniform(1e6, 1e8));
      const auto there = static_cast<std::int64_t>(random.Uniform(0, 2e7));
      const auto back = static_cast<std::int64_t>(random.Uniform(0, 2e7));
      const std::int64_t heard = at_ns + there, arrived = heard + back;
      offset.Take({.asked = At(at_ns),
                   .heard = At(heard + truth(heard)),
                   .answered = At(heard + truth(heard)),
                   .arrived = At(arrived)},
                  arrived);
      const OffsetBracket bracket = offset.At(arrived);
      // The clocks are rounded to whole nanoseconds.
      EXPECT_LE(bracket.lower_ns, truth(arrived) + 1) << run << " " << trip;
      EXPECT_GE(bracket.upper_ns, truth(arrived) - 1) << run << " " << trip;
      if (trip > 50) {
        EXPECT_LT(bracket.upper_ns - bracket.lower_ns, 20 * kMillisecond);
      }
    }
  }
}

TEST(SenderClock, ASenderNearTheBoundIsTaken) {
  SenderClock clock;
  for (int i = 0; i < 100; ++i) {
    EXPECT_EQ(clock.Take(Trip(kSkew * 9 / 10, i * kSecond, 1000, 0, 1000), i * kSecond, kSkew),
              SenderVerdict::kUnchanged);
  }
  EXPECT_FALSE(clock.refused());
  EXPECT_EQ(clock.within_until(), At(99 * kSecond));
}

TEST(SenderClock, ASenderBeyondTheBoundIsRefusedOnEitherSide) {
  for (const std::int64_t offset_ns : {-5 * kSecond, 5 * kSecond, kSkew + 2000, -kSkew - 2000}) {
    SenderClock clock;
    EXPECT_EQ(clock.Take(Trip(offset_ns, 0, 1000, 0, 1000), 0, kSkew), SenderVerdict::kRefused);
    EXPECT_EQ(clock.Take(Trip(offset_ns, 0, 1000, 0, 1000), 0, kSkew), SenderVerdict::kUnchanged);
    EXPECT_TRUE(clock.refused());
    EXPECT_EQ(clock.within_until(), Instant::Always());
  }
}

TEST(SenderClock, DoubtIsNoReasonToRefuse) {
  SenderClock clock;
  // A way of 10 ms there, or an offset of 10 ms: nothing tells which.
  clock.Take(Trip(0, 0, 10 * kMillisecond, 0, 10 * kMillisecond), 0, kSkew);
  EXPECT_FALSE(clock.refused());
  EXPECT_EQ(clock.within_until(), Instant::Always()) << "but it is not certain to be within";
}

TEST(SenderClock, AWayThatTakesLongInOneDirectionAccusesNobody) {
  SenderClock clock;
  for (int i = 0; i < 100; ++i) {
    clock.Take(Trip(0, i * kSecond, 300 * kMillisecond, 0, 1000), i * kSecond, kSkew);
    clock.Take(Trip(0, i * kSecond, 1000, 0, 300 * kMillisecond), i * kSecond, kSkew);
    EXPECT_FALSE(clock.refused());
  }
}

TEST(SenderClock, IsTakenAgainOnceItsClockWasSetRight) {
  SenderClock clock;
  clock.Take(Trip(0, 0, 1000, 0, 1000), 0, kSkew);
  EXPECT_EQ(clock.Take(Trip(-kSecond, kSecond, 1000, 0, 1000), kSecond, kSkew),
            SenderVerdict::kRefused);
  EXPECT_EQ(clock.within_until(), At(0));
  EXPECT_EQ(clock.Take(Trip(0, 2 * kSecond, 1000, 0, 1000), 2 * kSecond, kSkew),
            SenderVerdict::kTaken);
  EXPECT_FALSE(clock.refused());
  EXPECT_EQ(clock.within_until(), At(2 * kSecond));
}

TEST(SenderClock, BackFromBeyondByAHairItStaysRefusedUntilItIsWellWithin) {
  SenderClock clock;
  clock.Take(Trip(kSkew + 10'000, 0, 1000, 0, 1000), 0, kSkew);
  ASSERT_TRUE(clock.refused());
  clock.Take(Trip(kSkew - 10'000, 0, 1000, 0, 1000), 0, kSkew);
  EXPECT_TRUE(clock.refused());
  clock.Take(Trip(kSkew / 2, 0, 1000, 0, 1000), 0, kSkew);
  EXPECT_FALSE(clock.refused());
}

TEST(SenderClock, OneThatWasBehindIsNotTakenBackForSayingLess) {
  SenderClock clock;
  clock.Take(Trip(-kSecond, 0, 1000, 0, 1000), 0, kSkew);
  clock.Forget();
  clock.Take(Unasked(Trip(-kSecond, 0, 1000, 0, 1000)), 0, kSkew);
  EXPECT_TRUE(clock.refused());
  clock.Take(Trip(0, 0, 1000, 0, 1000), 0, kSkew);
  EXPECT_FALSE(clock.refused());
}

TEST(OffsetText, SaysWhichWayAndHowFar) {
  EXPECT_EQ(OffsetText({}), "not known");
  EXPECT_EQ(OffsetText({1'200'000, 3'400'000}), "1.200 to 3.400 ms ahead");
  EXPECT_EQ(OffsetText({-3'400'000, -1'200'000}), "1.200 to 3.400 ms behind");
  EXPECT_EQ(OffsetText({-200'000, 400'000}), "0.200 ms behind to 0.400 ms ahead");
  EXPECT_EQ(OffsetText({.lower_ns = 5'000'000}), "at least 5.000 ms ahead");
  EXPECT_EQ(OffsetText({.lower_ns = -5'000'000}), "at most 5.000 ms behind");
}

TEST(SufficientSkew, AdmitsTheWholeBracketInWholeMilliseconds) {
  EXPECT_DOUBLE_EQ(SufficientSkew({-5'000'200'000, -4'999'000'000}), 5.001);
  EXPECT_DOUBLE_EQ(SufficientSkew({1'000'000, 3'000'000}), 0.003);
  EXPECT_DOUBLE_EQ(SufficientSkew({.lower_ns = 2'500'000}), 0.003);
}

}  // namespace
}  // namespace collision::server
