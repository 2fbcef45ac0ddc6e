// Goal:   a gap in the contacts is counted once and exactly; what was before the reader is none,
//         and what comes late after all does not stay counted.
// Method: numbers in the orders in which a network can bring them.
#include "client/library/network/contact_sequence.h"

#include <gtest/gtest.h>

namespace collision::client {
namespace {

TEST(ContactSequence, ALateJoinerBeginsWithTheFirstThatComes) {
  ContactSequence contacts;
  EXPECT_FALSE(contacts.HasAll(1));
  EXPECT_TRUE(contacts.Take(3977));
  EXPECT_TRUE(contacts.Take(3978));
  EXPECT_EQ(contacts.missed(), 0u);
  EXPECT_TRUE(contacts.HasAll(3978));
  EXPECT_FALSE(contacts.HasAll(3979));
}

TEST(ContactSequence, WhoWasThereBeforeTheFirstMissesIt) {
  ContactSequence contacts;
  contacts.BeginAtNone();
  EXPECT_TRUE(contacts.HasAll(0));
  EXPECT_TRUE(contacts.Take(3));
  EXPECT_EQ(contacts.missed(), 2u);
}

TEST(ContactSequence, EachGapCountsAndEachRepetitionIsDropped) {
  ContactSequence contacts;
  for (const std::uint64_t sequence : {5, 6, 9, 10, 12}) EXPECT_TRUE(contacts.Take(sequence));
  EXPECT_EQ(contacts.missed(), 3u);
  for (const std::uint64_t sequence : {5, 9, 12, 7}) EXPECT_FALSE(contacts.Take(sequence));
  EXPECT_EQ(contacts.missed(), 3u);
}

TEST(ContactSequence, WhatIsGivenUpCountsOnceWhateverComesThen) {
  ContactSequence contacts;
  EXPECT_TRUE(contacts.Take(10));
  contacts.GiveUp(14);
  EXPECT_EQ(contacts.missed(), 4u);
  EXPECT_TRUE(contacts.HasAll(14));
  contacts.GiveUp(13);
  EXPECT_EQ(contacts.missed(), 4u);
  EXPECT_TRUE(contacts.Take(17));  // 15 and 16
  EXPECT_EQ(contacts.missed(), 6u);
}

TEST(ContactSequence, WhatComesAfterAllIsTakenAndDoesNotCount) {
  ContactSequence contacts;
  EXPECT_TRUE(contacts.Take(10));
  contacts.GiveUp(13);
  EXPECT_TRUE(contacts.Take(12));
  EXPECT_EQ(contacts.missed(), 2u);
  EXPECT_TRUE(contacts.Take(13));
  EXPECT_EQ(contacts.missed(), 1u);
  EXPECT_TRUE(contacts.Take(14));
  EXPECT_EQ(contacts.missed(), 1u);
}

TEST(ContactSequence, ANewestContactThatDoesNotComeIsMissedEvenByALateJoiner) {
  ContactSequence contacts;
  contacts.GiveUp(500);
  EXPECT_EQ(contacts.missed(), 1u);
  EXPECT_TRUE(contacts.HasAll(500));
  EXPECT_TRUE(contacts.Take(501));
  EXPECT_EQ(contacts.missed(), 1u);
}

TEST(ContactSequence, AHistoryThatComesLateIsTakenAndNothingOfItWasMissed) {
  ContactSequence contacts;
  contacts.GiveUp(500);
  for (std::uint64_t sequence = 400; sequence <= 501; ++sequence) {
    EXPECT_TRUE(contacts.Take(sequence));
  }
  EXPECT_EQ(contacts.missed(), 0u);
}

TEST(ContactSequence, WhatIsGivenUpTwiceCountsOnce) {
  ContactSequence contacts;
  EXPECT_TRUE(contacts.Take(10));
  contacts.GiveUp(12);
  contacts.GiveUp(14);
  EXPECT_EQ(contacts.missed(), 4u);
  for (std::uint64_t sequence = 11; sequence <= 14; ++sequence) {
    EXPECT_TRUE(contacts.Take(sequence));
  }
  EXPECT_EQ(contacts.missed(), 0u);
}

TEST(ContactSequence, AnotherServiceCountsAnew) {
  ContactSequence contacts;
  EXPECT_TRUE(contacts.Take(10));
  EXPECT_TRUE(contacts.Take(12));
  contacts.Restart();
  EXPECT_FALSE(contacts.HasAll(1));
  EXPECT_TRUE(contacts.Take(1));
  EXPECT_TRUE(contacts.Take(2));
  EXPECT_EQ(contacts.missed(), 1u);
}

}  // namespace
}  // namespace collision::client
