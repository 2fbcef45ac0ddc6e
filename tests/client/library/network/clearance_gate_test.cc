// Goal:   a clearance passes with the events before it, in its order, or when these are given up:
//         after the patience, or when too many wait.
// Method: clearances and events in chosen orders at chosen times.
#include "client/library/network/clearance_gate.h"

#include <gtest/gtest.h>

namespace collision::client {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr ClearanceGate::Time kStart{std::chrono::hours(1)};

v1::Clearance Naming(std::uint64_t contacts_sequence, std::uint32_t chunk = 0) {
  v1::Clearance clearance;
  clearance.set_contacts_sequence(contacts_sequence);
  clearance.set_chunk(chunk);
  return clearance;
}

class ClearanceGateTest : public testing::Test {
 protected:
  /// The contacts named by the clearances that pass.
  std::vector<std::uint64_t> Passed(ClearanceGate::Time now = kStart) {
    std::vector<std::uint64_t> passed;
    for (const v1::Clearance& clearance : gate_.Take(&contacts_, newest_, now)) {
      passed.push_back(clearance.contacts_sequence());
    }
    return passed;
  }

  using Numbers = std::vector<std::uint64_t>;
  ContactSequence contacts_;
  ClearanceGate::Newest newest_;
  ClearanceGate gate_{ClearanceGate::kPatience};
};

TEST_F(ClearanceGateTest, WithoutContactsEverythingPasses) {
  gate_.Add(Naming(0), kStart);
  EXPECT_EQ(Passed(), Numbers{0});
  EXPECT_FALSE(gate_.Remaining(kStart).has_value());
}

TEST_F(ClearanceGateTest, AClearanceWaitsForItsContactsAndHoldsThoseBehindIt) {
  contacts_.Take(1);
  gate_.Add(Naming(1), kStart);
  gate_.Add(Naming(3), kStart);
  gate_.Add(Naming(2), kStart);
  EXPECT_EQ(Passed(), Numbers{1});
  contacts_.Take(2);
  EXPECT_EQ(Passed(), Numbers{});
  contacts_.Take(3);
  EXPECT_EQ(Passed(), (Numbers{3, 2}));
  EXPECT_EQ(contacts_.missed(), 0u);
}

TEST_F(ClearanceGateTest, AfterThePatienceTheContactsCountAsMissed) {
  contacts_.Take(1);
  gate_.Add(Naming(4), kStart);
  gate_.Add(Naming(5), kStart + milliseconds(500));
  EXPECT_EQ(gate_.Remaining(kStart + milliseconds(500)),
            ClearanceGate::kPatience - milliseconds(500));
  EXPECT_EQ(Passed(kStart + ClearanceGate::kPatience - nanoseconds(1)), Numbers{});
  EXPECT_EQ(Passed(kStart + ClearanceGate::kPatience), Numbers{4});
  EXPECT_EQ(contacts_.missed(), 3u);
  EXPECT_EQ(gate_.Remaining(kStart + ClearanceGate::kPatience), milliseconds(500));
  EXPECT_EQ(Passed(kStart + ClearanceGate::kPatience + milliseconds(500)), Numbers{5});
  EXPECT_EQ(contacts_.missed(), 4u);
}

TEST_F(ClearanceGateTest, AClearanceWaitsForAForecastThatIsNotOlderAndThenForThePatience) {
  v1::Clearance clearance = Naming(0);
  clearance.set_forecasts_sequence(20);
  newest_.forecast = 19;
  gate_.Add(clearance, kStart);
  EXPECT_EQ(Passed(), Numbers{});
  newest_.forecast = 21;  // 20 was overwritten
  EXPECT_EQ(Passed(), Numbers{0});
  newest_.forecast = 19;
  gate_.Add(clearance, kStart);
  EXPECT_EQ(Passed(kStart + ClearanceGate::kPatience - nanoseconds(1)), Numbers{});
  EXPECT_EQ(Passed(kStart + ClearanceGate::kPatience), Numbers{0});
}

TEST_F(ClearanceGateTest, BeyondItsRoomTheOldestPasses) {
  contacts_.Take(1);
  for (std::uint32_t i = 0; i < ClearanceGate::kWaitingMax; ++i) gate_.Add(Naming(i + 2), kStart);
  EXPECT_EQ(Passed(), Numbers{});
  gate_.Add(Naming(ClearanceGate::kWaitingMax + 2), kStart);
  EXPECT_EQ(Passed(), Numbers{2});
  EXPECT_EQ(contacts_.missed(), 1u);
}

TEST_F(ClearanceGateTest, WhatAFormerServicePromisedNeverPasses) {
  gate_.Add(Naming(1), kStart);
  gate_.Clear();
  contacts_.Take(1);
  EXPECT_EQ(Passed(), Numbers{});
}

}  // namespace
}  // namespace collision::client
