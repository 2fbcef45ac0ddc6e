// Goal:   a client follows one service at a time: the highest term that still speaks.
// Method: stamps of several services at times of our own.
#include "client/library/network/current_service.h"

#include <gtest/gtest.h>

#include <limits>

namespace collision::client {
namespace {

using std::chrono::milliseconds;

CurrentService::Time At(int ms) { return CurrentService::Time() + milliseconds(ms); }

v1::ServiceStamp Stamp(std::uint64_t id, std::uint32_t term) {
  v1::ServiceStamp stamp;
  stamp.set_service_id(id);
  stamp.set_term(term);
  return stamp;
}

TEST(CurrentService, TheFirstOneHeardIsInForce) {
  CurrentService service;
  EXPECT_EQ(service.id(), 0u);
  EXPECT_TRUE(service.Accept(Stamp(5, 3), At(0)));
  EXPECT_EQ(service.id(), 5u);
  EXPECT_EQ(service.term(), 3u);
}

TEST(CurrentService, AHigherTermTakesOverAtOnceAndTheLowerOneIsDropped) {
  CurrentService service;
  EXPECT_TRUE(service.Accept(Stamp(5, 3), At(0)));
  EXPECT_TRUE(service.Accept(Stamp(9, 4), At(0)));
  EXPECT_FALSE(service.Accept(Stamp(5, 3), At(1)));
  EXPECT_EQ(service.id(), 9u);
}

TEST(CurrentService, OfEqualTermsTheLowerIdCounts) {
  for (const bool lower_first : {true, false}) {
    CurrentService service;
    service.Accept(Stamp(lower_first ? 5 : 6, 3), At(0));
    service.Accept(Stamp(lower_first ? 6 : 5, 3), At(1));
    EXPECT_EQ(service.id(), 5u);
  }
}

TEST(CurrentService, ATermThatWasOnlyATestIsOverWhenItsServiceIsSilent) {
  CurrentService service;
  service.Accept(Stamp(5, 1), At(0));
  EXPECT_TRUE(service.Accept(Stamp(9, std::numeric_limits<std::uint32_t>::max()), At(100)));
  EXPECT_FALSE(service.Accept(Stamp(5, 1), At(2099)));
  EXPECT_TRUE(service.Accept(Stamp(5, 1), At(2100)));
  EXPECT_EQ(service.id(), 5u);
  EXPECT_EQ(service.term(), 1u);
}

TEST(CurrentService, ATermThatIsRepeatedStays) {
  CurrentService service;
  service.Accept(Stamp(9, 7), At(0));
  for (int ms = 500; ms <= 60'000; ms += 500) {
    EXPECT_TRUE(service.Accept(Stamp(9, 7), At(ms)));
    EXPECT_FALSE(service.Accept(Stamp(5, 1), At(ms)));
  }
}

// Samples of different topics overtake each other, and so does an old status what came after it.
TEST(CurrentService, OneThatWasFollowedStaysSoWhateverAnOldStatusSays) {
  CurrentService service;
  service.Accept(Stamp(5, 3), At(0));
  EXPECT_TRUE(service.Accept(Stamp(5, 3), At(1), false));
  EXPECT_FALSE(service.Accept(Stamp(9, 2), At(2))) << "of a lower term";
}

v1::ServiceHeard Heard(std::uint64_t id, bool ended) {
  v1::ServiceHeard heard;
  heard.set_service_id(id);
  heard.set_ended(ended);
  return heard;
}

// The network need not say that a service has ended: its host may be gone.
TEST(CurrentService, OneThatNobodyFollowsIsBelievedOnceTheOtherIsSilentForLong) {
  CurrentService service;
  service.Accept(Stamp(5, 3), At(0));
  EXPECT_FALSE(service.Accept(Stamp(9, 4), At(11'999), false));
  EXPECT_TRUE(service.Accept(Stamp(9, 4), At(12'000), false));
}

TEST(CurrentService, AStandbyThatNobodyFollowsWaitsForTheEndOfTheOneInForce) {
  CurrentService service;
  EXPECT_TRUE(service.Accept(Stamp(5, 3), At(0)));
  EXPECT_FALSE(service.Accept(Stamp(9, 4), At(1), false)) << "its own cable may have been out";
  EXPECT_FALSE(service.Hear(Heard(7, true)));
  EXPECT_FALSE(service.Accept(Stamp(9, 4), At(1), false));
  EXPECT_TRUE(service.Hear(Heard(5, true)));
  EXPECT_TRUE(service.Accept(Stamp(9, 4), At(2), false));
  EXPECT_FALSE(service.Accept(Stamp(5, 3), At(2))) << "what it wrote before its end, late";
  EXPECT_TRUE(service.Accept(Stamp(9, 4), At(3), true));
  EXPECT_FALSE(service.Hear(Heard(5, false)));
  EXPECT_FALSE(service.Accept(Stamp(5, 3), At(4))) << "it is back, out of term";
  EXPECT_EQ(service.id(), 9u);
}

TEST(CurrentService, OneThatSimulatorsFollowGoesBeforeAHigherTermThatNobodyFollows) {
  CurrentService service;
  EXPECT_TRUE(service.Accept(Stamp(9, 4), At(0), false));
  EXPECT_TRUE(service.Accept(Stamp(5, 3), At(1), true));
  EXPECT_FALSE(service.Accept(Stamp(9, 4), At(2), false));
  EXPECT_TRUE(service.Accept(Stamp(9, 4), At(2), true))
      << "of two that are followed the term counts";
}

TEST(CurrentService, AnyNumberOfEndsIsForgotten) {
  CurrentService service;
  service.Accept(Stamp(1'000'000, 3), At(0));
  for (std::uint64_t id = 1; id < 10'000; ++id) EXPECT_FALSE(service.Hear(Heard(id, true)));
  EXPECT_TRUE(service.Hear(Heard(1'000'000, true)));
  EXPECT_TRUE(service.Accept(Stamp(2'000'000, 4), At(0), false));
}

TEST(CurrentService, AnEarlierEpochOfTheSameServiceIsOver) {
  CurrentService service;
  const auto accept = [&](std::uint64_t id, std::uint32_t term, std::uint32_t epoch) {
    v1::ServiceStamp stamp = Stamp(id, term);
    stamp.set_epoch(epoch);
    return service.Accept(stamp, At(0));
  };
  EXPECT_TRUE(accept(5, 1, 1));
  EXPECT_TRUE(accept(5, 1, 3));
  EXPECT_FALSE(accept(5, 1, 2));
  v1::ServiceStamp past = Stamp(5, 1);
  past.set_epoch(2);
  EXPECT_TRUE(service.IsPast(past));
  past.set_epoch(3);
  EXPECT_FALSE(service.IsPast(past));
  EXPECT_EQ(service.epoch(), 3u);
  EXPECT_TRUE(accept(6, 2, 1)) << "another service counts anew";
  EXPECT_EQ(service.epoch(), 1u);
}

}  // namespace
}  // namespace collision::client
