// Goal:   what does not arrive is sent again, what is on its way is not; the name is taken when its
//         owner is gone, and not before.
// Method: reports as a service would send them, and a time that the test chooses.
#include "client/library/world/arrival.h"

#include <gtest/gtest.h>

#include <limits>

namespace collision::client {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr std::uint32_t kRun = 7, kOwn = 4711, kOther = 815;

class ArrivalTest : public testing::Test {
 protected:
  void Write(std::uint64_t descriptions, std::uint64_t states, std::uint32_t stated) {
    v1::SimulatorClock clock;
    clock.set_descriptions_sequence(descriptions);
    clock.set_states_sequence(states);
    arrival_.Wrote(clock, stated, now_);
  }

  void Report(std::uint64_t descriptions, std::uint64_t states, std::uint32_t stated) {
    v1::SimulatorReport report;
    report.set_run(arrival_.run());
    report.set_incarnation(kOwn);
    report.set_alive(true);
    report.set_descriptions_sequence(descriptions);
    report.set_states_sequence(states);
    report.set_agents_stated(stated);
    arrival_.Hear(report, now_);
  }

  void ReportOther(std::uint32_t run, bool alive) {
    v1::SimulatorReport report;
    report.set_run(run);
    report.set_incarnation(kOther);
    report.set_alive(alive);
    arrival_.Hear(report, now_);
  }

  bool DueAfter(milliseconds time) {
    now_ += time;
    return arrival_.TakeDue(now_);
  }

  Arrival arrival_{kRun, kOwn, false};
  Arrival::Time now_{seconds(100)};
};

TEST_F(ArrivalTest, WhatHasArrivedIsNotSentAgain) {
  Write(5, 9, 5);
  EXPECT_FALSE(DueAfter(milliseconds(999)));
  Report(5, 9, 5);
  EXPECT_FALSE(DueAfter(seconds(3600)));
}

TEST_F(ArrivalTest, WhatIsMissingIsSentAgainEverMoreRarely) {
  for (const auto& [descriptions, states, stated] :
       {std::tuple(4, 9, 5), std::tuple(5, 8, 5), std::tuple(5, 9, 4)}) {
    SCOPED_TRACE(descriptions * 100 + states * 10 + stated);
    arrival_ = Arrival(kRun, kOwn, false);
    Write(5, 9, 5);
    Report(descriptions, states, stated);
    for (const int wait : {1, 2, 4, 8, 8}) {
      EXPECT_FALSE(DueAfter(seconds(wait) - milliseconds(1)));
      EXPECT_TRUE(DueAfter(milliseconds(1)));
      EXPECT_FALSE(arrival_.with_shapes());
      EXPECT_FALSE(DueAfter(milliseconds(0)));
    }
    Report(5, 9, 5);
    EXPECT_FALSE(DueAfter(seconds(100)));
    // The next gap is not made to wait for the last one.
    Write(6, 9, 5);
    EXPECT_TRUE(DueAfter(seconds(1)));
  }
}

TEST_F(ArrivalTest, InLockStepAServiceThatIsOnlyLateIsGivenMoreTime) {
  arrival_ = Arrival(kRun, kOwn, true);
  Write(5, 9, 5);
  Report(5, 8, 5);
  EXPECT_FALSE(DueAfter(kResendAfterInLockStep - milliseconds(1)));
  EXPECT_TRUE(DueAfter(milliseconds(1)));
  EXPECT_FALSE(DueAfter(kResendAfterInLockStep - milliseconds(1)));
  v1::SimulatorReport report;
  report.set_run(kRun);
  report.set_incarnation(kOwn);
  report.set_descriptions_sequence(4);
  report.add_refusals()->set_reason(v1::REJECTED_NOT_DESCRIBED);
  arrival_.Hear(report, now_);
  EXPECT_TRUE(DueAfter(milliseconds(0))) << "a description is missing";
}

TEST_F(ArrivalTest, InLockStepWhatFoundNoRoomIsSentAgainSoon) {
  arrival_ = Arrival(kRun, kOwn, true);
  Write(5, 9, 5);
  arrival_.HearOfNoRoom();
  EXPECT_TRUE(DueAfter(seconds(1)));
  // It has come in since, with a clock that was told again, and without its agents.
  Report(0, 0, 0);
  EXPECT_TRUE(DueAfter(seconds(2)));
  Report(5, 9, 5);
  Write(6, 9, 5);
  EXPECT_FALSE(DueAfter(kResendAfterInLockStep - milliseconds(1)));
}

// Goal:   in a stream the report is always behind the newest clock: that is no gap.
TEST_F(ArrivalTest, AStreamThatIsReportedLateIsNotSentAgain) {
  Write(5, 0, 0);
  Report(5, 0, 0);
  for (std::uint64_t i = 1; i <= 1000; ++i) {
    Write(5, 5 * i, 5);
    if (i > 30 && i % 10 == 0) Report(5, 5 * (i - 30), 5);
    ASSERT_FALSE(DueAfter(milliseconds(16))) << i;
  }
  // And one of which nothing arrives any more is.
  bool due = false;
  for (std::uint64_t i = 1001; i <= 1100 && !due; ++i) {
    Write(5, 5 * i, 5);
    due = DueAfter(milliseconds(16));
  }
  EXPECT_TRUE(due);
}

TEST_F(ArrivalTest, ARunThatEndedInSilenceIsFollowedByTheNextOne) {
  Write(5, 9, 5);
  Report(5, 9, 5);
  v1::SimulatorReport report;
  report.set_run(kRun);
  report.set_incarnation(kOwn);
  report.set_ended(v1::RUN_SILENT);
  arrival_.Hear(report, now_);
  EXPECT_EQ(arrival_.run(), kRun + 1);
  EXPECT_EQ(arrival_.ended(), v1::RUN_GOES_ON);
  EXPECT_TRUE(DueAfter(milliseconds(0)));
  EXPECT_TRUE(arrival_.with_shapes());
  arrival_.Hear(report, now_);  // Once more, and late.
  EXPECT_EQ(arrival_.run(), kRun + 1);
  Report(5, 9, 5);
  EXPECT_FALSE(DueAfter(seconds(100)));
}

TEST_F(ArrivalTest, ARunThatAnOperatorEndedStaysSo) {
  for (const v1::RunEnd end : {v1::RUN_EVICTED, v1::RUN_RESTARTED}) {
    Report(5, 9, 5);
    EXPECT_EQ(EndText("alpha", arrival_), "");
    v1::SimulatorReport report;
    report.set_run(kRun);
    report.set_incarnation(kOwn);
    report.set_ended(end);
    arrival_.Hear(report, now_);
    EXPECT_EQ(arrival_.run(), kRun);
    EXPECT_EQ(arrival_.ended(), end);
    EXPECT_NE(EndText("alpha", arrival_), "");
  }
}

TEST_F(ArrivalTest, AServiceThatMissesAShapeOrADescriptionGetsAll) {
  Write(5, 9, 5);
  v1::SimulatorReport report;
  report.set_run(kRun);
  report.set_incarnation(kOwn);
  report.set_descriptions_sequence(5);
  report.set_states_sequence(9);
  report.set_agents_stated(5);
  v1::StandingRefusal& refusal = *report.add_refusals();
  refusal.set_reason(v1::REJECTED_BAD_SHAPE);
  refusal.set_field("bytes");
  arrival_.Hear(report, now_);
  EXPECT_FALSE(DueAfter(seconds(10))) << "bad bytes are no better the second time";
  refusal.set_field("shape_hash");
  arrival_.Hear(report, now_);
  EXPECT_TRUE(DueAfter(seconds(1)));
  EXPECT_TRUE(arrival_.with_shapes());
}

// Goal:   a service that was started again has nothing at first; it gets the time to fetch it.
TEST_F(ArrivalTest, AnotherServiceGetsTimeToCatchUp) {
  Write(5, 9, 5);
  Report(5, 9, 5);
  now_ += seconds(100);
  Report(0, 0, 0);
  EXPECT_FALSE(DueAfter(milliseconds(999)));
  EXPECT_TRUE(DueAfter(milliseconds(1)));
}

TEST_F(ArrivalTest, WhileAnotherProgramHasTheNameItWaits) {
  Write(5, 9, 5);
  ReportOther(kRun + 3, true);
  EXPECT_TRUE(arrival_.waits());
  EXPECT_NE(OtherText("tester", arrival_).find("\"tester\" is alive"), std::string::npos);
  EXPECT_FALSE(DueAfter(seconds(3600)));
  EXPECT_EQ(arrival_.run(), kRun);
  ReportOther(kRun + 3, false);
  EXPECT_FALSE(arrival_.waits());
  EXPECT_EQ(OtherText("tester", arrival_), "");
  EXPECT_EQ(arrival_.run(), kRun + 4);
  EXPECT_TRUE(DueAfter(milliseconds(0)));
  EXPECT_FALSE(DueAfter(milliseconds(0))) << "once";
  Report(5, 9, 5);
  EXPECT_FALSE(DueAfter(seconds(100)));
}

// Goal:   of two clocks of hosts the one that is behind takes its turn, too.
TEST_F(ArrivalTest, AHigherRunOfADeadProgramIsFollowedByTheNext) {
  ReportOther(4'000'000'000, false);
  EXPECT_EQ(arrival_.run(), 4'000'000'001);
  EXPECT_TRUE(DueAfter(milliseconds(0)));
  ReportOther(std::numeric_limits<std::uint32_t>::max(), false);
  EXPECT_EQ(arrival_.run(), 4'000'000'001) << "there is none after it";
  EXPECT_NE(OtherText("tester", arrival_).find("highest run"), std::string::npos);
}

TEST_F(ArrivalTest, ALowerRunOfADeadProgramNeedsNothing) {
  Write(5, 9, 5);
  ReportOther(kRun - 1, false);
  EXPECT_EQ(arrival_.run(), kRun);
  EXPECT_FALSE(DueAfter(milliseconds(999)));
  Report(5, 9, 5);
  EXPECT_FALSE(DueAfter(seconds(100)));
}

// Goal:   what was written while a lower run still counted as alive was refused.
TEST_F(ArrivalTest, AfterAWaitEverythingIsSentAtOnce) {
  for (const bool end_is_heard : {true, false}) {
    arrival_ = Arrival(kRun, kOwn, false);
    Write(5, 9, 5);
    ReportOther(kRun - 1, true);
    if (end_is_heard) ReportOther(kRun - 1, false);
    if (!end_is_heard) Report(0, 0, 0);
    EXPECT_EQ(arrival_.run(), kRun);
    EXPECT_TRUE(DueAfter(milliseconds(0)));
    EXPECT_TRUE(arrival_.with_shapes());
  }
}

// Goal:   a late report of its own former run says nothing.
TEST_F(ArrivalTest, ItsOwnFormerRunIsNobodyElse) {
  ReportOther(kRun, false);
  ASSERT_EQ(arrival_.run(), kRun + 1);
  v1::SimulatorReport former;
  former.set_run(kRun);
  former.set_incarnation(kOwn);
  arrival_.Hear(former, now_);
  EXPECT_EQ(arrival_.run(), kRun + 1);
  EXPECT_FALSE(arrival_.waits());
}

}  // namespace
}  // namespace collision::client
