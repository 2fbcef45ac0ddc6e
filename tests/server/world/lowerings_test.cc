// Goal:   what lowered a clearance stands until the simulator is certain to have heard it, and no
//         longer.
#include "server/world/lowerings.h"

#include <gtest/gtest.h>

namespace collision::server {
namespace {

using detection::AgentClearance;
using detection::ClearanceCause;

Instant At(std::int64_t ns) { return Instant::FromNanoseconds(ns); }

AgentClearance Lowered(ClearanceCause cause, Instant void_from = Instant::Never()) {
  AgentClearance clearance;
  clearance.cause = cause;
  clearance.cause_agent.slot = 7;
  clearance.void_from = void_from;
  return clearance;
}

TEST(Lowerings, ASampleFromBeforeSaysNothingOfThem) {
  Lowerings lowerings;
  lowerings.Publish(0, 10);
  lowerings.Take(3, Lowered(ClearanceCause::kTeleport));
  lowerings.Acknowledge(10);
  EXPECT_EQ(lowerings.Of(3).cause, ClearanceCause::kTeleport);
  lowerings.Publish(0, 11);
  lowerings.Acknowledge(10);
  EXPECT_EQ(lowerings.Of(3).cause, ClearanceCause::kTeleport);
  lowerings.Acknowledge(11);
  EXPECT_EQ(lowerings.Of(3).cause, ClearanceCause::kNone);
}

TEST(Lowerings, AnAcknowledgementOfAnEarlierSampleIsNotEnough) {
  Lowerings lowerings;
  lowerings.Take(3, Lowered(ClearanceCause::kTeleport));
  lowerings.Publish(0, 11);
  lowerings.Publish(1, 12);
  lowerings.Acknowledge(10);
  EXPECT_EQ(lowerings.Of(3).cause, ClearanceCause::kTeleport);
  EXPECT_EQ(lowerings.Of(3).cause_agent.slot, 7u);
  lowerings.Acknowledge(12);
  EXPECT_EQ(lowerings.Of(3).cause, ClearanceCause::kNone);
  EXPECT_EQ(lowerings.Of(3).count, 1u);
}

// A newer sample of the chunk may have overwritten the one that was acknowledged over.
TEST(Lowerings, TheNewestSampleOfTheChunkMustBeAcknowledged) {
  Lowerings lowerings;
  lowerings.Take(3, Lowered(ClearanceCause::kTeleport));
  lowerings.Publish(0, 11);
  lowerings.Publish(1, 12);
  lowerings.Publish(0, 13);
  lowerings.Acknowledge(12);
  EXPECT_EQ(lowerings.Of(3).cause, ClearanceCause::kTeleport);
  lowerings.Acknowledge(13);
  EXPECT_EQ(lowerings.Of(3).cause, ClearanceCause::kNone);
}

TEST(Lowerings, NothingIsAcknowledgedBeforeItIsPublished) {
  Lowerings lowerings;
  lowerings.Take(70, Lowered(ClearanceCause::kAdmission));
  lowerings.Acknowledge(1'000'000);  // of another service, or made up
  EXPECT_EQ(lowerings.Of(70).cause, ClearanceCause::kAdmission);
  lowerings.Publish(1, 5);
  EXPECT_EQ(lowerings.Of(70).cause, ClearanceCause::kAdmission);
}

TEST(Lowerings, AVoidStandsBeforeOtherCausesAndReachesBackToTheEarliest) {
  Lowerings lowerings;
  lowerings.Take(0, Lowered(ClearanceCause::kBreach, At(50)));
  lowerings.Take(0, Lowered(ClearanceCause::kAdmission));
  EXPECT_EQ(lowerings.Of(0).cause, ClearanceCause::kBreach);
  EXPECT_EQ(lowerings.Of(0).void_from, At(50));
  lowerings.Take(0, Lowered(ClearanceCause::kBreach, At(80)));
  EXPECT_EQ(lowerings.Of(0).void_from, At(50));
  EXPECT_EQ(lowerings.Of(0).count, 3u);
  lowerings.Publish(0, 1);
  lowerings.Acknowledge(1);
  EXPECT_TRUE(lowerings.Of(0).void_from.is_never());
}

TEST(Lowerings, ACauseOfNoneIsNoLowering) {
  Lowerings lowerings;
  lowerings.Take(0, Lowered(ClearanceCause::kNone));
  EXPECT_EQ(lowerings.Of(0).count, 0u);
}

}  // namespace
}  // namespace collision::server
