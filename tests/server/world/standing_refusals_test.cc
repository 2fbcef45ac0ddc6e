#include "server/world/standing_refusals.h"

#include <gtest/gtest.h>

namespace collision::server {
namespace {

Refusal Of(v1::InputTopic topic, std::uint32_t slot, const char* field = "radius_m") {
  return {.reason = v1::REJECTED_OUT_OF_RANGE, .topic = topic, .slot = slot, .field = field};
}

TEST(StandingRefusals, TheNewestOfATopicAndSlotStandsUntilItIsAccepted) {
  StandingRefusals standing;
  standing.Add(Of(v1::TOPIC_AGENT_STATES, 3, "stamp_ns"));
  standing.Add(Of(v1::TOPIC_AGENT_STATES, 3, "position_m"));
  standing.Add(Of(v1::TOPIC_AGENT_DESCRIPTION, 3));
  ASSERT_EQ(standing.count(), 2u);
  EXPECT_EQ(standing.listed().at({v1::TOPIC_AGENT_STATES, 3}).field, "position_m");
  EXPECT_EQ(standing.descriptions(), 1u);
  const std::uint64_t before = standing.revision();
  standing.Accept(v1::TOPIC_AGENT_STATES, 2);
  EXPECT_EQ(standing.revision(), before) << "nothing stood there";
  standing.Accept(v1::TOPIC_AGENT_STATES, 3);
  EXPECT_EQ(standing.count(), 1u);
  EXPECT_GT(standing.revision(), before);
}

TEST(StandingRefusals, GoWithTheAgentAndWithTheRun) {
  StandingRefusals standing;
  for (const auto topic : {v1::TOPIC_AGENT_STATES, v1::TOPIC_AGENT_DESCRIPTION, v1::TOPIC_SHAPE}) {
    standing.Add(Of(topic, 3));
    standing.Add(Of(topic, 4));
  }
  standing.RemoveAgent(3);
  EXPECT_EQ(standing.count(), 3u);
  standing.Clear();
  EXPECT_EQ(standing.count(), 0u);
}

// Goal:   the list is bounded, and the count never too small.
TEST(StandingRefusals, BeyondTheLimitTheyAreCounted) {
  StandingRefusals standing;
  for (std::uint32_t slot = 0; slot < 100; ++slot) standing.Add(Of(v1::TOPIC_AGENT_STATES, slot));
  EXPECT_EQ(standing.listed().size(), kStandingRefusalsMax);
  EXPECT_EQ(standing.count(), 100u);
  EXPECT_EQ(standing.descriptions(), 100 - kStandingRefusalsMax) << "perhaps among the others";
  for (std::uint32_t slot = 0; slot < 100; ++slot) standing.Accept(v1::TOPIC_AGENT_STATES, slot);
  EXPECT_EQ(standing.count(), 0u);
}

TEST(StandingRefusals, OnlyWhatTheOwnerWroteStands) {
  EXPECT_TRUE(StandingRefusals::Stands(v1::REJECTED_FUTURE_STAMP));
  EXPECT_TRUE(StandingRefusals::Stands(v1::REJECTED_TOO_MANY_AGENTS));
  for (const auto reason : {v1::REJECTED_ID_OWNED, v1::REJECTED_ID_MISMATCH, v1::REJECTED_OLD_RUN,
                            v1::REJECTED_TOO_MANY_SIMULATORS}) {
    EXPECT_FALSE(StandingRefusals::Stands(reason));
  }
}

}  // namespace
}  // namespace collision::server
