#include "server/world/simulator_time.h"

#include <gtest/gtest.h>

namespace collision::server {
namespace {

Instant At(std::int64_t ns) { return Instant::FromNanoseconds(ns); }

// Goal:   a clock comes into force once everything written before it has arrived, in order, and
//         clocks that wait are few.
TEST(SimulatorTime, AClockWaitsForWhatWasWrittenBeforeIt) {
  SimulatorTime time;
  time.Offer({.clock = At(1), .states_sequence = 2});
  time.Offer({.clock = At(2), .states_sequence = 2, .descriptions_sequence = 1});
  time.Offer({.clock = At(3), .states_sequence = 5});
  EXPECT_FALSE(time.Take());
  time.RecordStates(3);
  EXPECT_TRUE(time.Take());
  EXPECT_EQ(time.clock(), At(1));
  time.RecordDescriptions(1);
  EXPECT_TRUE(time.Take());
  EXPECT_EQ(time.clock(), At(2));
  for (int i = 4; i < 100; ++i) time.Offer({.clock = At(i), .states_sequence = 5});
  EXPECT_EQ(time.pending(), kPendingClocksMax);
  time.RecordStates(5);
  EXPECT_TRUE(time.Take());
  EXPECT_EQ(time.clock(), At(99));
  EXPECT_EQ(time.first_clock(), At(1));
}

// Goal:   sequences may arrive in any order: an older one takes nothing back.
TEST(SimulatorTime, TheHighestSequenceCounts) {
  SimulatorTime time;
  time.RecordStates(7);
  time.RecordStates(2);
  time.RecordDescriptions(4);
  time.RecordDescriptions(3);
  time.Offer({.clock = At(1), .states_sequence = 7, .descriptions_sequence = 4});
  EXPECT_TRUE(time.Take());
}

// Goal:   a run stands where the one before it stood until it has told a clock of its own.
TEST(SimulatorTime, ARunStandsWhereTheFormerOneStood) {
  SimulatorTime former;
  former.Offer({.clock = At(5), .next = At(8)});
  EXPECT_TRUE(former.Take());
  former.Hear(At(9), At(10));  // to be taken in a later round
  SimulatorTime time = SimulatorTime::After(former, former.standing());
  EXPECT_EQ(time.clock(), std::nullopt);
  EXPECT_EQ(time.stands_at(), At(5));
  EXPECT_EQ(time.told_until(), At(7));
  EXPECT_TRUE(time.tells_next());
  EXPECT_TRUE(time.is_awaited());
  EXPECT_EQ(time.heard(), At(9));
  EXPECT_EQ(time.heard_until(), At(10));
  SimulatorTime nobodys = SimulatorTime::After(time, time.standing());
  EXPECT_EQ(nobodys.told_until(), At(7)) << "nor has the next one told a clock";
  nobodys.ForgetFormer();
  EXPECT_EQ(nobodys.stands_at(), std::nullopt);
  EXPECT_EQ(nobodys.heard(), Instant::Always());
  EXPECT_EQ(nobodys.heard_until(), Instant::Always());
  time.Offer({.clock = At(6)});
  EXPECT_TRUE(time.Take());
  EXPECT_EQ(time.stands_at(), At(6));
  EXPECT_EQ(time.heard(), At(9)) << "the world has come so far";
  EXPECT_FALSE(time.is_awaited());
}

TEST(SimulatorTime, AGrantIsNeverShortened) {
  SimulatorTime time;
  EXPECT_FALSE(time.granted());
  EXPECT_TRUE(time.Grant(At(5)));
  EXPECT_FALSE(time.Grant(At(4)));
  EXPECT_FALSE(time.Grant(At(5)));
  EXPECT_EQ(time.granted(), At(5));
  EXPECT_TRUE(time.Grant(At(6)));
}

TEST(SimulatorTime, AfterARestartClocksMayGoBackAndWhatHasArrivedStaysKnown) {
  SimulatorTime time;
  time.RecordDescriptions(2);
  time.Offer({.clock = At(9), .descriptions_sequence = 2});
  EXPECT_TRUE(time.Take());
  time.Grant(At(10));
  time.Offer({.clock = At(11), .states_sequence = 5});
  time.Restart();
  EXPECT_EQ(time.clock(), std::nullopt);
  EXPECT_EQ(time.granted(), std::nullopt);
  EXPECT_EQ(time.newest(), Instant::Always());
  EXPECT_EQ(time.pending(), 0u);
  time.Offer({.clock = At(3), .descriptions_sequence = 2});
  EXPECT_TRUE(time.Take());
  EXPECT_EQ(time.first_clock(), At(3));
}

TEST(SimulatorTime, AClockOfTheWorldsKindMendsOneOfTheOther) {
  SimulatorTime time;
  time.SetOtherKind();
  EXPECT_TRUE(time.is_other_kind());
  EXPECT_EQ(time.newest(), Instant::Always());
  time.Offer({.clock = At(3), .lock_step = true});
  EXPECT_FALSE(time.is_other_kind());
  EXPECT_TRUE(time.lock_step());
  EXPECT_EQ(time.newest(), At(3));
}

}  // namespace
}  // namespace collision::server
