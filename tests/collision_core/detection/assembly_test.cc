// Goal:   agents of one assembly tell nothing of each other and everything of others; a change of
//         assembly or lists ends what it excludes in a defined way and lowers clearances where it
//         excludes less.
// Method: few agents on a line whose balls overlap or meet.
#include <gtest/gtest.h>

#include "tests/collision_core/detection/line.h"

namespace collision::detection {
namespace {

AgentDeclaration Part(std::uint32_t assembly, std::uint32_t name,
                      const broad_phase::PartnerLists& lists = {}) {
  AgentDeclaration part{.limits = {.radius = 1, .acceleration_max = 1}};
  part.filter.assembly = assembly;
  part.filter.name = name;
  if (lists != broad_phase::PartnerLists()) {
    part.filter.partners = std::make_shared<broad_phase::PartnerLists>(lists);
  }
  return part;
}

/// Agents at rest, one metre apart, so that neighbours overlap and the next but one touch.
class Chain : public Line {
 public:
  void AddPart(std::uint32_t slot, double x, const AgentDeclaration& declaration) {
    const Vector3d p(x, 0, 0);
    detector.Admit(Id(slot), declaration, State(now, p, {0, 0, 0}), At(now));
    agents.push_back({slot, p, {0, 0, 0}, now});
  }
};

TEST(Assembly, TellsNothingWithinAndEverythingBetween) {
  Chain chain;
  for (std::uint32_t part = 0; part < 7; ++part) chain.AddPart(part, part, Part(1, 1 + part));
  chain.RunTo(1);
  EXPECT_TRUE(chain.events.empty());
  EXPECT_EQ(chain.detector.pairs_tracked(), 0u);
  EXPECT_FALSE(chain.detector.Earliest().found);
  for (std::uint32_t part = 0; part < 7; ++part) {
    EXPECT_TRUE(chain.detector.ClearanceOf(Id(part))->clear_until.is_never()) << part;
  }
  chain.AddPart(7, 7.5, Part(2, 8));
  chain.RunTo(1.5);
  for (const CollisionEvent& event : chain.events) EXPECT_EQ(event.higher, Id(7));
  ASSERT_EQ(chain.With(EventStatus::kConfirmed).size(), 1u);
  EXPECT_EQ(chain.With(EventStatus::kConfirmed)[0].lower, Id(6));
}

TEST(Assembly, ListsLetPartsMeetAndKeepOthersApart) {
  Chain chain;
  chain.AddPart(1, 0, Part(1, 1, {.meets_in_assembly = {3}, .never_meets = {4}}));
  chain.AddPart(2, 0.5, Part(1, 2));
  chain.AddPart(3, 1, Part(1, 3));
  chain.AddPart(4, 1.5, Part(0, 4));
  chain.RunTo(0.5);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> met;
  for (const CollisionEvent& event : chain.With(EventStatus::kConfirmed)) {
    met.emplace_back(event.lower.slot, event.higher.slot);
  }
  std::sort(met.begin(), met.end());
  EXPECT_EQ(met, (std::vector<std::pair<std::uint32_t, std::uint32_t>>{{1, 3}, {2, 4}, {3, 4}}));
}

TEST(Assembly, AnAgentThatLeavesItLowersWhatTheOthersWereTold) {
  Chain chain;
  chain.AddPart(1, 0, Part(1, 1));
  chain.AddPart(2, 10, Part(1, 2));
  chain.RunTo(0.5);
  chain.detector.TakeChangedClearances();
  ASSERT_TRUE(chain.detector.ClearanceOf(Id(2))->clear_until.is_never());
  chain.detector.Redeclare(Id(1), Part(0, 1), At(3));
  chain.Step();
  const auto changed = chain.detector.TakeChangedClearances();
  ASSERT_EQ(changed.size(), 2u);
  EXPECT_FALSE(changed[1].clear_until.is_never());
  EXPECT_EQ(changed[1].cause, ClearanceCause::kWidening);
  EXPECT_EQ(changed[1].cause_agent, Id(1));
  EXPECT_EQ(chain.detector.counters().widenings, 1u);
  chain.detector.Redeclare(Id(1), Part(1, 1), At(3));
  chain.Step();
  EXPECT_EQ(chain.detector.counters().widenings, 1u) << "it promises more";
}

TEST(Assembly, AListThatLetsPartsMeetWidens) {
  Chain chain;
  chain.AddPart(1, 0, Part(1, 1));
  chain.AddPart(2, 1, Part(1, 2));
  chain.RunTo(0.5);
  EXPECT_TRUE(chain.events.empty());
  chain.detector.Redeclare(Id(1), Part(1, 1, {.meets_in_assembly = {2}}), At(chain.now));
  chain.RunTo(1);
  ASSERT_EQ(chain.With(EventStatus::kConfirmed).size(), 1u);
  EXPECT_TRUE(chain.With(EventStatus::kConfirmed)[0].began_before);
  EXPECT_EQ(chain.detector.counters().widenings, 1u);
}

// Goal: a confirmed contact of two that a change keeps apart ends, with an open end; one that was
//       only possible is withdrawn; nothing of the two is told afterwards, and they are clear.
TEST(Assembly, AContactThatBecomesExcludedEndsOpenAndAPossibleOneIsWithdrawn) {
  Chain chain;
  chain.AddPart(1, 0, Part(0, 1));
  chain.AddPart(2, 1, Part(0, 2));
  chain.AddPart(3, -2.1, Part(0, 3));
  chain.RunTo(0.5);
  ASSERT_EQ(chain.With(EventStatus::kConfirmed).size(), 1u);
  ASSERT_EQ(chain.detector.pairs_tracked(), 3u);
  chain.events.clear();
  chain.detector.Redeclare(Id(1), Part(0, 1, {.never_meets = {2, 3}}), At(chain.now));
  chain.Step();
  ASSERT_EQ(chain.With(EventStatus::kEnded).size(), 1u);
  const CollisionEvent& ended = chain.With(EventStatus::kEnded)[0];
  EXPECT_EQ(ended.higher, Id(2));
  EXPECT_TRUE(ended.end.latest.is_never());
  const auto withdrawn = chain.With(EventStatus::kWithdrawn);
  ASSERT_EQ(withdrawn.size(), 1u);
  EXPECT_EQ(withdrawn[0].higher, Id(3));
  chain.events.clear();
  chain.RunTo(1);
  for (const CollisionEvent& event : chain.events) EXPECT_NE(event.lower, Id(1));
  EXPECT_TRUE(chain.detector.ClearanceOf(Id(1))->clear_until.is_never());
  EXPECT_FALSE(chain.detector.ClearanceOf(Id(1))->in_contact);
}

}  // namespace
}  // namespace collision::detection
